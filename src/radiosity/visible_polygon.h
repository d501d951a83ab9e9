// The part of a convex polygon that a point sees past triangles: the polygon minus the shadow of each, exactly, as
// convex pieces. What Nishita and Nakamae (1985) do for polygonal lights, with half-planes of the polygon's own plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/vector.h"

namespace radvor {

/// Lives on the stack of one evaluation: fixed capacity, no allocation.
class VisiblePolygon {
 public:
  static constexpr std::size_t k_max_corners = 12;  ///< of the whole polygon; a cut adds one to a piece at most
  static constexpr std::size_t k_max_pieces = 64;

  /// All of a planar convex polygon (3 to k_max_corners corners, counter-clockwise about its unit normal) as seen from
  /// `eye`. `lift` is how far beyond a triangle's plane a point must lie to be hidden by it: what the eye and the
  /// polygon themselves lie on, or touch, hides nothing.
  VisiblePolygon(const Vec3& eye, std::span<const Vec3> polygon, const Vec3& normal, double lift);

  /// Takes away what the triangle hides: what lies inside the cone of the eye over it and beyond its plane. A triangle
  /// seen edge-on (solid angle of rounding's order) hides nothing. False if there are too many pieces or corners to
  /// hold; nothing more can be asked then.
  bool subtract(const std::array<Vec3, 3>& triangle);

  bool dark() const { return piece_count_ == 0; }
  bool whole() const { return untouched_; }
  std::size_t piece_count() const { return piece_count_; }

  /// Sum of the pieces' form factors from `x` (the eye, but for the lift) with unit normal `n`.
  double form_factor(const Vec3& x, const Vec3& n) const;

 private:
  static constexpr std::size_t k_capacity = 16;  // corners of a piece

  // Signed distance u p.x + v p.y + w, scaled by whatever the plane's normal is, which `rounding` is in units of.
  struct HalfPlane {
    double u, v, w;
    double rounding;
  };
  struct Piece {
    std::size_t size;
    std::array<Vec2, k_capacity> corners;
  };
  enum class Cut { outside, inside, both, full };

  HalfPlane trace(const Vec3& normal, double offset, double rounding) const;
  static Cut cut(const HalfPlane& half, const Piece& piece, Piece& inside, Piece& outside);
  bool subtract(std::span<const HalfPlane> shadow, std::size_t index);
  Vec3 to_space(const Vec2& p) const { return origin_ + p.x * u_ + p.y * v_; }

  Vec3 eye_, normal_, u_, v_;
  Vec3 origin_;   // the first corner, relative to the eye
  double reach_;  // the farthest corner's distance from the eye
  double lift_;
  bool untouched_ = true;
  std::size_t piece_count_ = 1;
  std::array<Piece, k_max_pieces> pieces_;
};

}  // namespace radvor
