// What came out of a refinement: the facets whose sites changed, with all that they have now; new sites and the two
// that each lies between.
#include <algorithm>

#include "surface/refinement.h"

namespace radvor {

void Refinement::find_parents(std::uint32_t index) {
  Site& site = parts_.sites[index];
  const SitePlace& place = parts_.places[index];
  const auto adopt = [&](std::uint32_t a, std::uint32_t b) {
    if (a != k_none && b != k_none) {
      site.parents = {a, b};
    }
    return a != k_none && b != k_none;
  };
  const std::uint8_t level = place.on_lattice ? coarsest(place.index.i, place.index.j) : site.level;
  if (level == 0 || (!place.on_lattice && site.edge == k_none)) {
    return;
  }
  const std::int64_t half = step(level);
  if (site.edge != k_none) {
    adopt(find_edge_site(site.edge, place.index.i - half), find_edge_site(site.edge, place.index.i + half));
    return;
  }
  const auto across = [&](std::int64_t i, std::int64_t j) {
    return adopt(find_lattice_site(place.facet, {place.index.i - i, place.index.j - j}),
                 find_lattice_site(place.facet, {place.index.i + i, place.index.j + j}));
  };
  const std::int64_t i = place.index.i % (2 * half) != 0 ? half : 0;
  const std::int64_t j = place.index.j % (2 * half) != 0 ? half : 0;
  const bool crosswise = i != 0 && j != 0;  // on the hexagonal lattice that way alone leads to neighbours
  if (!across(crosswise ? -i : i, j) && crosswise && parts_.options.lattice == Lattice::quadrilateral) {
    across(i, j);
  }
}

ChangedFacets Refinement::take_changes() {
  struct NewOnEdge {
    std::uint32_t edge;
    EdgeSite site;
  };
  struct NewInside {
    std::uint32_t facet, site;
  };
  std::pmr::vector<NewOnEdge> on_edges(parts_.memory);
  std::pmr::vector<NewInside> inside(parts_.memory);
  ChangedFacets changed(parts_.memory);
  for (std::uint32_t site = first_new_; site < parts_.sites.size(); ++site) {
    find_parents(site);
    if (parts_.sites[site].vertex != k_none) {
      continue;  // of a facet that has become degenerate, and is made of its own triangles
    }
    if (parts_.sites[site].edge != k_none) {
      on_edges.push_back({parts_.sites[site].edge, {site, parts_.places[site].index.i}});
    } else {
      inside.push_back({parts_.places[site].facet, site});
      changed.facets.push_back(parts_.places[site].facet);
    }
  }
  std::sort(on_edges.begin(), on_edges.end(), [](const NewOnEdge& a, const NewOnEdge& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.site.step < b.site.step;
  });
  std::pmr::vector<EdgeSite> more(parts_.memory);
  for (std::size_t k = 0; k < on_edges.size(); ++k) {
    more.push_back(on_edges[k].site);
    if (k + 1 == on_edges.size() || on_edges[k + 1].edge != on_edges[k].edge) {
      parts_.borders.insert(on_edges[k].edge, more);
      more.clear();
      for (const std::uint32_t use : parts_.welded.uses_at_edge(on_edges[k].edge)) {
        const std::uint32_t facet = parts_.facets.facet_of_triangle[parts_.welded.uses_by_triangle[use].triangle];
        if (parts_.records[facet].first_share != k_none) {
          changed.facets.push_back(facet);
        }
      }
    }
  }
  std::sort(changed.facets.begin(), changed.facets.end());
  changed.facets.erase(std::unique(changed.facets.begin(), changed.facets.end()), changed.facets.end());
  std::sort(inside.begin(), inside.end(), [](const NewInside& a, const NewInside& b) {
    return a.facet != b.facet ? a.facet < b.facet : a.site < b.site;
  });

  auto next = inside.begin();
  for (const std::uint32_t facet : changed.facets) {
    changed.first_inner.push_back(static_cast<std::uint32_t>(changed.inner.size()));
    const auto add = [&](std::uint32_t site) {
      const SitePlace& place = parts_.places[site];
      if (!place.on_lattice) {
        changed.inner.push_back(*std::lower_bound(irregular_.begin(), irregular_.end(), site,
                                                  [](const InnerSite& a, std::uint32_t b) { return a.site < b; }));
        return;
      }
      changed.inner.push_back({ground(facet).lattice().point(lattice_finest_, place.index), site});
    };
    const auto given = parts_.given_on(facet);
    changed.inner.insert(changed.inner.end(), given.begin(), given.end());
    if (parts_.records[facet].mesh != k_none) {
      const FacetMesh& mesh = *parts_.meshes[parts_.records[facet].mesh];
      const auto old = mesh.sites().subspan(mesh.border_count());
      for (const std::uint32_t site : old.subspan(std::min(given.size(), old.size()))) {
        add(site);
      }
    }
    for (; next != inside.end() && next->facet == facet; ++next) {
      add(next->site);
    }
  }
  changed.first_inner.push_back(static_cast<std::uint32_t>(changed.inner.size()));
  first_new_ = static_cast<std::uint32_t>(parts_.sites.size());
  return changed;
}

}  // namespace radvor
