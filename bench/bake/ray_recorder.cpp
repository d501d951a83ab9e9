#include "ray_recorder.h"

#include <dlfcn.h>
#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <vector>

#include "processor_time.h"

namespace {

constexpr std::uint64_t k_run = 64;

template <class Function>
Function* in_embree(Function*, const char* name) {
  static void* const library = dlopen("libembree3.so.3", RTLD_NOW | RTLD_LOCAL);
  void* const function = library ? dlsym(library, name) : nullptr;
  if (!function) {
    std::abort();
  }
  return reinterpret_cast<Function*>(function);
}

/// A call as it came. Structs are kept whole, so that the bare loop copies nothing.
template <class Rays>
struct Call {
  alignas(64) Rays rays;
  alignas(64) int valid[16];
  RTCScene scene;
  RTCIntersectContextFlags flags;
};

struct Recorder {
  std::uint32_t stride = 1;
  RecordedRays counts{};
  std::deque<Call<RTCRay>> occluded_1;  // a deque: growing moves nothing, so recording stays cheap
  std::deque<Call<RTCRay4>> occluded_4;
  std::deque<Call<RTCRay8>> occluded_8;
  std::deque<Call<RTCRay16>> occluded_16;
  std::deque<Call<RTCRayHit>> intersect_1;
  std::deque<Call<RTCRayHit4>> intersect_4;
  std::deque<Call<RTCRayHit8>> intersect_8;
  std::deque<Call<RTCRayHit16>> intersect_16;
};
Recorder recorder;

template <class Rays>
void record(std::deque<Call<Rays>>& calls, const int* valid, std::size_t lanes, RTCScene scene,
            const RTCIntersectContext* context, const Rays& rays) {
  std::uint64_t live = lanes == 1 ? 1 : 0;
  for (std::size_t lane = 0; valid && lane < lanes; ++lane) {
    live += valid[lane] != 0 ? 1 : 0;
  }
  RecordedRays& counts = recorder.counts;
  const bool kept = counts.calls / k_run % recorder.stride == 0;
  ++counts.calls;
  counts.rays += live;
  if (!kept) {
    return;
  }
  ++counts.recorded_calls;
  counts.recorded_rays += live;
  Call<Rays>& call = calls.emplace_back();
  call.rays = rays;
  if (valid) {
    std::memcpy(call.valid, valid, lanes * sizeof(int));
  }
  call.scene = scene;
  call.flags = context->flags;
}

template <class Rays, class Cast>
void replay(std::deque<Call<Rays>>& calls, const Cast& cast) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (Call<Rays>& call : calls) {
    context.flags = call.flags;
    cast(call, &context);
  }
}

template <class Commit>
void timed(Commit* commit, RTCScene scene) {
  const double begin = bench::processor_seconds();
  commit(scene);
  recorder.counts.build_cpu_seconds += bench::processor_seconds() - begin;
}

}  // namespace

#define RADVOR_IN_EMBREE(name) in_embree(&name, #name)
#define RADVOR_RECORD_PACKET(lanes)                                                                                  \
  void rtcOccluded##lanes(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay##lanes* rays) {     \
    static auto* const cast = RADVOR_IN_EMBREE(rtcOccluded##lanes);                                                  \
    record(recorder.occluded_##lanes, valid, lanes, scene, context, *rays);                                          \
    cast(valid, scene, context, rays);                                                                               \
  }                                                                                                                  \
  void rtcIntersect##lanes(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit##lanes* rays) { \
    static auto* const cast = RADVOR_IN_EMBREE(rtcIntersect##lanes);                                                 \
    record(recorder.intersect_##lanes, valid, lanes, scene, context, *rays);                                         \
    cast(valid, scene, context, rays);                                                                               \
  }
#define RADVOR_REPLAY_PACKET(lanes)                                                                              \
  replay(recorder.occluded_##lanes, [cast = RADVOR_IN_EMBREE(rtcOccluded##lanes)](auto& call, auto* context) {   \
    cast(call.valid, call.scene, context, &call.rays);                                                           \
  });                                                                                                            \
  replay(recorder.intersect_##lanes, [cast = RADVOR_IN_EMBREE(rtcIntersect##lanes)](auto& call, auto* context) { \
    cast(call.valid, call.scene, context, &call.rays);                                                           \
  });

extern "C" {

RADVOR_RECORD_PACKET(4)
RADVOR_RECORD_PACKET(8)
RADVOR_RECORD_PACKET(16)

void rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  static auto* const cast = RADVOR_IN_EMBREE(rtcOccluded1);
  record(recorder.occluded_1, nullptr, 1, scene, context, *ray);
  cast(scene, context, ray);
}

void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
  static auto* const cast = RADVOR_IN_EMBREE(rtcIntersect1);
  record(recorder.intersect_1, nullptr, 1, scene, context, *ray);
  cast(scene, context, ray);
}

void rtcCommitScene(RTCScene scene) {
  timed(RADVOR_IN_EMBREE(rtcCommitScene), scene);
}

void rtcJoinCommitScene(RTCScene scene) {
  timed(RADVOR_IN_EMBREE(rtcJoinCommitScene), scene);
}

void recorder_start(std::uint32_t stride);
void recorder_start(std::uint32_t stride) {
  recorder = Recorder{};
  recorder.stride = stride;
}

RecordedRays recorder_counts();
RecordedRays recorder_counts() {
  return recorder.counts;
}

double recorder_replay();
double recorder_replay() {
  const double begin = bench::processor_seconds();
  RADVOR_REPLAY_PACKET(16)
  RADVOR_REPLAY_PACKET(8)
  RADVOR_REPLAY_PACKET(4)
  replay(recorder.occluded_1,
         [cast = RADVOR_IN_EMBREE(rtcOccluded1)](auto& call, auto* context) { cast(call.scene, context, &call.rays); });
  replay(recorder.intersect_1, [cast = RADVOR_IN_EMBREE(rtcIntersect1)](auto& call, auto* context) {
    cast(call.scene, context, &call.rays);
  });
  return bench::processor_seconds() - begin;
}

}  // extern "C"
