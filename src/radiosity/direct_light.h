// The light sources of a scene that have a direction or a place, ready to shine on receivers: points, spots, suns, and
// surfaces that emit. The sky is seen by the rays of gather.h.
#pragma once

#include <array>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/host.h"
#include "radiosity/emitter.h"
#include "radiosity/occluder_tree.h"
#include "radiosity/receiver.h"
#include "radiosity/tracer.h"
#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

class DirectLight {
 public:
  /// With `occluders`, which must outlive this, surfaces that emit are seen past them exactly (emitter.h).
  DirectLight(const Scene& scene, const WeldedScene& welded, const Facets& facets, const OccluderTree* occluders,
              double tolerance, Host& host);

  /// A source is one light, or the emitting triangles of one facet and side. Dark ones and skies are none.
  std::uint32_t source_count() const;

  /// What one source adds at a receiver, W m^-2, and how much of it is seen.
  Color irradiance(std::uint32_t source, const Receiver& receiver, Tracer& tracer, Sight& sight) const;

  /// How light from the middle of a source comes to a place; nothing where it does not: behind a surface that emits.
  struct Beam {
    Vec3 way;         ///< unit, as the light travels
    double distance;  ///< from the source; infinite for a sun
  };
  std::optional<Beam> beam(std::uint32_t source, const Vec3& to) const;

  /// What one source gives a receiver if nothing stands between, roughly: surfaces that emit as if they were in their
  /// middle. And the place that is seen from the receiver if nothing does.
  struct Aim {
    Color irradiance{0.0};
    Vec3 at{0.0};
    bool near = false;  ///< a surface that emits, so near that its middle says little
  };
  Aim aim(std::uint32_t source, const Receiver& receiver) const;

  std::span<const Light> punctual_lights() const { return punctual_; }
  std::span<const Emitter> emitters() const { return emitters_; }
  /// All skies together, W sr^-1 m^-2.
  const Color& sky_radiance() const { return sky_radiance_; }
  /// Leads out of the scene from anywhere in it.
  double far() const { return far_; }

 private:
  struct EmitterRange {
    std::uint32_t first, count;
    double area = 0;
    Vec3 middle{0.0}, normal{0.0};
    std::optional<std::array<Vec3, 4>> panel{};  // two triangles that make up a convex quadrilateral
  };
  static std::optional<std::array<Vec3, 4>> panel_of(std::span<const Emitter> emitters);

  const OccluderTree* occluders_;
  std::pmr::vector<Light> punctual_;
  std::pmr::vector<Emitter> emitters_;
  std::pmr::vector<EmitterRange> emitting_facets_;
  Color sky_radiance_{0.0};
  EmitterAccuracy accuracy_;
  double far_ = 1;
};

}  // namespace radvor
