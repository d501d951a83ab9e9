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

/// The sites inside one edge; its ends are sites anyway.
class EdgeSites {
 public:
  /// a, b: the edge's ends, in the welded order; spacing > 0.
  EdgeSites(const Vec3& a, const Vec3& b, double spacing) : middle_(0.5 * (a + b)), spacing_(spacing) {
    length_ = glm::distance(a, b);
    direction_ = length_ > 0 ? (b - a) / length_ : Vec3(0.0);
    const double outward = std::floor(0.5 * length_ / spacing - k_half_spacing);
    steps_ = outward >= 0 ? static_cast<std::int64_t>(std::fmin(outward, k_most_steps)) : -1;
  }

  std::uint32_t count() const { return static_cast<std::uint32_t>(2 * steps_ + 1 > 0 ? 2 * steps_ + 1 : 0); }

  /// From a to b; index < count.
  Vec3 position(std::uint32_t index) const { return middle_ + from_middle(index) * direction_; }

  /// Where it lies between a (0) and b (1).
  double part(std::uint32_t index) const { return 0.5 + from_middle(index) / length_; }

 private:
  static constexpr double k_most_steps = 1 << 24;

  double from_middle(std::uint32_t index) const {
    return static_cast<double>(static_cast<std::int64_t>(index) - steps_) * spacing_;
  }

  Vec3 middle_, direction_;
  double length_, spacing_;
  std::int64_t steps_;
};

}  // namespace radvor
