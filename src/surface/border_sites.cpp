#include "surface/border_sites.h"

#include <algorithm>
#include <cmath>

#include "surface/lattice.h"

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

BorderSites::BorderSites(const Scene& scene, const WeldedScene& welded, const Facets& facets,
                         const SurfaceOptions& options, std::pmr::memory_resource* memory)
    : welded_(welded),
      // As the facets' lattices have it, so that border sites and lattices line up.
      spacing_(FacetLattice(options.lattice, options.patch_spacing, Vec2(0.0)).column(options.element_levels)),
      unit_(std::ldexp(spacing_, -static_cast<int>(refinements(options)))),
      of_vertex_(welded.positions.size(), k_none, memory),
      ranges_(welded.edges.size(), memory),
      sites_(memory),
      carries_(welded.edges.size(), std::uint8_t{0}, memory),
      joins_(welded.edges.size(), std::uint8_t{0}, memory) {
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
      carries_[edge] = 1;
      joins_[edge] = joins_fronts(welded, facets, scene, edge) ? 1 : 0;
    }
  }
  std::uint32_t next = 0;
  for (std::uint32_t& site : of_vertex_) {
    if (site == k_marked) {
      site = next++;
    }
  }
  const std::int64_t step = std::int64_t{1} << refinements(options);
  for (std::uint32_t edge = 0; edge < welded.edges.size(); ++edge) {
    const std::int64_t outward = carries(edge) ? line(edge).steps(spacing_) : -1;
    ranges_[edge].first = static_cast<std::uint32_t>(sites_.size());
    for (std::int64_t k = -outward; k <= outward; ++k) {
      sites_.push_back({next++, k * step});
    }
    ranges_[edge].count = static_cast<std::uint32_t>(sites_.size()) - ranges_[edge].first;
  }
  first_count_ = next;
}

std::pmr::vector<Site> BorderSites::list() const {
  std::pmr::vector<Site> sites(first_count_, of_vertex_.get_allocator());
  for (std::uint32_t vertex = 0; vertex < of_vertex_.size(); ++vertex) {
    if (of_vertex_[vertex] != k_none) {
      sites[of_vertex_[vertex]].position = welded_.positions[vertex];
      sites[of_vertex_[vertex]].vertex = vertex;
    }
  }
  for (std::uint32_t edge = 0; edge < welded_.edges.size(); ++edge) {
    if (ranges_[edge].count > 0) {
      const EdgeLine along = line(edge);
      for (const EdgeSite& site : on_edge(edge)) {
        sites[site.site].position = along.position(from_middle(site.step));
        sites[site.site].edge = edge;
      }
    }
  }
  return sites;
}

EdgeLine BorderSites::line(std::uint32_t edge) const {
  const Edge& ends = welded_.edges[edge];
  return {welded_.positions[ends.a], welded_.positions[ends.b]};
}

void BorderSites::insert(std::uint32_t edge, std::span<const EdgeSite> more) {
  const Range old = ranges_[edge];
  const auto first = static_cast<std::uint32_t>(sites_.size());
  sites_.resize(first + old.count + more.size());  // what was there before stays behind, less than what is added
  std::merge(sites_.begin() + old.first, sites_.begin() + old.first + old.count, more.begin(), more.end(),
             sites_.begin() + first, [](const EdgeSite& a, const EdgeSite& b) { return a.step < b.step; });
  ranges_[edge] = {first, static_cast<std::uint32_t>(sites_.size()) - first};
}

}  // namespace radvor
