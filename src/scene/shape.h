// Plain geometry of welded triangles, and attributes of mesh vertices along their sides.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/vector.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

inline std::array<Vec3, 3> positions_of(const WeldedScene& welded, const Triangle& triangle) {
  return {welded.positions[triangle.vertices[0]], welded.positions[triangle.vertices[1]],
          welded.positions[triangle.vertices[2]]};
}

/// Along the normal of the front, as long as twice the area.
inline Vec3 area_normal(const WeldedScene& welded, const Triangle& triangle) {
  const auto [a, b, c] = positions_of(welded, triangle);
  return cross(b - a, c - a);
}

/// How far off a plane points of this precision may be and still lie in it: what rounding the input explains, and a
/// share of the size of the whole that is far too small to see and less than rays are lifted off surfaces.
inline double planar_tolerance(double precision, double size) {
  return 12 * precision + 1e-6 * size;
}

/// Barycentric coordinates of the projection of a point into a triangle's plane; they may be negative.
inline Vec3 barycentric(const std::array<Vec3, 3>& corners, const Vec3& point) {
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double scale = 1 / dot(normal, normal);
  const double b = dot(cross(point - corners[0], corners[2] - corners[0]), normal) * scale;
  const double c = dot(cross(corners[1] - corners[0], point - corners[0]), normal) * scale;
  return {1 - b - c, b, c};
}

/// An attribute of the corners at an end of an edge: taken from the corner, or interpolated along the side where the
/// end is a T-junction of it.
template <class Value>
Value along_side(const WeldedScene& welded, const EdgeUse& use, std::uint32_t vertex,
                 const std::array<Value, 3>& corners) {
  const Triangle& triangle = welded.triangles[use.triangle];
  const std::size_t from = use.side;
  const std::size_t to = (from + 1) % 3;
  if (vertex == triangle.vertices[from]) {
    return corners[from];
  }
  if (vertex == triangle.vertices[to]) {
    return corners[to];
  }
  const Vec3& a = welded.positions[triangle.vertices[from]];
  const Vec3 side = welded.positions[triangle.vertices[to]] - a;
  const double along = dot(welded.positions[vertex] - a, side) / dot(side, side);
  return (1 - along) * corners[from] + along * corners[to];
}

}  // namespace radvor
