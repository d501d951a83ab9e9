// Exact sums and products of doubles as expansions: unevaluated sums of doubles that do not overlap, smallest first.
// After J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates" (1997).
// All sizes are known at compile time, everything lives on the stack. Needs round-to-nearest, denormals, and no
// contraction to fused multiply-add.
#pragma once

#include <array>
#include <cstddef>

namespace radvor::delaunay::expansion {

struct Two {
  double high, low;  ///< high + low exactly, |low| <= ulp(high) / 2
};

inline Two two_sum(double a, double b) {
  const double high = a + b;
  const double b_virtual = high - a;
  return {high, (a - (high - b_virtual)) + (b - b_virtual)};
}

/// Requires |a| >= |b| or a == 0.
inline Two fast_two_sum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

inline Two two_difference(double a, double b) {
  const double high = a - b;
  const double b_virtual = a - high;
  return {high, (a - (high + b_virtual)) + (b_virtual - b)};
}

/// Veltkamp's split into two halves of 26 bits; no overflow below 2^996.
inline Two split(double a) {
  constexpr double k_splitter = 134217729.0;  // 2^27 + 1
  const double c = k_splitter * a;
  const double high = c - (c - a);
  return {high, a - high};
}

inline Two two_product(double a, double b, Two b_split) {
  const double high = a * b;
  const Two s = split(a);
  const double error = ((s.high * b_split.high - high) + s.low * b_split.high + s.high * b_split.low);
  return {high, s.low * b_split.low + error};
}
inline Two two_product(double a, double b) {
  return two_product(a, b, split(b));
}

/// At most Capacity components, size of them in use, none zero unless it is the only one.
template <std::size_t Capacity>
struct Expansion {
  std::array<double, Capacity> part;
  std::size_t size = 0;

  void push(double component) {
    if (component != 0) {
      part[size++] = component;
    }
  }
  /// Its value, rounded a few times.
  double estimate() const {
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) {
      sum += part[i];
    }
    return sum;
  }
  /// The largest component has the sign of the whole.
  int sign() const { return size == 0 ? 0 : (part[size - 1] > 0) - (part[size - 1] < 0); }
};

inline Expansion<2> make(Two two) {
  Expansion<2> result;
  result.push(two.low);
  result.push(two.high);
  return result;
}

/// Shewchuk's fast_expansion_sum_zeroelim.
template <std::size_t A, std::size_t B>
Expansion<A + B> sum(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<A + B> result;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto take = [&] {
    // By magnitude, as merging needs it.
    if (j == b.size) {
      return a.part[i++];
    }
    if (i == a.size) {
      return b.part[j++];
    }
    return (b.part[j] > a.part[i]) == (b.part[j] > -a.part[i]) ? a.part[i++] : b.part[j++];
  };
  if (a.size + b.size == 0) {
    return result;
  }
  double carry = take();
  for (std::size_t k = 1; k < a.size + b.size; ++k) {
    const Two t = two_sum(carry, take());
    result.push(t.low);
    carry = t.high;
  }
  result.push(carry);
  return result;
}

template <std::size_t A>
Expansion<A> negated(Expansion<A> a) {
  for (std::size_t i = 0; i < a.size; ++i) {
    a.part[i] = -a.part[i];
  }
  return a;
}

template <std::size_t A, std::size_t B>
Expansion<A + B> difference(const Expansion<A>& a, const Expansion<B>& b) {
  return sum(a, negated(b));
}

/// Shewchuk's scale_expansion_zeroelim.
template <std::size_t A>
Expansion<2 * A> scaled(const Expansion<A>& a, double factor) {
  Expansion<2 * A> result;
  if (a.size == 0 || factor == 0) {
    return result;
  }
  const Two factor_split = split(factor);
  const Two first = two_product(a.part[0], factor, factor_split);
  result.push(first.low);
  double carry = first.high;
  for (std::size_t i = 1; i < a.size; ++i) {
    const Two product = two_product(a.part[i], factor, factor_split);
    const Two low = two_sum(carry, product.low);
    result.push(low.low);
    const Two high = fast_two_sum(product.high, low.high);
    result.push(high.low);
    carry = high.high;
  }
  result.push(carry);
  return result;
}

/// The product of any expansion with a short one (a difference of two doubles).
template <std::size_t A>
Expansion<4 * A> multiplied(const Expansion<A>& a, const Expansion<2>& b) {
  if (b.size == 0) {
    return {};
  }
  if (b.size == 1) {
    const Expansion<2 * A> only = scaled(a, b.part[0]);
    Expansion<4 * A> result;
    for (std::size_t i = 0; i < only.size; ++i) {
      result.part[i] = only.part[i];
    }
    result.size = only.size;
    return result;
  }
  return sum(scaled(a, b.part[0]), scaled(a, b.part[1]));
}

}  // namespace radvor::delaunay::expansion
