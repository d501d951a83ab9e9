// Low-discrepancy directions over a receiver's hemisphere, cosine-weighted: each counts the same.
#pragma once

#include <cstdint>

#include "base/hash.h"
#include "radiosity/strata.h"

namespace radvor {

/// The first two dimensions of Sobol's sequence (1967), scrambled by exclusive or: the first 2^k points are a (0, k, 2)
/// net, one in each of the 2^k elementary boxes of any shape, under every scramble.
class Net {
 public:
  explicit Net(std::uint64_t seed)
      : scramble_x_(static_cast<std::uint32_t>(mix(seed))), scramble_y_(static_cast<std::uint32_t>(mix(seed) >> 32)) {}

  /// In [0, 1)^2.
  Vec2 point(std::uint32_t index) const {
    std::uint32_t x = 0, y = 0;
    for (std::uint32_t bit = 1u << 31, column = 1u << 31; index != 0; index >>= 1, bit >>= 1, column ^= column >> 1) {
      if (index & 1) {
        x ^= bit;
        y ^= column;
      }
    }
    return {to_unit(x ^ scramble_x_), to_unit(y ^ scramble_y_)};
  }

 private:
  // The middle of the finest box.
  static double to_unit(std::uint32_t bits) { return (bits + 0.5) * 0x1p-32; }

  std::uint32_t scramble_x_, scramble_y_;
};

/// The direction of a point of a net.
inline Vec3 direction(const Basis& basis, const Vec2& point) {
  return basis.on_hemisphere(square_to_disk(2 * point.x - 1, 2 * point.y - 1));
}

}  // namespace radvor
