// Where light ends that no receiver takes: out of the scene, or on backs. Measured by rays of its own, so that the
// energy account closes only if the transport is right.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "radiosity/direct_light.h"
#include "radiosity/tracer.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

class FateMeter {
 public:
  /// occluders: the welded triangle of each triangle given to the visibility. tolerance: what is told of each kind of
  /// source has a standard error of a fifth of it, in shares of what it emits, but of 0.4 % at best. Keeps references
  /// to all arguments.
  FateMeter(const Scene& scene, const WeldedScene& welded, const Visibility& visibility,
            std::span<const std::uint32_t> occluders, double tolerance, std::uint64_t seed);

  struct Powers {
    double emitted = 0, escaped = 0, backs = 0;  ///< W, RGB summed
    std::uint64_t rays = 0;
  };

  /// What the light sources emit and what becomes of it before the first reflection. Sun and sky emit what enters the
  /// scene's bounding sphere.
  Powers of_sources(const DirectLight& light, Host& host) const;

 private:
  enum class End { receiver, back, escape };
  End follow(const Vec3& from, const Vec3& direction) const;

  const Scene& scene_;
  const WeldedScene& welded_;
  const Visibility& visibility_;
  std::span<const std::uint32_t> occluders_;
  std::uint32_t rays_per_kind_;
  std::uint64_t seed_;
};

}  // namespace radvor
