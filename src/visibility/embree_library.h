// Embree, loaded while the program runs: 3.13 or later of 3, or any 4, told apart by what its device says of itself.
//
// Hosts carry Embrees of their own, linked in and exported, so radvor links to none: it opens a library that stays out
// of the process's symbols, and looks up every function by name in that library alone. Not RTLD_DEEPBIND: it would keep
// that library from the host's symbols too, but its malloc then passes by the sanitizers', which abort.
#pragma once

#include <cstdint>
#include <string_view>

#include "visibility/embree_abi.h"

namespace radvor {

class EmbreeLibrary {
 public:
  /// path: the library file; empty: the system's, the newest supported first.
  /// Throws Error(unsupported) naming what was tried, and why it won't do.
  explicit EmbreeLibrary(std::string_view path);
  ~EmbreeLibrary();
  EmbreeLibrary(const EmbreeLibrary&) = delete;
  EmbreeLibrary& operator=(const EmbreeLibrary&) = delete;

  /// major * 10000 + minor * 100 + patch.
  std::uint32_t version() const noexcept { return version_; }

  // Embree's functions of the same names; their arguments are equal in 3 and 4.
  embree::NewDevice new_device;
  embree::ReleaseDevice release_device;
  embree::GetDeviceProperty get_device_property;
  embree::GetDeviceError get_device_error;
  embree::SetDeviceErrorFunction set_device_error_function;
  embree::SetDeviceMemoryMonitorFunction set_device_memory_monitor_function;
  embree::NewScene new_scene;
  embree::ReleaseScene release_scene;
  embree::SetSceneFlags set_scene_flags;
  embree::SetSceneBuildQuality set_scene_build_quality;
  embree::AttachGeometry attach_geometry;
  embree::CommitScene commit_scene;
  embree::CommitScene join_commit_scene;
  embree::NewGeometry new_geometry;
  embree::ReleaseGeometry release_geometry;
  embree::SetSharedGeometryBuffer set_shared_geometry_buffer;
  embree::CommitGeometry commit_geometry;

  /// rtcOccluded1, 4, 8 or 16. valid: -1 for each lane that takes part, else 0, aligned like the rays; one ray is
  /// valid. Packets are declared coherent: 25 to 40 % faster in large scenes, 8 % slower among 36 triangles.
  template <int N>
  void occluded(const int* valid, embree::Scene* scene, embree::Rays<N>& rays) const {
    const AnyFunction function = N == 1 ? occluded1_ : N == 4 ? occluded4_ : N == 8 ? occluded8_ : occluded16_;
    if (is_3()) {
      embree::Context3 context;
      if constexpr (N == 1) {
        reinterpret_cast<embree::Occluded1In3>(function)(scene, &context, &rays);
      } else {
        context.flags = embree::Context3::k_coherent;
        reinterpret_cast<embree::OccludedIn3<N>>(function)(valid, scene, &context, &rays);
      }
    } else {
      embree::Arguments4 arguments;
      if constexpr (N == 1) {
        reinterpret_cast<embree::Occluded1In4>(function)(scene, &rays, &arguments);
      } else {
        arguments.flags = embree::Arguments4::k_coherent;
        reinterpret_cast<embree::OccludedIn4<N>>(function)(valid, scene, &rays, &arguments);
      }
    }
  }

  /// rtcIntersect1, 4, 8 or 16; the same of `valid`. Packets are declared coherent here too: a sixteenth of a
  /// hemisphere is, to the Cornell box's whole bake 10 to 20 %, to large scenes nothing.
  template <int N>
  void intersect(const int* valid, embree::Scene* scene, embree::RayHits<N>& rays) const {
    const AnyFunction function = N == 1 ? intersect1_ : N == 4 ? intersect4_ : N == 8 ? intersect8_ : intersect16_;
    if (is_3()) {
      embree::Context3 context;
      if constexpr (N == 1) {
        reinterpret_cast<embree::Intersect1In3>(function)(scene, &context, &rays);
      } else {
        context.flags = embree::Context3::k_coherent;
        reinterpret_cast<embree::IntersectIn3<N>>(function)(valid, scene, &context, &rays);
      }
    } else if constexpr (N == 1) {
      reinterpret_cast<embree::Intersect1In4>(function)(scene, &rays, nullptr);
    } else {
      embree::Arguments4 arguments;
      arguments.flags = embree::Arguments4::k_coherent;
      reinterpret_cast<embree::IntersectIn4<N>>(function)(valid, scene, &rays, &arguments);
    }
  }

 private:
  using AnyFunction = void (*)();
  class Attempt;

  bool is_3() const { return version_ < 40000; }

  void* handle_ = nullptr;
  std::uint32_t version_ = 0;
  AnyFunction intersect1_, intersect4_, intersect8_, intersect16_;
  AnyFunction occluded1_, occluded4_, occluded8_, occluded16_;
};

}  // namespace radvor
