#include "surface/interior_sites.h"

#include <algorithm>
#include <cmath>

namespace radvor {

namespace {

struct Interval {
  double low, high;
};

// What one lattice row meets: where it crosses the outline, and where it is too close to something.
class Row {
 public:
  explicit Row(std::pmr::memory_resource* memory) : crossings(memory), blocked(memory) {}

  void finish() {
    std::sort(crossings.begin(), crossings.end());
    std::sort(blocked.begin(), blocked.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  }

  std::pmr::vector<double> crossings;
  std::pmr::vector<Interval> blocked;
};

void widen(Interval& interval, double x) {
  interval.low = std::min(interval.low, x);
  interval.high = std::max(interval.high, x);
}

// The part of the row at height y that is closer than `radius` to the segment: what the row cuts from two disks and
// the rectangle between them, which is one interval because their union is convex. Empty: low > high.
Interval closer_than(const Segment& segment, double radius, double y) {
  Interval interval{HUGE_VAL, -HUGE_VAL};
  for (const Vec2& end : {segment.a, segment.b}) {
    const double square = radius * radius - (y - end.y) * (y - end.y);
    if (square > 0) {
      widen(interval, end.x - std::sqrt(square));
      widen(interval, end.x + std::sqrt(square));
    }
  }
  const Vec2 along = segment.b - segment.a;
  const double length = glm::length(along);
  if (length > 0) {
    const Vec2 across = Vec2(-along.y, along.x) * (radius / length);
    const Vec2 corners[] = {segment.a - across, segment.b - across, segment.b + across, segment.a + across};
    for (int k = 0; k < 4; ++k) {
      const Vec2& from = corners[k];
      const Vec2& to = corners[(k + 1) % 4];
      if ((from.y <= y) != (to.y <= y)) {
        widen(interval, from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x));
      }
    }
  }
  return interval;
}

// The rows of a facet, filled segment by segment.
class Rows {
 public:
  Rows(const FacetLattice& lattice, std::uint32_t level, std::span<const Segment> outline,
       std::pmr::memory_resource* memory)
      : lattice_(lattice), level_(level), rows_(memory) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const Segment& segment : outline) {
      low = std::min({low, segment.a.y, segment.b.y});
      high = std::max({high, segment.a.y, segment.b.y});
    }
    if (low <= high) {
      first_ = lattice.first_row(level, low);
      const std::int64_t last = lattice.last_row(level, high);
      rows_.reserve(static_cast<std::size_t>(std::max<std::int64_t>(last - first_ + 1, 0)));
      for (std::int64_t j = first_; j <= last; ++j) {
        rows_.emplace_back(memory);
      }
    }
  }

  void cross(const Segment& segment) {
    const double low = std::min(segment.a.y, segment.b.y);
    const double high = std::max(segment.a.y, segment.b.y);
    for_rows(low, high, [&](Row& row, double y) {
      if ((segment.a.y <= y) != (segment.b.y <= y)) {
        const double part = (y - segment.a.y) / (segment.b.y - segment.a.y);
        row.crossings.push_back(segment.a.x + part * (segment.b.x - segment.a.x));
      }
    });
  }

  void block(const Segment& segment, double radius) {
    const double low = std::min(segment.a.y, segment.b.y) - radius;
    const double high = std::max(segment.a.y, segment.b.y) + radius;
    for_rows(low, high, [&](Row& row, double y) {
      const Interval interval = closer_than(segment, radius, y);
      if (interval.low < interval.high) {
        row.blocked.push_back(interval);
      }
    });
  }

  void collect(std::pmr::vector<LatticeIndex>& sites) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Row& row = rows_[k];
      row.finish();
      const std::int64_t j = first_ + static_cast<std::int64_t>(k);
      auto blocked = row.blocked.begin();
      double free_from = -HUGE_VAL;  // the end of all blocked intervals that began so far
      for (std::size_t crossing = 0; crossing + 1 < row.crossings.size(); crossing += 2) {
        const std::int64_t last = lattice_.last_column(level_, j, row.crossings[crossing + 1]);
        for (std::int64_t i = lattice_.first_column(level_, j, row.crossings[crossing]); i <= last; ++i) {
          const double x = lattice_.point(level_, {i, j}).x;
          while (blocked != row.blocked.end() && blocked->low < x) {
            free_from = std::max(free_from, blocked->high);
            ++blocked;
          }
          if (x >= free_from) {
            sites.push_back({i, j});
          }
        }
      }
    }
  }

 private:
  template <class Function>
  void for_rows(double low, double high, Function&& function) {
    const std::int64_t end = first_ + static_cast<std::int64_t>(rows_.size());
    const std::int64_t last = std::min(lattice_.last_row(level_, high), end - 1);
    for (std::int64_t j = std::max(lattice_.first_row(level_, low), first_); j <= last; ++j) {
      function(rows_[static_cast<std::size_t>(j - first_)], lattice_.point(level_, {0, j}).y);
    }
  }

  const FacetLattice& lattice_;
  std::uint32_t level_;
  std::int64_t first_ = 0;
  std::pmr::vector<Row> rows_;
};

}  // namespace

void find_interior_sites(const FacetLattice& lattice, std::uint32_t level, std::span<const Segment> outline,
                         std::span<const Segment> constraints, double clearance, std::pmr::vector<LatticeIndex>& sites,
                         std::pmr::memory_resource* memory) {
  Rows rows(lattice, level, outline, memory);
  for (const Segment& segment : outline) {
    rows.cross(segment);
    rows.block(segment, clearance);
  }
  for (const Segment& segment : constraints) {
    rows.block(segment, clearance);
  }
  rows.collect(sites);
}

}  // namespace radvor
