// How much of a bake is ray casting: the bake alone, then once more with its rays recorded, then the rays in a bare
// loop.
#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "baked_scene.h"
#include "modes.h"
#include "processor_time.h"
#include "ray_recorder.h"
#include "scene_source.h"

namespace bench {
namespace {

constexpr std::uint64_t k_most_recorded = 16'000'000;  // rays; 48 to 80 bytes each in packets, 256 alone

class Recorder {
 public:
  Recorder() : library_(dlopen(RADVOR_RAY_RECORDER, RTLD_NOW | RTLD_LOCAL)) {
    if (!library_) {
      throw std::runtime_error(dlerror());
    }
  }
  template <class Function>
  Function function(const char* name) const {
    void* const found = dlsym(library_, name);
    if (!found) {
      throw std::runtime_error(dlerror());
    }
    return reinterpret_cast<Function>(found);
  }

 private:
  void* library_;
};

double bake_seconds(bake::BakedScene& baked) {
  const double begin = processor_seconds();
  baked.run(nullptr, nullptr);
  return processor_seconds() - begin;
}

}  // namespace

int replay_mode(int argc, const char* const* argv) {
  std::optional<bake::Options> options = bake::parse_options(argc, argv);
  if (!options) {
    return 0;
  }
  options->threads = 1;
  const bake::SceneData scene = load_scene(options->scene);
  double seconds = 0;
  std::uint64_t rays = 0;
  {
    bake::BakedScene baked(scene, *options, nullptr, nullptr);
    seconds = bake_seconds(baked);
    rays = baked.stats().rays;
  }
  const Recorder recorder;
  const auto stride = static_cast<std::uint32_t>(1 + rays / k_most_recorded);
  recorder.function<recorder_start_function>("recorder_start")(stride);
  options->embree = RADVOR_RAY_RECORDER;
  bake::BakedScene again(scene, *options, nullptr, nullptr);
  const double recorded_seconds = bake_seconds(again);
  const RecordedRays counts = recorder.function<recorder_counts_function>("recorder_counts")();
  const double replayed = recorder.function<recorder_replay_function>("recorder_replay")();
  const double bare = counts.recorded_rays > 0
                          ? replayed * static_cast<double>(counts.rays) / static_cast<double>(counts.recorded_rays)
                          : 0;
  const nlohmann::json json{{"cpu_seconds", seconds},
                            {"cpu_seconds_recording", recorded_seconds},
                            {"rays_by_its_statistics", rays},
                            {"rays", counts.rays},
                            {"calls", counts.calls},
                            {"recorded_rays", counts.recorded_rays},
                            {"build_cpu_seconds", counts.build_cpu_seconds},
                            {"bare_loop_cpu_seconds", bare}};
  std::printf("%s\n", json.dump().c_str());
  return 0;
}

}  // namespace bench
