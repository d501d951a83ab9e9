// Straight pieces of border in a facet's plane, and whether one of them hides a site from a point.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/vector.h"

namespace radvor {

/// In the plane of a facet.
struct Segment {
  Vec2 a, b;
};

/// A uniform grid over segments: lines of sight ask those nearby alone.
class SegmentGrid {
 public:
  /// width: of a grid cell, about the length of the queries, scene units > 0. Keeps a view of the segments.
  SegmentGrid(std::span<const Segment> segments, double width, std::pmr::memory_resource* memory);

  /// Whether a segment crosses the line of sight from p to q.
  bool blocks(const Vec2& p, const Vec2& q) const;

  /// From p to the nearest segment; `limit` where all are at least that far.
  double distance(const Vec2& p, double limit) const;

  /// Even-odd: whether a ray to the left of p crosses an odd number of the first `count` segments.
  bool encloses(const Vec2& p, std::uint32_t count) const;

  /// function(index) for the segments that may meet a box; some more than once.
  template <class Function>
  void for_each_near(const Vec2& low, const Vec2& high, Function&& function) const {
    if (segments_.empty()) {
      return;
    }
    const Cells cells = cells_of(low, high);
    for (std::int64_t y = cells.low_y; y <= cells.high_y; ++y) {
      for (std::int64_t x = cells.low_x; x <= cells.high_x; ++x) {
        for (std::uint32_t k = first_[index(x, y)]; k < first_[index(x, y) + 1]; ++k) {
          function(members_[k]);
        }
      }
    }
  }

 private:
  struct Cells {
    std::int64_t low_x, low_y, high_x, high_y;
  };
  Cells cells_of(const Vec2& p, const Vec2& q) const;
  std::size_t index(std::int64_t x, std::int64_t y) const { return static_cast<std::size_t>(y * columns_ + x); }

  std::span<const Segment> segments_;
  Vec2 low_{0.0};
  double width_;
  std::int64_t columns_ = 1, rows_ = 1;
  std::pmr::vector<std::uint32_t> first_;  // per cell, and one past the last
  std::pmr::vector<std::uint32_t> members_;
};

}  // namespace radvor
