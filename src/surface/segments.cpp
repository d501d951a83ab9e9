#include "surface/segments.h"

#include <algorithm>
#include <cmath>

namespace radvor {

namespace {

constexpr double k_most_cells_a_side = 64;

// Half-open, so that a sight through the common end of two segments on either side of it is blocked by one of them.
bool crosses(const Segment& segment, const Vec2& p, const Vec2& q) {
  const Vec2 sight = q - p;
  const Vec2 wall = segment.b - segment.a;
  return (cross(sight, segment.a - p) > 0) != (cross(sight, segment.b - p) > 0) &&
         (cross(wall, p - segment.a) > 0) != (cross(wall, q - segment.a) > 0);
}

}  // namespace

SegmentGrid::SegmentGrid(std::span<const Segment> segments, double width, std::pmr::memory_resource* memory)
    : segments_(segments), width_(width), first_(memory), members_(memory) {
  Vec2 high(0.0);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Vec2 least = glm::min(segments[k].a, segments[k].b);
    const Vec2 most = glm::max(segments[k].a, segments[k].b);
    low_ = k == 0 ? least : glm::min(low_, least);
    high = k == 0 ? most : glm::max(high, most);
  }
  const Vec2 size = high - low_;
  width_ = std::max({width_, size.x / k_most_cells_a_side, size.y / k_most_cells_a_side});
  columns_ = static_cast<std::int64_t>(size.x / width_) + 1;
  rows_ = static_cast<std::int64_t>(size.y / width_) + 1;

  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  const auto for_cells = [&](const Segment& segment, auto&& function) {
    const Cells cells = cells_of(segment.a, segment.b);
    for (std::int64_t y = cells.low_y; y <= cells.high_y; ++y) {
      for (std::int64_t x = cells.low_x; x <= cells.high_x; ++x) {
        function(index(x, y));
      }
    }
  };
  for (const Segment& segment : segments) {
    for_cells(segment, [&](std::size_t cell) { ++first_[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) {
    first_[cell] += first_[cell - 1];
  }
  members_.resize(first_.back());
  for (std::uint32_t k = 0; k < segments.size(); ++k) {
    for_cells(segments[k], [&](std::size_t cell) { members_[first_[cell]++] = k; });
  }
  for (std::size_t cell = first_.size() - 1; cell > 0; --cell) {  // filling moved each to the start of the next
    first_[cell] = first_[cell - 1];
  }
  first_[0] = 0;
}

SegmentGrid::Cells SegmentGrid::cells_of(const Vec2& p, const Vec2& q) const {
  const auto clamped = [&](double offset, std::int64_t count) {
    return static_cast<std::int64_t>(std::clamp(std::floor(offset / width_), 0.0, static_cast<double>(count - 1)));
  };
  const Vec2 low = glm::min(p, q) - low_;
  const Vec2 high = glm::max(p, q) - low_;
  return {clamped(low.x, columns_), clamped(low.y, rows_), clamped(high.x, columns_), clamped(high.y, rows_)};
}

double SegmentGrid::distance(const Vec2& p, double limit) const {
  double least = limit * limit;
  for_each_near(p - limit, p + limit, [&](std::uint32_t k) {
    const Vec2& a = segments_[k].a;
    const Vec2 along = segments_[k].b - a;
    const double squared = glm::dot(along, along);
    const double part = squared > 0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    const Vec2 apart = p - (a + part * along);
    least = std::min(least, glm::dot(apart, apart));
  });
  return std::min(std::sqrt(least), limit);
}

bool SegmentGrid::encloses(const Vec2& p, std::uint32_t count) const {
  if (segments_.empty()) {
    return false;
  }
  bool inside = false;
  const Cells cells = cells_of({low_.x, p.y}, p);
  for (std::int64_t x = cells.low_x; x <= cells.high_x; ++x) {
    for (std::uint32_t k = first_[index(x, cells.low_y)]; k < first_[index(x, cells.low_y) + 1]; ++k) {
      const Segment& segment = segments_[members_[k]];
      if (members_[k] >= count || (segment.a.y <= p.y) == (segment.b.y <= p.y)) {
        continue;
      }
      const double part = (p.y - segment.a.y) / (segment.b.y - segment.a.y);
      const double crossing = segment.a.x + part * (segment.b.x - segment.a.x);
      // A segment lies in many cells, and counts in one: that of the crossing.
      inside = inside != (crossing < p.x && cells_of({crossing, p.y}, {crossing, p.y}).low_x == x);
    }
  }
  return inside;
}

bool SegmentGrid::blocks(const Vec2& p, const Vec2& q) const {
  if (segments_.empty()) {
    return false;
  }
  const Cells cells = cells_of(p, q);
  for (std::int64_t y = cells.low_y; y <= cells.high_y; ++y) {
    for (std::int64_t x = cells.low_x; x <= cells.high_x; ++x) {
      for (std::uint32_t k = first_[index(x, y)]; k < first_[index(x, y) + 1]; ++k) {
        if (crosses(segments_[members_[k]], p, q)) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace radvor
