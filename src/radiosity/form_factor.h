// How much of a receiver's hemisphere a diffuse polygon fills, weighted by the cosine: exact by Lambert's contour
// integral, or from afar by the kernel and its second moments.
#pragma once

#include <span>

#include "base/vector.h"

namespace radvor {

/// Form factor from the point `x` with unit normal `n` to a planar polygon (any simple one, or a chain of loops joined
/// by bridges): 1/(2 pi) sum over edges of (angle subtended) * (unit normal of the plane through x and the edge) . n,
/// with the polygon clipped to the horizon of n. In 0..1; 0 where x is not in front of the polygon (corners run
/// counter-clockwise about the front) or all of it is below the horizon. Exact to rounding at any distance.
double polygon_form_factor(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon, const Vec3& polygon_normal);

/// A piece of a plane as seen from afar: its area and second moments about the centroid.
struct PlanePiece {
  Vec3 centroid{0.0};
  Vec3 normal{0, 0, 1};
  Vec3 u{1, 0, 0}, v{0, 1, 0};  ///< orthonormal in the plane
  double area = 0;
  double uu = 0, uv = 0, vv = 0;  ///< mean of t t^T over the piece, t = (point - centroid) in (u, v)
};

/// Area, centroid and second moments of a planar polygon in the basis (u, v) of its plane.
PlanePiece measure_polygon(std::span<const Vec3> polygon, const Vec3& u, const Vec3& v, const Vec3& normal);

/// Two pieces of one plane with the same basis, seen as one.
PlanePiece join(const PlanePiece& a, const PlanePiece& b);

/// The form factor to a plane piece by the second-order expansion of the kernel cos cos' / (pi r^2) about its
/// centroid. Relative error of order (extent / distance)^3, and of order 4 for pieces symmetric about their centroid.
/// The piece must lie above the horizon of n; 0 where x is behind it.
double kernel_form_factor(const Vec3& x, const Vec3& n, const PlanePiece& piece);

/// The kernel between a receiver and a point y with normal m: max(0, n . w) max(0, -m . w) / (pi |w|^4), w = y - x,
/// per unit area.
inline double kernel(const Vec3& x, const Vec3& n, const Vec3& y, const Vec3& m) {
  const Vec3 w = y - x;
  const double receiving = glm::dot(n, w);
  const double leaving = -glm::dot(m, w);
  if (receiving <= 0 || leaving <= 0) {
    return 0;
  }
  const double square = glm::dot(w, w);
  return receiving * leaving / (3.14159265358979323846 * square * square);
}

}  // namespace radvor
