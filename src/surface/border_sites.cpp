#include "surface/border_sites.h"

namespace radvor {

namespace {

constexpr std::uint32_t k_marked = 0;

bool joins_fronts(const WeldedScene& welded, const Facets& facets, const Scene& scene, std::uint32_t edge) {
  const auto uses = welded.uses_at_edge(edge);
  if (facets.edge_kinds[edge] != EdgeKind::smooth || uses.size() != 2) {
    return false;
  }
  const EdgeUse& one = welded.uses_by_triangle[uses[0]];
  const EdgeUse& other = welded.uses_by_triangle[uses[1]];
  return one.forward != other.forward &&
         facets.facet_of_triangle[one.triangle] != facets.facet_of_triangle[other.triangle] &&
         scene.meshes[welded.triangles[one.triangle].mesh].receives &&
         scene.meshes[welded.triangles[other.triangle].mesh].receives;
}

}  // namespace

BorderSites::BorderSites(const Scene& scene, const WeldedScene& welded, const Facets& facets, double spacing,
                         std::pmr::memory_resource* memory)
    : welded_(welded),
      spacing_(spacing),
      of_vertex_(welded.positions.size(), k_none, memory),
      first_of_edge_(welded.edges.size() + 1, 0u, memory),
      joins_(welded.edges.size(), std::uint8_t{0}, memory) {
  std::pmr::vector<std::uint32_t> counts(welded.edges.size(), 0u, memory);
  for (std::uint32_t edge = 0; edge < welded.edges.size(); ++edge) {
    if (facets.edge_kinds[edge] == EdgeKind::interior) {
      continue;
    }
    bool receives = false;
    for (const std::uint32_t use : welded.uses_at_edge(edge)) {
      receives = receives || scene.meshes[welded.triangles[welded.uses_by_triangle[use].triangle].mesh].receives;
    }
    if (receives) {
      of_vertex_[welded.edges[edge].a] = of_vertex_[welded.edges[edge].b] = k_marked;
      counts[edge] = along(edge).count();
      joins_[edge] = joins_fronts(welded, facets, scene, edge) ? 1 : 0;
    }
  }
  std::uint32_t next = 0;
  for (std::uint32_t& site : of_vertex_) {
    if (site == k_marked) {
      site = next++;
    }
  }
  for (std::uint32_t edge = 0; edge < welded.edges.size(); ++edge) {
    first_of_edge_[edge] = next;
    next += counts[edge];
  }
  first_of_edge_.back() = next;
}

std::pmr::vector<Site> BorderSites::list() const {
  std::pmr::vector<Site> sites(size(), of_vertex_.get_allocator());
  for (std::uint32_t vertex = 0; vertex < of_vertex_.size(); ++vertex) {
    if (of_vertex_[vertex] != k_none) {
      sites[of_vertex_[vertex]] = {welded_.positions[vertex], vertex, k_none};
    }
  }
  for (std::uint32_t edge = 0; edge < welded_.edges.size(); ++edge) {
    const std::uint32_t count = count_on_edge(edge);
    if (count > 0) {
      const EdgeSites inner = along(edge);
      for (std::uint32_t index = 0; index < count; ++index) {
        sites[first_on_edge(edge) + index] = {inner.position(index), k_none, edge};
      }
    }
  }
  return sites;
}

EdgeSites BorderSites::along(std::uint32_t edge) const {
  const Edge& ends = welded_.edges[edge];
  return {welded_.positions[ends.a], welded_.positions[ends.b], spacing_};
}

}  // namespace radvor
