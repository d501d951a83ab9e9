// Where other surfaces touch a facet, cut through it or come close: segments across which its light may jump. Each is
// an edge of the welded scene like those of triangles, but inside one facet.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace radvor {

/// Meets others, and the facet's outline, in its ends alone, but for rounding.
struct ContactEdge {
  std::uint32_t edge;  ///< welded
  double gap;          ///< to what makes it, along the facet's normal, scene units; 0: it touches or cuts
};

/// Of all facets; a facet that nothing touches has none.
class Contacts {
 public:
  explicit Contacts(std::pmr::memory_resource* memory) : edges(memory), first_edge(memory) {}

  std::span<const ContactEdge> of_facet(std::uint32_t facet) const {
    if (first_edge.empty()) {
      return {};
    }
    return std::span(edges).subspan(first_edge[facet], first_edge[facet + 1] - first_edge[facet]);
  }

  std::pmr::vector<ContactEdge> edges;         ///< grouped by facet
  std::pmr::vector<std::uint32_t> first_edge;  ///< per facet, and one past the last; empty: not sought
};

}  // namespace radvor
