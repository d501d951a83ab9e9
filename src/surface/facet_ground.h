// A facet as the ground that its lattice is refined on: what is inside, and how far it is to borders and constraints.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "surface/facet_draft.h"
#include "surface/lattice.h"
#include "surface/segments.h"

namespace radvor {

class FacetGround {
 public:
  explicit FacetGround(const FacetInput& input);
  FacetGround(const FacetGround&) = delete;
  FacetGround& operator=(const FacetGround&) = delete;

  const Frame& frame() const { return frame_; }
  const FacetLattice& lattice() const { return lattice_; }

  /// Bounds of the facet in its plane.
  const Vec2& low() const { return low_; }
  const Vec2& high() const { return high_; }

  /// From a point inside to the nearest border, constraint or irregular site; `limit` where all are at least that far.
  double clearance(const Vec2& point, double limit) const;
  bool encloses(const Vec2& point) const { return grid_.encloses(point, border_count_); }

  /// function(welded edge) for the facet's edges that may meet a box; some more than once.
  template <class Function>
  void for_each_edge_near(const Vec2& low, const Vec2& high, Function&& function) const {
    grid_.for_each_near(low, high, [&](std::uint32_t k) {
      if (edges_[k] != k_none) {
        function(edges_[k]);
      }
    });
  }

  /// function(site) for the irregular sites that may lie in a box; some more than once.
  template <class Function>
  void for_each_site_near(const Vec2& low, const Vec2& high, Function&& function) const {
    grid_.for_each_near(low, high, [&](std::uint32_t k) {
      if (sites_[k] != k_none) {
        function(sites_[k]);
      }
    });
    for (const InnerSite& site : latest_) {
      function(site.site);
    }
  }

  /// One more irregular site: an obstacle to the lattice from now on.
  void add(const InnerSite& site);

 private:
  FacetLattice find_segments(const FacetInput& input);

  const Frame& frame_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<Segment> segments_;     // borders first; sites as points
  std::pmr::vector<std::uint32_t> edges_;  // per segment; k_none: a site
  std::pmr::vector<std::uint32_t> sites_;  // per segment; k_none: an edge
  std::uint32_t border_count_ = 0;
  Vec2 low_{0.0}, high_{0.0};
  FacetLattice lattice_;
  SegmentGrid grid_;
  std::pmr::vector<InnerSite> latest_;  // that the grid has not taken up yet: few
};

}  // namespace radvor
