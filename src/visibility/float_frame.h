// From the scene's doubles to the floats that rays are traced in: coordinates are recentred and scaled by a power of
// two, so that the occluders just fit into [-1, 1]. Where the scene lies and how large it is then costs no precision,
// and products of many coordinates neither overflow nor fall among the denormals, which workers flush to 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "base/vector.h"

namespace radvor {

class FloatFrame {
 public:
  /// From the positions that corners name; without any, the identity.
  FloatFrame(std::span<const Vec3> positions, std::span<const std::uint32_t> corners) {
    if (corners.empty()) {
      return;
    }
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high(-low);
    for (const std::uint32_t corner : corners) {
      low = glm::min(low, positions[corner]);
      high = glm::max(high, positions[corner]);
    }
    centre_ = 0.5 * low + 0.5 * high;
    const Vec3 half = glm::max(high - centre_, centre_ - low);
    const double extent = std::max({half.x, half.y, half.z});
    if (extent > 0) {
      int exponent = 0;
      std::frexp(extent, &exponent);  // extent < 2^exponent
      to_frame_ = std::ldexp(1.0, -exponent);
      rounding_ = std::ldexp(1.0, exponent - 25);
    }
    const Vec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    rounding_ += 0x1p-53 * std::max({farthest.x, farthest.y, farthest.z});
  }

  Vec3 to_frame(const Vec3& position) const { return (position - centre_) * to_frame_; }

  double scale() const { return to_frame_; }  ///< frame units in a scene unit

  /// The most that a coordinate is off once it is a float, scene units: half a unit in the last place of the largest,
  /// to which half a one of the caller's own double is added, for scenes far from 0. 0 without triangles.
  double rounding() const { return rounding_; }

 private:
  Vec3 centre_{0};
  double to_frame_ = 1;
  double rounding_ = 0;
};

}  // namespace radvor
