// Numbers of twice double precision: unevaluated sums high + low with |low| <= ulp(high) / 2, rounded after each
// operation (T. J. Dekker, "A floating-point technique for extending the available precision", 1971). With u = 2^-53 a
// product is off by less than 10 u^2 |a b|, a sum by less than 4 u^2 (|a| + |b|). Needs what expansion.h needs.
#pragma once

#include "delaunay/expansion.h"

namespace radvor::delaunay::expansion {

inline Two operator*(Two a, Two b) {
  const Two high = two_product(a.high, b.high);
  return fast_two_sum(high.high, high.low + (a.high * b.low + a.low * b.high));
}

inline Two operator+(Two a, Two b) {
  const Two high = two_sum(a.high, b.high);
  return fast_two_sum(high.high, high.low + (a.low + b.low));
}

inline Two operator-(Two a, Two b) {
  return a + Two{-b.high, -b.low};
}

inline int sign(Two a) {
  return (a.high > 0) - (a.high < 0);
}

}  // namespace radvor::delaunay::expansion
