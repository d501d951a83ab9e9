#include "surface/quick_location.h"

#include <algorithm>
#include <cmath>

namespace radvor {

namespace {

// Of the facet's size: a triangle that is less high may be turned over where floats round its corners.
constexpr double k_thin = 0x1p-20;

bool is_thick(const delaunay::Triangulation& triangulation, delaunay::TriangleId t, double scale) {
  const auto corners = triangulation.triangle(t);
  const Vec2 a = triangulation.position(corners[0]);
  const Vec2 b = (triangulation.position(corners[1]) - a) * scale;
  const Vec2 c = (triangulation.position(corners[2]) - a) * scale;
  const double longest = std::sqrt(std::max({glm::dot(b, b), glm::dot(c, c), glm::dot(c - b, c - b)}));
  return b.x * c.y - b.y * c.x > k_thin * longest;
}

// Doubled areas between the origin and each side; which is least.
template <class Real>
std::uint32_t side_areas(const std::array<Real, 3>& x, const std::array<Real, 3>& y, std::array<Real, 3>& area) {
  area = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  return area[1] < area[0] ? (area[2] < area[1] ? 2 : 1) : (area[2] < area[0] ? 2 : 0);
}

}  // namespace

// Towards the edge that the point is farthest beyond. Floats tell the way; where they say that it is there, doubles do:
// in a thin triangle a side's rounding would move the point along it.
delaunay::TriangleId QuickLocation::walk(const Vec2& point, delaunay::TriangleId t,
                                         std::array<double, 3>& weights) const {
  const Vec2 exact = (point - low_) * scale_;
  const auto x = static_cast<float>(exact.x);
  const auto y = static_cast<float>(exact.y);
  constexpr int k_most_steps = 64;
  for (int step = 0; step < k_most_steps; ++step) {
    if (t >= k_thin_one) {
      return t;
    }
    const Triangle& at = triangles_[t];
    std::array<float, 3> area;
    std::uint32_t least =
        side_areas<float>({at.x[0] - x, at.x[1] - x, at.x[2] - x}, {at.y[0] - y, at.y[1] - y, at.y[2] - y}, area);
    if (area[least] >= 0) {
      least = side_areas<double>({at.x[0] - exact.x, at.x[1] - exact.x, at.x[2] - exact.x},
                                 {at.y[0] - exact.y, at.y[1] - exact.y, at.y[2] - exact.y}, weights);
      if (weights[least] >= 0) {
        const double sum = weights[0] + weights[1] + weights[2];
        for (double& weight : weights) {
          weight /= sum;
        }
        return sum > 0 ? t : delaunay::k_none;
      }
    }
    t = at.beyond[least];
  }
  return delaunay::k_none;
}

void QuickLocation::clear() {
  std::pmr::vector<Triangle>(triangles_.get_allocator()).swap(triangles_);
  std::pmr::vector<delaunay::TriangleId>(starts_.get_allocator()).swap(starts_);
}

void QuickLocation::fill(const delaunay::Triangulation& triangulation,
                         std::span<const std::uint32_t> index_of_triangle) {
  constexpr double k_squares_a_vertex = 2;
  clear();
  const auto positions = triangulation.positions();
  Vec2 high = low_ = positions[0];
  for (const Vec2& position : positions) {
    low_ = glm::min(low_, position);
    high = glm::max(high, position);
  }
  const Vec2 size = high - low_;
  if (!(size.x > 0 && size.y > 0)) {
    return;
  }
  scale_ = std::ldexp(1.0, -std::ilogb(std::max(size.x, size.y)) - 1);
  triangles_.resize(triangulation.triangle_bound());
  std::pmr::vector<std::uint8_t> is_told(triangles_.size(), std::uint8_t{0}, triangles_.get_allocator());
  for (delaunay::TriangleId t = 0; t < triangles_.size(); ++t) {
    is_told[t] = triangulation.is_triangle(t) && is_thick(triangulation, t, scale_) ? 1 : 0;
  }
  for (delaunay::TriangleId t = 0; t < triangles_.size(); ++t) {
    if (is_told[t] == 0) {
      continue;  // no walk comes here
    }
    Triangle& made = triangles_[t];
    const auto corners = triangulation.triangle(t);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec2 corner = (positions[corners[k]] - low_) * scale_;
      made.x[k] = static_cast<float>(corner.x);
      made.y[k] = static_cast<float>(corner.y);
      const delaunay::TriangleId next = delaunay::triangle_of(triangulation.twin(delaunay::half_edge(t, (k + 1) % 3)));
      made.beyond[k] = is_told[next] != 0 ? next : triangulation.is_triangle(next) ? k_thin_one : delaunay::k_none;
    }
    made.index = index_of_triangle[t];
  }
  const double most = k_squares_a_vertex * static_cast<double>(positions.size());
  columns_ = static_cast<std::uint32_t>(std::clamp(std::sqrt(most * (size.x / size.y)), 1.0, most));
  rows_ = static_cast<std::uint32_t>(std::clamp(std::sqrt(most * (size.y / size.x)), 1.0, most));
  per_unit_ = Vec2(columns_, rows_) / size;
  starts_.reserve(std::size_t{columns_} * rows_);
  // Beyond the hull the square before knows best; a row begins where the one below it began. Where walks end at thin
  // triangles, of which there are rows along borders and contacts, the triangulation is asked.
  std::array<double, 3> weights;
  delaunay::TriangleId last = delaunay::k_none;
  for (std::uint32_t row = 0; row < rows_; ++row) {
    last = row == 0 ? last : starts_[std::size_t{row - 1} * columns_];
    for (std::uint32_t column = 0; column < columns_; ++column) {
      const Vec2 middle = low_ + (Vec2(column, row) + 0.5) / per_unit_;
      delaunay::TriangleId found = last == delaunay::k_none ? k_thin_one : walk(middle, last, weights);
      found = found == k_thin_one ? triangulation.locate_roughly(middle, weights) : found;
      last = found != delaunay::k_none && is_told[found] != 0 ? found : last;
      starts_.push_back(last);
    }
  }
}

}  // namespace radvor
