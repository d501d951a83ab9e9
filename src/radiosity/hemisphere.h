// Low-discrepancy directions over a receiver's hemisphere, cosine-weighted: each counts the same.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/hash.h"
#include "radiosity/strata.h"

namespace radvor {

/// A point of Sobol's sequence (1967), its first two dimensions, as numerators over 2^32.
struct NetBits {
  std::uint32_t x = 0, y = 0;

  constexpr NetBits() = default;
  constexpr NetBits(std::uint32_t x_bits, std::uint32_t y_bits) : x(x_bits), y(y_bits) {}
  constexpr explicit NetBits(std::uint32_t index) {
    for (NetBits column(1u << 31, 1u << 31); index != 0; index >>= 1) {
      *this = index & 1 ? *this ^ column : *this;
      column = {column.x >> 1, column.y ^ (column.y >> 1)};
    }
  }

  constexpr NetBits operator^(const NetBits& other) const { return {x ^ other.x, y ^ other.y}; }
};

/// The first points: nearly all hemispheres take no more.
inline constexpr auto k_net = [] {
  std::array<NetBits, 1024> first;
  for (std::uint32_t index = 0; index < first.size(); ++index) {
    first[index] = NetBits(index);
  }
  return first;
}();

/// The sequence scrambled by exclusive or: the first 2^k points are a (0, k, 2) net, one in each of the 2^k elementary
/// boxes of any shape, under every scramble.
class Net {
 public:
  explicit Net(std::uint64_t seed)
      : scramble_(static_cast<std::uint32_t>(mix(seed)), static_cast<std::uint32_t>(mix(seed) >> 32)) {}

  /// In [0, 1)^2.
  Vec2 point(std::uint32_t index) const {
    const std::uint32_t low = index % k_net.size();
    NetBits bits = k_net[low] ^ scramble_;
    if (low != index) {  // the sequence is linear in the index's bits
      bits = bits ^ NetBits(index - low);
    }
    return {to_unit(bits.x), to_unit(bits.y)};
  }

 private:
  // The middle of the finest box.
  static double to_unit(std::uint32_t bits) { return (bits + 0.5) * 0x1p-32; }

  NetBits scramble_;
};

/// The first 2^k points of a net in an order in which those that follow one another lie close together: along a
/// Z-curve through its 2^k boxes, each of which has one. The same for every scramble, which moves boxes as a whole.
class NetOrder {
 public:
  NetOrder() {
    const Net net(0);
    for (std::uint32_t bits = 0; bits <= k_most_bits; ++bits) {
      for (std::uint32_t index = 0; index < (1u << bits); ++index) {
        order_[(1u << bits) + place(net.point(index), bits)] = static_cast<std::uint16_t>(index);
      }
    }
  }

  /// count: a power of two. Of more than 1,024 points, each 1,024 by themselves.
  std::uint32_t index(std::uint32_t count, std::uint32_t step) const {
    const std::uint32_t part = std::min(count, 1u << k_most_bits);
    return (step & ~(part - 1)) + order_[part + (step & (part - 1))];
  }

 private:
  static constexpr std::uint32_t k_most_bits = 10;

  // The box of a point, its coordinates' bits in turns.
  static std::uint32_t place(Vec2 point, std::uint32_t bits) {
    std::uint32_t box = 0;
    for (std::uint32_t bit = 0; bit < bits; ++bit) {
      double& coordinate = bit % 2 == 0 ? point.x : point.y;
      coordinate *= 2;
      const bool upper = coordinate >= 1;
      coordinate -= upper ? 1 : 0;
      box = 2 * box + (upper ? 1 : 0);
    }
    return box;
  }

  std::array<std::uint16_t, 2 << k_most_bits> order_{};  // of 2^k points from 2^k on
};

/// The direction of a point of a net.
inline Vec3 direction(const Basis& basis, const Vec2& point) {
  return basis.on_hemisphere(square_to_disk(2 * point.x - 1, 2 * point.y - 1));
}

}  // namespace radvor
