#include "surface/triangle_raster.h"

#include <array>
#include <cmath>

namespace radvor {

void TriangleRaster::fill(const delaunay::Triangulation& triangulation) {
  constexpr std::uint32_t k_few = 16;
  constexpr double k_squares_a_vertex = 2;
  triangles_.clear();
  const auto positions = triangulation.positions();
  if (positions.size() < k_few) {
    return;
  }
  Vec2 high = low_ = positions[0];
  for (const Vec2& position : positions) {
    low_ = glm::min(low_, position);
    high = glm::max(high, position);
  }
  const Vec2 size = high - low_;
  if (!(size.x > 0 && size.y > 0)) {
    return;
  }
  const double most = k_squares_a_vertex * static_cast<double>(positions.size());
  columns_ = static_cast<std::uint32_t>(std::clamp(std::sqrt(most * (size.x / size.y)), 1.0, most));
  rows_ = static_cast<std::uint32_t>(std::clamp(std::sqrt(most * (size.y / size.x)), 1.0, most));
  const Vec2 count(columns_, rows_);
  per_unit_ = count / size;
  triangles_.reserve(std::size_t{columns_} * rows_);
  // Beyond the hull the square before knows best; a row begins where the one below it began.
  std::array<double, 3> weights;
  delaunay::TriangleId last = delaunay::k_none;
  for (std::uint32_t row = 0; row < rows_; ++row) {
    last = row == 0 ? last : triangles_[std::size_t{row - 1} * columns_];
    for (std::uint32_t column = 0; column < columns_; ++column) {
      const Vec2 middle = low_ + (Vec2(column, row) + 0.5) / per_unit_;
      const delaunay::TriangleId found = triangulation.locate_roughly(middle, weights, last);
      last = found == delaunay::k_none ? last : found;
      triangles_.push_back(last);
    }
  }
}

}  // namespace radvor
