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

  /// From a point inside to the nearest border, constraint or given site; `limit` where all are at least that far.
  double clearance(const Vec2& point, double limit) const { return grid_.distance(point, limit); }
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

 private:
  const Frame& frame_;
  std::pmr::vector<Segment> segments_;     // borders first, given sites last
  std::pmr::vector<std::uint32_t> edges_;  // per segment; k_none: a site
  std::uint32_t border_count_ = 0;
  Vec2 low_{0.0}, high_{0.0};
  FacetLattice lattice_;
  SegmentGrid grid_;

  FacetLattice find_segments(const FacetInput& input);
};

}  // namespace radvor
