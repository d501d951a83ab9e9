#include "surface/facet_outline.h"

#include <algorithm>

#include "delaunay/triangulation.h"

namespace radvor {

namespace {

// An edge with the facet on one side is a border. With the facet on both sides light may still differ between them,
// as where a wall without thickness stands on the facet: a slit.
std::uint8_t flags_of(EdgeKind kind, std::uint32_t uses) {
  if (uses == 1) {
    return delaunay::constraint::k_border;
  }
  return kind == EdgeKind::sharp ? delaunay::constraint::k_discontinuous : delaunay::constraint::k_continuous;
}

}  // namespace

FacetOutline::FacetOutline(const WeldedScene& welded, const Facets& facets, std::uint32_t facet,
                           std::pmr::memory_resource* memory)
    : uses(memory), edges(memory), vertices(memory) {
  for (const std::uint32_t triangle : facets.triangles_of(facet)) {
    for (const EdgeUse& use : welded.uses_of_triangle(triangle)) {
      if (facets.edge_kinds[use.edge] != EdgeKind::interior) {
        uses.push_back(use);
      }
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  for (std::uint32_t first = 0; first < uses.size();) {
    std::uint32_t end = first + 1;
    while (end < uses.size() && uses[end].edge == uses[first].edge) {
      ++end;
    }
    const std::uint32_t edge = uses[first].edge;
    edges.push_back({edge, flags_of(facets.edge_kinds[edge], end - first), first, end - first});
    sound = sound && end - first <= 2;
    vertices.push_back(welded.edges[edge].a);
    vertices.push_back(welded.edges[edge].b);
    first = end;
  }
  for (const ContactEdge& contact : facets.contacts.of_facet(facet)) {
    edges.push_back({contact.edge, delaunay::constraint::k_discontinuous, 0, 0});
    vertices.push_back(welded.edges[contact.edge].a);
    vertices.push_back(welded.edges[contact.edge].b);
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

}  // namespace radvor
