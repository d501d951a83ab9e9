// What bounds and cuts a facet: its welded edges other than those that leave no trace, and its contacts with other
// surfaces, each with the kind of constraint it is in the facet's triangulation.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "scene/facets.h"
#include "scene/welded.h"

namespace radvor {

struct OutlineEdge {
  std::uint32_t edge;
  std::uint8_t flags;                  ///< delaunay::constraint
  std::uint32_t first_use, use_count;  ///< contacts have none
};

struct FacetOutline {
  /// edges come by welded number.
  FacetOutline(const WeldedScene& welded, const Facets& facets, std::uint32_t facet, std::pmr::memory_resource* memory);

  std::span<const EdgeUse> uses_of(const OutlineEdge& edge) const {
    return std::span<const EdgeUse>(uses).subspan(edge.first_use, edge.use_count);
  }

  std::pmr::vector<EdgeUse> uses;
  std::pmr::vector<OutlineEdge> edges;
  std::pmr::vector<std::uint32_t> vertices;  ///< welded, ascending: their ends
  bool sound = true;                         ///< no edge has more than two of the facet's triangles
};

}  // namespace radvor
