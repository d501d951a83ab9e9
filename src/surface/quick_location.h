// Which triangle of a facet a point lies in, for rays: they ask a thousand times a site, and find most points in the
// first triangle or the next. For each square of a grid a triangle to begin with; then a walk, of which every step
// reads one record.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "delaunay/triangulation.h"

namespace radvor {

class QuickLocation {
 public:
  explicit QuickLocation(std::pmr::memory_resource* memory) : triangles_(memory), starts_(memory) {}

  /// index_of_triangle: what find() tells of each triangle; k_none for those outside of the domain. About two squares a
  /// vertex.
  void fill(const delaunay::Triangulation& triangulation, std::span<const std::uint32_t> index_of_triangle);
  /// Nothing is found from now on.
  void clear();

  /// A real triangle near the point, or delaunay::k_none.
  delaunay::TriangleId start(const Vec2& point) const {
    return starts_.empty() ? delaunay::k_none : starts_[square(point)];
  }

  /// Of a triangle that the point is in but for the rounding of floats at the facet's size, with its corners' weights
  /// (>= 0, sum 1). k_none where it cannot tell: outside of the domain, in triangles so thin that a float does not tell
  /// their sides apart, and elsewhere too. from: what start() told.
  std::uint32_t find(const Vec2& point, delaunay::TriangleId from, std::array<double, 3>& weights) const {
    const delaunay::TriangleId t = from == delaunay::k_none ? from : walk(point, from, weights);
    return t >= k_thin_one ? delaunay::k_none : triangles_[t].index;
  }

  /// For many at once: memory is asked ahead for what start() and then find() read first.
  void fetch_start(const Vec2& point) const {
    if (!starts_.empty()) {
      __builtin_prefetch(&starts_[square(point)]);
    }
  }
  void fetch(delaunay::TriangleId from) const {
    if (from != delaunay::k_none) {  // it may lie on two lines
      __builtin_prefetch(&triangles_[from]);
      __builtin_prefetch(reinterpret_cast<const char*>(&triangles_[from] + 1) - 1);
    }
  }

 private:
  static constexpr delaunay::TriangleId k_thin_one = delaunay::k_none - 1;  // a triangle that no walk goes through

  struct Triangle {
    std::array<float, 3> x{}, y{};  // of the corners, from low_, over the facet's size
    std::array<delaunay::TriangleId, 3> beyond{delaunay::k_none, delaunay::k_none,
                                               delaunay::k_none};  // across from each, or k_thin_one
    std::uint32_t index = delaunay::k_none;
  };

  // The triangle that the point is in, k_thin_one where such a one is in the way, or delaunay::k_none.
  delaunay::TriangleId walk(const Vec2& point, delaunay::TriangleId t, std::array<double, 3>& weights) const;

  std::size_t square(const Vec2& point) const {
    const auto index = [](double offset, std::uint32_t count) {
      return static_cast<std::size_t>(offset > 0 ? std::min(offset, count - 1.0) : 0.0);  // 0 for no number, too
    };
    return index((point.y - low_.y) * per_unit_.y, rows_) * columns_ +
           index((point.x - low_.x) * per_unit_.x, columns_);
  }

  Vec2 low_{0.0}, per_unit_{0.0};
  double scale_ = 1;  // a power of two: coordinates are 0 to 1
  std::uint32_t columns_ = 0, rows_ = 0;
  std::pmr::vector<Triangle> triangles_;           // per triangle of the triangulation
  std::pmr::vector<delaunay::TriangleId> starts_;  // per square, row by row
};

}  // namespace radvor
