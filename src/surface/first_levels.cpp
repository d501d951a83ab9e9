#include "surface/first_levels.h"

#include <algorithm>
#include <cmath>

namespace radvor {

namespace {

double spacing_of(const SurfaceOptions& options, std::uint32_t level) {
  return std::ldexp(options.patch_spacing, -static_cast<int>(options.element_levels + level));
}

std::uint32_t least_limit(std::size_t most, std::size_t max_sites) {
  most = std::min<std::size_t>(most, k_none);
  return static_cast<std::uint32_t>(max_sites > 0 ? std::min(most, max_sites) : most);
}

// The sharp edges at which something adjoins, with their ends, of facets that receive and have at least an area.
class Borders {
 public:
  Borders(const Surface& surface, double least_area, std::pmr::memory_resource* memory)
      : edges_(surface.welded().edges.size(), 0, memory), vertices_(surface.welded().positions.size(), 0, memory) {
    const WeldedScene& welded = surface.welded();
    const Facets& facets = surface.facets();
    for (std::uint32_t edge = 0; edge < welded.edges.size(); ++edge) {
      if (facets.edge_kinds[edge] != EdgeKind::sharp) {
        continue;
      }
      const auto uses = welded.uses_at_edge(edge);
      if (uses.size() == 1 && welded.uses_by_triangle[uses[0]].side != k_no_side) {
        continue;  // the surface ends there, and no other begins
      }
      edges_[edge] = std::any_of(uses.begin(), uses.end(), [&](std::uint32_t use) {
        const std::uint32_t triangle = welded.uses_by_triangle[use].triangle;
        return facets.facets[facets.facet_of_triangle[triangle]].area >= least_area &&
               surface.scene().meshes[welded.triangles[triangle].mesh].receives;
      });
      vertices_[welded.edges[edge].a] |= edges_[edge];
      vertices_[welded.edges[edge].b] |= edges_[edge];
    }
  }

  bool carry(const Site& site) const {
    return (site.edge != k_none && edges_[site.edge] != 0) || (site.vertex != k_none && vertices_[site.vertex] != 0);
  }

 private:
  std::pmr::vector<std::uint8_t> edges_, vertices_;
};

}  // namespace

void raise_first_levels(Surface& surface, const SurfaceOptions& options, std::pmr::memory_resource* memory) {
  raise_borders(surface, options, memory);
  resolve_gaps(surface, options, memory);
}

void raise_borders(Surface& surface, const SurfaceOptions& options, std::pmr::memory_resource* memory) {
  const std::size_t first = surface.sites().size();
  if (options.max_sites != 0 && options.max_sites <= first) {
    return;
  }
  const std::uint32_t most =
      least_limit(4 * first + 8192, options.max_sites == 0 ? 0 : first + (options.max_sites - first) / 2);
  for (std::uint32_t level = 1; level <= std::min(options.border_levels, surface.max_level()); ++level) {
    const double cell = spacing_of(options, level);
    const Borders borders(surface, cell * cell, memory);
    std::pmr::vector<std::uint32_t> raised(memory);
    const auto sites = surface.sites();
    for (std::uint32_t site = 0; site < sites.size(); ++site) {
      if (surface.level_of(site) + 1 == level && borders.carry(sites[site])) {
        raised.push_back(site);
      }
    }
    surface.raise(raised, most);
  }
}

void resolve_gaps(Surface& surface, const SurfaceOptions& options, std::pmr::memory_resource* memory) {
  const std::size_t first = surface.sites().size();
  const std::uint32_t most = least_limit(first + first / 4 + 4096, options.max_sites);
  for (auto wide = sites_wider_than_gaps(surface, options, memory); !wide.empty() && surface.sites().size() < most;
       wide = sites_wider_than_gaps(surface, options, memory)) {
    const std::size_t before = surface.sites().size();
    surface.raise(wide, most);
    if (surface.sites().size() == before) {
      break;  // the next one would lead beyond
    }
  }
}

std::pmr::vector<std::uint32_t> sites_wider_than_gaps(const Surface& surface, const SurfaceOptions& options,
                                                      std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> wide(memory);
  const auto& contacts = surface.facets().contacts.edges;
  if (surface.max_level() == 0 || contacts.empty()) {
    return wide;
  }
  const std::uint32_t first_edge = contacts.front().edge;  // they are numbered one after the other
  const auto sites = surface.sites();
  for (std::uint32_t site = 0; site < sites.size(); ++site) {
    if (sites[site].edge == k_none || sites[site].edge < first_edge) {
      continue;
    }
    const double gap = contacts[sites[site].edge - first_edge].gap;
    const std::uint32_t level = surface.level_of(site);
    if (gap > 0 && level < surface.max_level() && spacing_of(options, level) > std::max(gap, options.contact_spacing)) {
      wide.push_back(site);
    }
  }
  return wide;
}

}  // namespace radvor
