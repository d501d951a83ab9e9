// Makes all parts of a surface from a scene's facets, and anew those that a refinement changes.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "surface/surface_parts.h"

namespace radvor {

/// Facets whose sites are no longer what their triangles were made from, ascending, with all their inner sites.
struct ChangedFacets {
  explicit ChangedFacets(std::pmr::memory_resource* memory) : facets(memory), first_inner(memory), inner(memory) {}

  std::span<const InnerSite> inner_of(std::size_t k) const {
    return std::span(inner).subspan(first_inner[k], first_inner[k + 1] - first_inner[k]);
  }

  std::pmr::vector<std::uint32_t> facets;
  std::pmr::vector<std::uint32_t> first_inner;  ///< per facet, and one past the last
  std::pmr::vector<InnerSite> inner;
};

/// Sites, and the facets' triangles. All else is still to come: refinement may raise sites before that.
void draft_surface(SurfaceParts& parts);

/// Makes the changed facets' triangles anew, and then all shares and samples, of a surface that is drafted.
void finish_surface(SurfaceParts& parts, const ChangedFacets& changed);

/// Makes the changed facets' triangles, and all shares and samples. Returns an origin for each sample.
std::pmr::vector<SampleOrigin> remake_surface(SurfaceParts& parts, const ChangedFacets& changed);

}  // namespace radvor
