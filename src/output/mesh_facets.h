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
  const auto range = std::ranges::equal_range(facets.facets, mesh, {}, &Facet::mesh);
  const auto first = static_cast<std::uint32_t>(range.begin() - facets.facets.begin());
  return {first, first + static_cast<std::uint32_t>(range.size())};
}

}  // namespace radvor
