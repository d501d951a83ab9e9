// The two questions that decide everything: on which side of a line, and inside or outside of a circle. The answers
// are exact: a floating-point filter first, then an exact evaluation in integers or expansions.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/vector.h"

namespace radvor::delaunay {

/// Coordinates are 0 or within these magnitudes: in_circle is of degree 4 and must neither overflow nor underflow.
inline constexpr double k_least_coordinate = 0x1p-142;
inline constexpr double k_greatest_coordinate = 0x1p200;

/// The dyadic unit that all coordinates seen are multiples of. While a determinant, counted in units, stays below
/// 2^53, its plain evaluation in double precision is exact: on lattices ties cost next to nothing.
class Lattice {
 public:
  void include(Vec2 point) noexcept {
    include(point.x);
    include(point.y);
  }
  double orientation_limit() const { return orientation_limit_; }  ///< 2^53 units^2
  double in_circle_limit() const { return in_circle_limit_; }      ///< 2^53 units^4
  double per_unit() const { return per_unit_; }

 private:
  void include(double x) noexcept {
    const double units = x * per_unit_;
    // From 2^53 on every double is an integer.
    if (std::fabs(units) < 0x1p53 && static_cast<double>(static_cast<std::int64_t>(units)) != units) {
      refine(x);
    }
  }
  void refine(double x) noexcept;

  double per_unit_ = 0x1p-200;  // the coarsest unit, until a coordinate needs a finer one
  double orientation_limit_ = 0x1p453;
  double in_circle_limit_ = 0x1p853;
};

namespace exact {
/// The same signs without filter. For tests, and for where filters fail.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);
int in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);
/// The determinant of orientation, correct but for a few roundings.
double twice_area(const Vec2& a, const Vec2& b, const Vec2& c);
}  // namespace exact

namespace detail {
int orientation_far(const Vec2& a, const Vec2& b, const Vec2& c);
int in_circle_far(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, const Lattice& lattice);
}  // namespace detail

/// > 0: a, b, c turn left; 0: collinear; < 0: right.
inline int orientation(const Vec2& a, const Vec2& b, const Vec2& c, const Lattice& lattice) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double magnitude = std::fabs(left) + std::fabs(right);
  constexpr double k_bound = 3.3306690738754716e-16;  // (3 + 16 eps) eps, eps = 2^-53
  if (std::fabs(determinant) > k_bound * magnitude || magnitude < lattice.orientation_limit()) {
    return (determinant > 0) - (determinant < 0);
  }
  return detail::orientation_far(a, b, c);
}

/// a, b, c counter-clockwise. > 0: d is strictly inside of their circle; 0: on it; < 0: outside.
inline int in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, const Lattice& lattice) {
  const double adx = a.x - d.x, ady = a.y - d.y;
  const double bdx = b.x - d.x, bdy = b.y - d.y;
  const double cdx = c.x - d.x, cdy = c.y - d.y;
  const double bdx_cdy = bdx * cdy, cdx_bdy = cdx * bdy;
  const double cdx_ady = cdx * ady, adx_cdy = adx * cdy;
  const double adx_bdy = adx * bdy, bdx_ady = bdx * ady;
  const double a_lift = adx * adx + ady * ady;
  const double b_lift = bdx * bdx + bdy * bdy;
  const double c_lift = cdx * cdx + cdy * cdy;
  const double determinant = a_lift * (bdx_cdy - cdx_bdy) + b_lift * (cdx_ady - adx_cdy) + c_lift * (adx_bdy - bdx_ady);
  const double magnitude = (std::fabs(bdx_cdy) + std::fabs(cdx_bdy)) * a_lift +
                           (std::fabs(cdx_ady) + std::fabs(adx_cdy)) * b_lift +
                           (std::fabs(adx_bdy) + std::fabs(bdx_ady)) * c_lift;
  constexpr double k_bound = 1.1102230246251577e-15;  // (10 + 96 eps) eps
  if (std::fabs(determinant) > k_bound * magnitude || magnitude < lattice.in_circle_limit()) {
    return (determinant > 0) - (determinant < 0);
  }
  return detail::in_circle_far(a, b, c, d, lattice);
}

/// Order of the canonical choice: by x, then y.
inline bool lexicographically_less(const Vec2& a, const Vec2& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// Four points on one circle in the order a, d, b, c: is d taken for inside of it? The lexicographically least of the
/// four counts as lowered below the paraboloid they are lifted to.
inline bool wins_tie(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 inner = lexicographically_less(c, d) ? c : d;
  return lexicographically_less(inner, a) && lexicographically_less(inner, b);
}

}  // namespace radvor::delaunay
