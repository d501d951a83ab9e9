// A library that passes for Embree 3, hands every call on to it, and keeps the rays: what a bake asks can be asked
// again in a loop that does nothing else. For one thread. It is loaded by its file (radvor_context_desc::embree_path)
// and, by the same file, by whoever wants to replay.
#pragma once

#include <cstdint>

extern "C" {

struct RecordedRays {
  std::uint64_t rays, calls;                    ///< all that passed
  std::uint64_t recorded_rays, recorded_calls;  ///< kept, a sample of them
  double build_cpu_seconds;                     ///< inside rtcCommitScene and rtcJoinCommitScene
};

/// Before the bake: of every stride runs of 64 consecutive calls one is kept; 1 keeps all.
using recorder_start_function = void (*)(std::uint32_t stride);
using recorder_counts_function = RecordedRays (*)();
/// Processor time of all calls that were kept, once more, while the bake's scene still lives. They are used up.
using recorder_replay_function = double (*)();
}
