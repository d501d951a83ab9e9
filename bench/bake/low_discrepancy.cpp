#include "low_discrepancy.h"

namespace bench {
namespace {

std::uint32_t reversed(std::uint32_t bits) noexcept {
  bits = (bits >> 16) | (bits << 16);
  bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
  bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
  bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
  return ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
}

/// Each bit of the result depends on that bit and on lower ones alone: on reversed bits a random permutation of a tree.
std::uint32_t permuted_upwards(std::uint32_t bits, std::uint32_t seed) noexcept {
  bits += seed;
  bits ^= bits * 0x6c50b47cu;
  bits ^= bits * 0xb82f1e52u;
  bits ^= bits * 0xc7afe638u;
  return bits ^ (bits * 0x8d22f6e6u);
}

std::uint32_t scrambled(std::uint32_t bits, std::uint32_t seed) noexcept {
  return reversed(permuted_upwards(reversed(bits), seed));
}

/// A primitive polynomial, its inner coefficients as bits, and the first direction numbers.
struct Polynomial {
  std::uint32_t degree, coefficients;
  std::array<std::uint32_t, 3> first;
};
constexpr std::array<Polynomial, 3> k_polynomials{{{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};

/// Column k of the matrix of a dimension: what bit k of the index adds.
std::array<std::uint32_t, 32> columns_of(std::size_t dimension) {
  std::array<std::uint32_t, 32> columns{};
  if (dimension == 0) {
    for (std::uint32_t k = 0; k < 32; ++k) {
      columns[k] = 1u << (31 - k);
    }
    return columns;
  }
  const Polynomial& polynomial = k_polynomials[dimension - 1];
  const std::uint32_t degree = polynomial.degree;
  for (std::uint32_t k = 0; k < 32; ++k) {
    if (k < degree) {
      columns[k] = polynomial.first[k] << (31 - k);
      continue;
    }
    columns[k] = columns[k - degree] ^ (columns[k - degree] >> degree);
    for (std::uint32_t i = 1; i < degree; ++i) {
      if ((polynomial.coefficients >> (degree - 1 - i) & 1u) != 0) {
        columns[k] ^= columns[k - i];
      }
    }
  }
  return columns;
}

}  // namespace

std::uint32_t mixed(std::uint32_t a, std::uint32_t b) noexcept {
  std::uint64_t hash = (std::uint64_t{a} << 32 | b) + 0x9e3779b97f4a7c15u;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;  // the finaliser of splitmix64
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
  return static_cast<std::uint32_t>(hash >> 32);
}

Sobol::Sobol() {
  for (std::size_t dimension = 0; dimension < k_dimensions; ++dimension) {
    const std::array<std::uint32_t, 32> columns = columns_of(dimension);
    for (std::size_t byte = 0; byte < 4; ++byte) {
      for (std::size_t value = 0; value < 256; ++value) {
        for (std::size_t bit = 0; bit < 8; ++bit) {
          if ((value >> bit & 1u) != 0) {
            table_[dimension][byte][value] ^= columns[8 * byte + bit];
          }
        }
      }
    }
  }
}

std::array<float, 4> Sobol::point(std::uint32_t index, std::uint32_t seed) const noexcept {
  const std::uint32_t shuffled = scrambled(index, seed);
  std::array<float, 4> point{};
  for (std::size_t dimension = 0; dimension < k_dimensions; ++dimension) {
    std::uint32_t bits = 0;
    for (std::size_t byte = 0; byte < 4; ++byte) {
      bits ^= table_[dimension][byte][shuffled >> (8 * byte) & 0xffu];
    }
    point[dimension] = unit(scrambled(bits, mixed(seed, static_cast<std::uint32_t>(dimension) + 1)));
  }
  return point;
}

}  // namespace bench
