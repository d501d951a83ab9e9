// Fixed, stratified points: Shirley and Chiu's concentric map from the square to the disk (A low distortion map between
// disk and square, 1997) and bases about a direction.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vector.h"

namespace radvor {

/// Sine and cosine of an angle in [-pi/4, pi/4] by their Taylor series: within 1e-11, in a quarter of the time that
/// the library's take.
struct SineCosine {
  double sine, cosine;

  explicit SineCosine(double angle) {
    // Horner's scheme: each term is the one before it times what follows the 1.
    const double s = angle * angle;
    sine = angle * (1 - s * (1.0 / 6) *
                            (1 - s * (1.0 / 20) * (1 - s * (1.0 / 42) * (1 - s * (1.0 / 72) * (1 - s * (1.0 / 110))))));
    cosine =
        1 - s * 0.5 *
                (1 - s * (1.0 / 12) *
                         (1 - s * (1.0 / 30) * (1 - s * (1.0 / 56) * (1 - s * (1.0 / 90) * (1 - s * (1.0 / 132))))));
  }
};

/// (a, b) in [-1, 1]^2 to the unit disk, keeping fractions of area.
inline Vec2 square_to_disk(double a, double b) {
  constexpr double k_quarter_pi = 0.78539816339744831;
  if (a == 0 && b == 0) {
    return {0, 0};
  }
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  const SineCosine turn(k_quarter_pi * ((wide ? b : a) / radius));
  return radius * (wide ? Vec2(turn.cosine, turn.sine) : Vec2(turn.sine, turn.cosine));
}

/// Point i of n of the unit disk in Vogel's spiral (1979): equal shares of area, and no direction in which a straight
/// shadow edge could run along rows of points.
inline Vec2 sunflower(int i, int n) {
  constexpr double k_golden_angle = 2.3999632297286533;
  const double radius = std::sqrt((i + 0.5) / n);
  return {radius * std::cos(i * k_golden_angle), radius * std::sin(i * k_golden_angle)};
}

/// Two unit vectors that make a right-handed orthonormal basis with the unit vector z.
struct Basis {
  Vec3 x, y, z;

  explicit Basis(const Vec3& direction) : z(direction) {
    // Duff et al., Building an orthonormal basis, revisited (2017).
    const double sign = std::copysign(1.0, z.z);
    const double a = -1 / (sign + z.z);
    const double b = z.x * z.y * a;
    x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x};
    y = {b, sign + z.y * z.y * a, -z.y};
  }

  /// The direction whose projection along z is the point p of the unit disk: cosine-weighted for uniform p.
  Vec3 on_hemisphere(const Vec2& p) const {
    return p.x * x + p.y * y + std::sqrt(std::max(0.0, 1 - p.x * p.x - p.y * p.y)) * z;
  }
};

}  // namespace radvor
