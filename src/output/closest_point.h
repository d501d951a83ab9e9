// The nearest point of a set of triangles, among those that face a direction.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "base/vector.h"
#include "scene/box_tree.h"

namespace radvor {

/// The point of a triangle that is nearest to another (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 closest_point_of_triangle(const Vec3& point, const std::array<Vec3, 3>& corners);

class ClosestPoint {
 public:
  struct Triangle {
    std::array<Vec3, 3> corners;
    Vec3 normal;  ///< unit
    bool two_sided;
  };

  struct Found {
    std::uint32_t triangle;
    Vec3 point;
    bool back;  ///< of a two-sided triangle: its back is what faces the direction
  };

  ClosestPoint(std::pmr::vector<Triangle> triangles, std::pmr::memory_resource* memory);

  /// Of the triangles that face along `normal` (not 0, any length; more than half a degree short of perpendicular, so
  /// that a wall is not found from the floor that it stands on), the nearest one's nearest point, at most max_distance
  /// away. Where several are equally near, the one that faces most, then the first.
  std::optional<Found> find(const Vec3& point, const Vec3& normal, double max_distance) const;

 private:
  double facing(std::uint32_t triangle, const Vec3& normal) const;
  std::optional<double> nearest_distance(const Vec3& point, const Vec3& normal, double max_distance) const;

  std::pmr::vector<Triangle> triangles_;
  BoxTree tree_;
};

}  // namespace radvor
