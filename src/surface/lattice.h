// The exact lattice of sites on a facet: hexagonal or quadrilateral, nested under halving, every coordinate a multiple
// of one dyadic number, so that ties are ties in double precision on every level. The paper's regular grids (1.2.2).
//
//   level l:  x = anchor.x + (2i + j) * half_column / 2^l     hexagonal (2i alone on the quadrilateral lattice)
//             y = anchor.y +       j  * row         / 2^l
//
// A point (i, j) of level l is the point (2i, 2j) of level l + 1: nothing moves when a lattice is refined.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "base/vector.h"
#include "surface/surface.h"

namespace radvor {

/// Mantissa bits of lattice steps. Anchors keep k_anchor_bits more and indices about 20, within the 53 of a double.
inline constexpr int k_step_bits = 12;
inline constexpr int k_anchor_bits = 13;

/// The nearest number with k_step_bits mantissa bits: off by less than 1/4000, and exact under halving and under
/// multiplication by indices. length > 0.
inline double dyadic_step(double length) {
  int exponent = 0;
  const double mantissa = std::frexp(length, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(mantissa, k_step_bits)), exponent - k_step_bits);
}

/// 2^-level, exactly. level <= 1000.
inline double halved(std::uint32_t level) {
  return std::bit_cast<double>(std::uint64_t{1023 - level} << 52);
}

/// A column and a row number on some level of a lattice.
struct LatticeIndex {
  std::int64_t i, j;
};

class FacetLattice {
 public:
  /// spacing: between sites of level 0, in scene units; centre: of the facet, about which the lattice lies as evenly as
  /// the facet does.
  FacetLattice(Lattice lattice, double spacing, const Vec2& centre)
      : lattice_(lattice),
        column_(dyadic_step(spacing)),
        row_(lattice == Lattice::hexagonal ? dyadic_step(column_ * 0.8660254037844386) : column_),
        quantum_(std::ldexp(1.0, std::ilogb(column_) - k_step_bits - k_anchor_bits)),
        anchor_(std::nearbyint(centre.x / quantum_) * quantum_, std::nearbyint(centre.y / quantum_) * quantum_) {}

  /// Between neighbours in a row of a level.
  double column(std::uint32_t level) const { return column_ * halved(level); }
  /// Between rows of a level.
  double row(std::uint32_t level) const { return row_ * halved(level); }
  /// What all coordinates down to the 12th level are multiples of.
  double quantum() const { return quantum_; }

  Vec2 point(std::uint32_t level, const LatticeIndex& index) const {
    const std::int64_t halves = 2 * index.i + (hexagonal() ? index.j : 0);
    return {anchor_.x + static_cast<double>(halves) * (0.5 * column(level)),
            anchor_.y + static_cast<double>(index.j) * row(level)};
  }

  /// The first and last row within [low, high], and the same of the columns of one row.
  std::int64_t first_row(std::uint32_t level, double low) const { return ceil((low - anchor_.y) / row(level)); }
  std::int64_t last_row(std::uint32_t level, double high) const { return floor((high - anchor_.y) / row(level)); }
  std::int64_t first_column(std::uint32_t level, std::int64_t j, double low) const {
    return ceil((low - anchor_.x) / column(level) - shift(j));
  }
  std::int64_t last_column(std::uint32_t level, std::int64_t j, double high) const {
    return floor((high - anchor_.x) / column(level) - shift(j));
  }

  /// Of a level, to a point of that level but for rounding.
  LatticeIndex nearest(std::uint32_t level, const Vec2& point) const {
    const auto j = static_cast<std::int64_t>(std::nearbyint((point.y - anchor_.y) / row(level)));
    return {static_cast<std::int64_t>(std::nearbyint((point.x - anchor_.x) / column(level) - shift(j))), j};
  }

  /// The lowest level that holds the point (i, j) of a level.
  static std::uint32_t coarsest_level(std::uint32_t level, LatticeIndex index) {
    while (level > 0 && index.i % 2 == 0 && index.j % 2 == 0) {
      index = {index.i / 2, index.j / 2};
      --level;
    }
    return level;
  }

  /// The area that one site of level 0 stands for.
  double cell_area() const { return column_ * row_; }

 private:
  bool hexagonal() const { return lattice_ == Lattice::hexagonal; }
  double shift(std::int64_t j) const { return hexagonal() ? 0.5 * static_cast<double>(j) : 0.0; }
  static std::int64_t ceil(double value) { return static_cast<std::int64_t>(std::ceil(value)); }
  static std::int64_t floor(double value) { return static_cast<std::int64_t>(std::floor(value)); }

  Lattice lattice_;
  double column_, row_, quantum_;
  Vec2 anchor_;
};

/// Coordinates are exact down to this level.
inline constexpr std::uint32_t k_exact_levels = 12;

/// How often the first elements' lattice may be halved: the spacing stays at or above min_spacing, coordinates exact.
inline std::uint32_t refinements(const SurfaceOptions& options) {
  const double spacing = dyadic_step(options.patch_spacing) * halved(options.element_levels);
  std::uint32_t count = 0;
  while (options.element_levels + count < k_exact_levels &&
         spacing * halved(count + 1) >= options.min_spacing * (1 - 1e-3)) {
    ++count;
  }
  return count;
}

}  // namespace radvor
