// The centre of the circle through three points, and the area under it that rounding must not turn over.
#pragma once

#include <cmath>

#include "delaunay/predicates.h"

namespace radvor::delaunay {

/// Twice the signed area of a triangle, with its true sign and a small relative error also where it is a sliver.
inline double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y);
  const double right = (b.y - a.y) * (c.x - a.x);
  const double area = left - right;
  constexpr double k_bound = 1e-3;  // relative: the error is below 1e-12 then
  return std::fabs(area) > k_bound * (std::fabs(left) + std::fabs(right)) ? area : exact::twice_area(a, b, c);
}

/// Seen from a. Infinite or NaN where they are collinear.
inline Vec2 circumcentre_from(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 p = b - a, q = c - a;
  const double pp = glm::dot(p, p), qq = glm::dot(q, q);
  const double scale = 0.5 / twice_area(a, b, c);
  return {scale * (q.y * pp - p.y * qq), scale * (p.x * qq - q.x * pp)};
}

inline Vec2 circumcentre(const Vec2& a, const Vec2& b, const Vec2& c) {
  return a + circumcentre_from(a, b, c);
}

}  // namespace radvor::delaunay
