// Which sites a refinement inserts. A site that is raised to level k gets
//   on its facet's lattice  the neighbours of levels k and k - 1 (the latter are there already, but near borders)
//   on its borders          the next site of level k along each edge, to either side
//   from a border           the lattice's points of level k within 2.25 spacings, on all facets there
// where they lie inside the facet and half a spacing of level k clear of borders and constraints.
//
// Balance: before a site is raised to level k, what is around it is raised to k - 1: on the lattice its neighbours of
// level k - 1, near borders all sites in the 7 x 7 squares of that spacing about it, on each of its facets.
//
// Both rules name places and levels, not triangles, and neither ever asks for less because more is there: so what
// comes out is the least set that satisfies them, whatever the order.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/steps.h"
#include "scene/index_table.h"
#include "surface/facet_ground.h"
#include "surface/make_surface.h"
#include "surface/marked_squares.h"
#include "surface/surface_parts.h"

namespace radvor {

class Refinement {
 public:
  explicit Refinement(SurfaceParts& parts);

  /// Raises sites by one level each, in order, until one would lead beyond max_sites (0: no limit); appends new ones.
  /// May pause between two of them.
  Steps raise(std::span<const std::uint32_t> sites, std::uint32_t max_sites, Pace& pace);

  /// Inserts irregular sites, in order, until one would lead beyond max_sites: on facets that have a lattice, a quarter
  /// of the smallest spacing clear of all other sites and borders. They are of the level of what is around them, and
  /// obstacles to the lattice from now on: unlike what is raised, when they come does matter.
  void insert(std::span<const WantedSite> wanted, std::uint32_t max_sites);

  /// The facets whose sites raise() and insert() changed, and their sites; the borders get the new sites on their
  /// edges.
  ChangedFacets take_changes();

 private:
  struct Raising {
    std::uint32_t site;
    std::uint8_t level;
  };
  /// A place on a facet's lattice that has no site before a level, since it is too near to an obstacle.
  struct Refused {
    std::uint32_t facet;
    std::uint8_t birth;
    LatticeIndex index;
    bool is_at(std::uint32_t on, const LatticeIndex& there) const {
      return facet == on && index.i == there.i && index.j == there.j;
    }
  };
  static constexpr std::uint8_t k_never = 255;  ///< it is outside

  /// What follows can be undone. Returns how many sites there are.
  std::size_t begin_step();
  bool balance(std::size_t max_sites);
  bool is_free(std::uint32_t facet, const Vec2& point);
  std::uint8_t level_at(std::uint32_t facet, const Vec2& point) const;
  void roll_back(std::size_t sites_before);
  void insert_around(std::uint32_t site, std::uint8_t level);
  void insert_on_lattice(std::uint32_t site, std::uint8_t level);
  void insert_on_edges(std::uint32_t site, std::uint8_t level);
  void insert_beside(std::uint32_t site, std::uint32_t facet, std::uint8_t level);
  std::uint32_t lattice_site(std::uint32_t facet, const LatticeIndex& index, std::uint8_t level, const Vec2& from,
                             double from_clearance);
  void edge_site(std::uint32_t edge, std::int64_t step, std::uint8_t level);

  void mark(std::uint32_t facet, std::uint8_t level, const Vec2& point);
  void settle(std::uint32_t facet, std::uint8_t level, const Vec2& low, const Vec2& high);
  void follow_marks(std::uint32_t site, std::uint32_t facet, const Vec2& position);
  void need(std::uint32_t site, std::uint8_t level);

  std::uint32_t append(const Vec3& position, std::uint8_t level, const SitePlace& place, double clearance);
  void find_parents(std::uint32_t site);
  std::uint32_t find_lattice_site(std::uint32_t facet, const LatticeIndex& index) const;
  std::uint32_t find_edge_site(std::uint32_t edge, std::int64_t step) const;
  std::uint64_t hash_of(std::uint32_t site) const;
  void fill_table();
  void list_edges();
  double clearance_of(std::uint32_t site, double limit);

  template <class Function>
  void for_each_edge(std::uint32_t site, Function&& function) const;
  template <class Function>
  void for_each_facet(std::uint32_t site, Function&& function);

  bool is_refused(std::uint32_t facet, const LatticeIndex& index, std::uint8_t level) const;
  void refuse(std::uint32_t facet, const LatticeIndex& index, std::uint8_t birth);
  bool is_lattice_facet(std::uint32_t facet) const;
  const FacetGround& ground(std::uint32_t facet);
  double farthest() const { return 3 * spacing(0); }  ///< no clearance beyond is told
  double spacing(std::uint8_t level) const;
  std::int64_t step(std::uint8_t level) const { return std::int64_t{1} << (finest_ - level); }
  std::uint8_t coarsest(std::int64_t i, std::int64_t j) const;
  std::span<const LatticeIndex> directions() const;

  SurfaceParts& parts_;
  std::uint8_t finest_;
  std::uint32_t lattice_finest_;        // the same, as a level of the lattice
  IndexTable table_;                    // sites on lattices and edges, by place
  std::pmr::vector<double> clearance_;  // per site of a lattice: at most what it is; < 0: not known yet
  IndexTable refused_table_;
  std::pmr::vector<Refused> refused_;  // most places are asked for again, by each border site near them
  MarkedSquares marks_;
  std::pmr::vector<std::uint32_t> first_edge_, edges_;  // per welded vertex: the edges that end there and carry sites
  std::pmr::vector<std::uint32_t> ground_of_;           // per facet, or k_none
  std::pmr::deque<std::optional<FacetGround>> grounds_;

  std::pmr::vector<InnerSite> irregular_;   // that insert() made, ascending
  std::pmr::vector<Raising> pending_;       // a stack
  std::pmr::vector<std::uint32_t> raised_;  // in this step
  std::uint32_t first_new_;
};

template <class Function>
void Refinement::for_each_edge(std::uint32_t site, Function&& function) const {
  const Site at = parts_.sites[site];  // a copy: the function may add sites
  if (at.edge != k_none) {
    function(at.edge);
  } else if (at.vertex != k_none) {
    for (std::uint32_t k = first_edge_[at.vertex]; k < first_edge_[at.vertex + 1]; ++k) {
      function(edges_[k]);
    }
  }
}

// Those that have the site, and a lattice; each once.
template <class Function>
void Refinement::for_each_facet(std::uint32_t site, Function&& function) {
  if (parts_.places[site].facet != k_none) {
    if (is_lattice_facet(parts_.places[site].facet)) {
      function(parts_.places[site].facet);
    }
    return;
  }
  std::array<std::uint32_t, 64> known;  // corners where more meet may be told of a facet twice, which does no harm
  std::size_t count = 0;
  for_each_edge(site, [&](std::uint32_t edge) {
    for (const std::uint32_t use : parts_.welded.uses_at_edge(edge)) {
      const std::uint32_t facet = parts_.facets.facet_of_triangle[parts_.welded.uses_by_triangle[use].triangle];
      if (std::find(known.begin(), known.begin() + count, facet) == known.begin() + count && is_lattice_facet(facet)) {
        if (count < known.size()) {
          known[count++] = facet;
        }
        function(facet);
      }
    }
  });
}

}  // namespace radvor
