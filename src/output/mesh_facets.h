// Which facets make up one mesh.
#pragma once

#include <algorithm>
#include <cstdint>

#include "scene/facets.h"

namespace radvor {

/// first <= facet < last.
struct FacetRange {
  std::uint32_t first, last;
};

/// Facets are numbered by their meshes first, so a mesh's are neighbours.
inline FacetRange facets_of_mesh(const Facets& facets, std::uint32_t mesh) {
  const auto first = std::ranges::lower_bound(facets.facets, mesh, {}, &Facet::mesh);
  const auto last = std::ranges::upper_bound(first, facets.facets.end(), mesh, {}, &Facet::mesh);
  return {static_cast<std::uint32_t>(first - facets.facets.begin()),
          static_cast<std::uint32_t>(last - facets.facets.begin())};
}

}  // namespace radvor
