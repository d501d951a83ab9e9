// The input triangles that one facet was merged from, laid out in its plane: what the adaptive mesh's triangles take
// their attributes from, and what the light at vertices is fitted to.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"
#include "scene/box_tree.h"
#include "scene/welded.h"
#include "surface/surface.h"

namespace radvor {

struct SourceTriangle {
  std::array<Vec2, 3> corners;  ///< in the facet's frame, counter-clockwise
  std::uint32_t triangle;       ///< welded
  std::uint32_t region;         ///< equal for triangles that edges join which are no seams: one affine map of UVs

  double area() const { return 0.5 * cross(corners[1] - corners[0], corners[2] - corners[0]); }
  /// Affine weights of the corners, in their order, that make up a point of the plane; sum 1, negative outside; area()
  /// is not 0.
  std::array<double, 3> weights(const Vec2& point) const;
  /// Squared, 0 inside.
  double squared_distance(const Vec2& point) const;
};

/// Box of points of a plane.
inline Box plane_box(std::span<const Vec2> points) {
  Box box;
  for (const Vec2& point : points) {
    box.add({point, 0.0});
  }
  return box;
}

class SourceTriangles {
 public:
  SourceTriangles(const Surface& surface, std::uint32_t facet, std::pmr::memory_resource* memory);

  std::span<const SourceTriangle> all() const { return triangles_; }

  /// The triangle nearest to a point of the plane, in one region or (k_none) in all; the first of several. Where the
  /// region is empty: null.
  const SourceTriangle* nearest(const Vec2& point, std::uint32_t region = k_none) const;

  /// Calls visit(triangle) for all whose boxes overlap the box, and perhaps for others.
  template <class Visit>
  void for_each_near(const Box& box, Visit&& visit) const {
    if (!tree_) {
      visit(triangles_.front());
      return;
    }
    tree_->walk([&](const Box& node) { return node.overlaps(box); }, [&](std::uint32_t i) { visit(triangles_[i]); });
  }

 private:
  void find_regions(const Surface& surface, std::uint32_t facet, std::pmr::memory_resource* memory);

  std::pmr::vector<SourceTriangle> triangles_;  ///< ascending by welded triangle
  std::optional<BoxTree> tree_;                 ///< where there are several
};

}  // namespace radvor
