// What a surface was before a refinement, and where in it each new sample's light comes from: the sample of the same
// sector where there was one, else linear interpolation in the old triangle at the receiver's point.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/steps.h"
#include "surface/surface_parts.h"

namespace radvor {

struct SurfaceBefore {
  /// Takes shares, samples and their details away, and copies the rest. changed: facets.
  SurfaceBefore(SurfaceParts& parts, std::span<const std::uint32_t> changed);

  bool is_changed(std::uint32_t facet) const { return changed[facet] != 0; }

  /// The surface becomes as it was, and this what it is to be; and back.
  void trade_places(SurfaceParts& parts);

  RawVector<Share> shares;
  RawVector<Sample> samples;
  ShareDetails details;
  std::pmr::vector<FacetRecord> records;  ///< their meshes are still there
  std::pmr::vector<ShareTriangle> small_triangles;
  std::pmr::vector<std::uint8_t> changed;  ///< per facet
};

/// origins: one a sample of the surface as it is now.
Steps find_origins(const SurfaceParts& parts, const SurfaceBefore& before, std::span<const std::uint32_t> changed,
                   std::pmr::vector<SampleOrigin>& origins, Pace& pace);

}  // namespace radvor
