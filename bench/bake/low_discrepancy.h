// Sobol points of four dimensions, Owen-scrambled by hashing: every receiver and every set of dimensions gets its own
// scrambling and order, so that sets may be combined freely, and any prefix of 2^k points is stratified.
// I. M. Sobol, "On the distribution of points in a cube and the approximate evaluation of integrals" (1967); direction
// numbers of S. Joe and F. Y. Kuo (2008); B. Burley, "Practical hash-based Owen scrambling", JCGT 9(4) (2020), with the
// permutation of S. Laine and T. Karras (2011).
#pragma once

#include <array>
#include <cstdint>

namespace bench {

/// A hash of two numbers.
std::uint32_t mixed(std::uint32_t a, std::uint32_t b) noexcept;

/// A number of 32 bits as one of 0 <= u < 1.
inline float unit(std::uint32_t bits) noexcept {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

class Sobol {
 public:
  Sobol();

  /// Point number index of the set that the seed names.
  std::array<float, 4> point(std::uint32_t index, std::uint32_t seed) const noexcept;

 private:
  static constexpr int k_dimensions = 4;
  // One table for each byte of the index: a matrix of bits applied eight columns at a time.
  std::array<std::array<std::array<std::uint32_t, 256>, 4>, k_dimensions> table_{};
};

}  // namespace bench
