// Where to begin looking for a point's triangle: for each square of a grid one at its middle. Rays that gather light
// ask a thousand times a site, and find most points in the first triangle or the next.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "delaunay/triangulation.h"

namespace radvor {

class TriangleRaster {
 public:
  explicit TriangleRaster(std::pmr::memory_resource* memory) : triangles_(memory) {}

  /// About two squares a vertex; none where there are few vertices.
  void fill(const delaunay::Triangulation& triangulation);

  /// A real triangle near the point, or delaunay::k_none.
  delaunay::TriangleId at(const Vec2& point) const {
    return triangles_.empty() ? delaunay::k_none : triangles_[square(point)];
  }
  /// Asks memory ahead for that.
  void fetch(const Vec2& point) const {
    if (!triangles_.empty()) {
      __builtin_prefetch(&triangles_[square(point)]);
    }
  }

 private:
  std::size_t square(const Vec2& point) const {
    const auto index = [](double offset, std::uint32_t count) {
      return static_cast<std::size_t>(std::clamp(offset, 0.0, static_cast<double>(count - 1)));
    };
    return index((point.y - low_.y) * per_unit_.y, rows_) * columns_ +
           index((point.x - low_.x) * per_unit_.x, columns_);
  }

  Vec2 low_{0.0}, per_unit_{0.0};
  std::uint32_t columns_ = 0, rows_ = 0;
  std::pmr::vector<delaunay::TriangleId> triangles_;
};

}  // namespace radvor
