// Shadows from the shooter's side: rays from each source through the occluders find the places that they hide it from,
// however small. What lies between all samples and probes is found by nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/host.h"
#include "radiosity/direct_light.h"
#include "radiosity/receiver.h"
#include "radiosity/tracer.h"
#include "surface/surface.h"

namespace radvor {

/// Where one triangle's shadow falls.
struct CastShadow {
  std::uint32_t source;
  std::uint32_t facet;
  bool back;
  Vec2 at;      ///< in the facet's plane
  double area;  ///< of the shadow there, scene units squared
  Receiver receiver;
};

/// A place in the shadow, and its direct light by all sources: what the mesh has to tell there.
struct Shadowed {
  std::uint32_t facet;
  bool back;
  Vec2 at;
  double area;       ///< scene units squared: of the shadows that fall in its triangle, at most the triangle's
  Color light{0.0};  ///< irradiance, W m^-2
};

class Silhouettes {
 public:
  /// occluders: the welded triangle of each triangle given to the visibility. Keeps references to all arguments.
  Silhouettes(const Surface& surface, const DirectLight& light, std::span<const std::uint32_t> occluders, Host& host)
      : surface_(surface), light_(light), occluders_(occluders), host_(host), casts_(&host.memory) {}

  /// Pairs of a source and an occluder, in blocks that are cast by themselves.
  static constexpr std::uint32_t k_block = 256;
  std::uint32_t block_count() const;
  void cast(std::uint32_t block, Tracer& tracer, std::span<std::optional<CastShadow>> shadows) const;
  void keep(std::span<const std::optional<CastShadow>> shadows);

  /// For each triangle of the mesh and source that shadows fall in, the largest; casts are forgotten.
  std::pmr::vector<CastShadow> largest_of_each();

 private:
  std::optional<CastShadow> cast(std::uint32_t source, std::uint32_t occluder, Tracer& tracer) const;
  std::uint64_t pairs() const { return std::uint64_t{light_.source_count()} * occluders_.size(); }
  std::uint64_t stride() const;

  const Surface& surface_;
  const DirectLight& light_;
  std::span<const std::uint32_t> occluders_;
  Host& host_;
  std::pmr::vector<CastShadow> casts_;
};

}  // namespace radvor
