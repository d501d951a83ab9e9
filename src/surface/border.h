// Sites along a welded edge: from its midpoint outward at the element spacing. A function of the edge alone, whose ends
// are ordered by position, so that every facet at the edge has the same sites, bit for bit.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/vector.h"

namespace radvor {

/// Sites keep half the spacing from where a border ends, and from borders; rounding must not decide about those that
/// keep it exactly.
inline constexpr double k_half_spacing = 0.5 - 1e-6;

/// A welded edge, measured from its middle.
class EdgeLine {
 public:
  /// a, b: the edge's ends, in the welded order.
  EdgeLine(const Vec3& a, const Vec3& b) : middle_(0.5 * (a + b)), length_(glm::distance(a, b)) {
    direction_ = length_ > 0 ? (b - a) / length_ : Vec3(0.0);
  }

  /// from_middle: scene units, positive towards b.
  Vec3 position(double from_middle) const { return middle_ + from_middle * direction_; }
  /// Where it lies between a (0) and b (1).
  double part(double from_middle) const { return 0.5 + from_middle / length_; }
  /// Of the foot of a point's perpendicular.
  double from_middle(const Vec3& point) const { return glm::dot(point - middle_, direction_); }

  double length() const { return length_; }

  /// How many sites at a spacing lie between the middle, which is one, and either end: -1 where there is none at all.
  std::int64_t steps(double spacing) const {
    const double outward = std::floor(0.5 * length_ / spacing - k_half_spacing);
    return outward >= 0 ? static_cast<std::int64_t>(std::fmin(outward, k_most_steps)) : -1;
  }

 private:
  static constexpr double k_most_steps = 1 << 24;

  Vec3 middle_, direction_;
  double length_;
};

/// The sites inside one edge at one spacing; its ends are sites anyway. Those at half the spacing contain them.
class EdgeSites {
 public:
  /// a, b: the edge's ends, in the welded order; spacing > 0.
  EdgeSites(const Vec3& a, const Vec3& b, double spacing)
      : line_(a, b), spacing_(spacing), steps_(line_.steps(spacing)) {}

  std::uint32_t count() const { return static_cast<std::uint32_t>(2 * steps_ + 1 > 0 ? 2 * steps_ + 1 : 0); }

  /// From a to b; index < count.
  Vec3 position(std::uint32_t index) const {
    return line_.position(static_cast<double>(static_cast<std::int64_t>(index) - steps_) * spacing_);
  }

 private:
  EdgeLine line_;
  double spacing_;
  std::int64_t steps_;
};

}  // namespace radvor
