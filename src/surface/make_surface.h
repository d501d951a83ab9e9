// Makes all parts of a surface from a scene's facets, and anew those that a refinement changes.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/steps.h"
#include "surface/sample_origins.h"
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

struct Remaking {
  explicit Remaking(std::pmr::memory_resource* memory) : origins(memory) {}

  std::optional<SurfaceBefore> before;     ///< while there is something that it may be shown instead of
  std::pmr::vector<SampleOrigin> origins;  ///< of each sample, at the end
};

/// Makes the changed facets' triangles, and all shares and samples. Where it pauses the surface is not whole: while
/// there is remaking.before, its trade_places() shows the surface as it was, and must be called again to go on.
Steps remake_surface(SurfaceParts& parts, const ChangedFacets& changed, Remaking& remaking, Pace& pace);

}  // namespace radvor
