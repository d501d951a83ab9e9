// What the filters cannot decide: determinants in 128-bit integers where the coordinates are on a coarse enough
// lattice, in twice double precision with a filter of its own, at last in expansions (Shewchuk 1997).
#include "delaunay/predicates.h"

#include "delaunay/double_double.h"
#include "delaunay/expansion.h"

#ifdef __FAST_MATH__
#error "exact predicates need IEEE arithmetic as written: compile without -ffast-math"
#endif
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

namespace radvor::delaunay {

void Lattice::refine(double x) noexcept {
  // The lowest set bit of the mantissa.
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  exponent -= 53;
  while ((mantissa & 1) == 0) {
    mantissa >>= 1;
    ++exponent;
  }
  per_unit_ = std::ldexp(1.0, -exponent);
  orientation_limit_ = std::ldexp(1.0, 53 + 2 * exponent);
  in_circle_limit_ = std::ldexp(1.0, 53 + 4 * exponent);
}

namespace exact {

using expansion::Expansion;

namespace {

struct Offset {
  Expansion<2> x, y;
  Offset(const Vec2& a, const Vec2& b)
      : x(expansion::make(expansion::two_difference(a.x, b.x))),
        y(expansion::make(expansion::two_difference(a.y, b.y))) {}
};

Expansion<16> cross(const Offset& a, const Offset& b) {
  return expansion::difference(expansion::multiplied(a.x, b.y), expansion::multiplied(a.y, b.x));
}

// minor * (a.x^2 + a.y^2)
Expansion<512> lifted(const Offset& a, const Expansion<16>& minor) {
  return expansion::sum(expansion::multiplied(expansion::multiplied(minor, a.x), a.x),
                        expansion::multiplied(expansion::multiplied(minor, a.y), a.y));
}

}  // namespace

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(Offset(a, c), Offset(b, c)).sign();
}

double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(Offset(a, c), Offset(b, c)).estimate();
}

int in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Offset ad(a, d), bd(b, d), cd(c, d);
  return expansion::sum(expansion::sum(lifted(ad, cross(bd, cd)), lifted(bd, cross(cd, ad))), lifted(cd, cross(ad, bd)))
      .sign();
}

}  // namespace exact

namespace detail {

using namespace expansion;

int orientation_far(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Two acx = two_difference(a.x, c.x), acy = two_difference(a.y, c.y);
  const Two bcx = two_difference(b.x, c.x), bcy = two_difference(b.y, c.y);
  if (acx.low == 0 && acy.low == 0 && bcx.low == 0 && bcy.low == 0) {
    // Rounding is monotonic: where the rounded products differ, the exact ones do; else what was rounded off decides.
    const double left = acx.high * bcy.high, right = acy.high * bcx.high;
    if (left != right) {
      return left > right ? 1 : -1;
    }
    const Two exact_left = two_product(acx.high, bcy.high), exact_right = two_product(acy.high, bcx.high);
    return (exact_left.low > exact_right.low) - (exact_left.low < exact_right.low);
  }
  const Two left = acx * bcy, right = acy * bcx;
  const Two determinant = left - right;
  constexpr double k_bound = 0x1p-100;  // the error is below 16 u^2 = 2^-102 of the magnitude
  if (std::fabs(determinant.high) > k_bound * (std::fabs(left.high) + std::fabs(right.high))) {
    return sign(determinant);
  }
  return exact::orientation(a, b, c);
}

namespace {

// Offsets below 2^30 units: lifts are below 2^61, minors below 2^61, so that the sum stays below 2^125.
int in_circle_on_lattice(const double (&offsets)[6]) {
  std::int64_t i[6];
  for (int k = 0; k < 6; ++k) {
    i[k] = static_cast<std::int64_t>(offsets[k]);
  }
  __extension__ using Wide = __int128;
  const Wide determinant = static_cast<Wide>(i[0] * i[0] + i[1] * i[1]) * (i[2] * i[5] - i[4] * i[3]) +
                           static_cast<Wide>(i[2] * i[2] + i[3] * i[3]) * (i[4] * i[1] - i[0] * i[5]) +
                           static_cast<Wide>(i[4] * i[4] + i[5] * i[5]) * (i[0] * i[3] - i[2] * i[1]);
  return (determinant > 0) - (determinant < 0);
}

}  // namespace

int in_circle_far(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, const Lattice& lattice) {
  constexpr double k_most_units = 0x1p30;  // a difference of that few units is exact
  const double scale = lattice.per_unit();
  const double offsets[6] = {(a.x - d.x) * scale, (a.y - d.y) * scale, (b.x - d.x) * scale,
                             (b.y - d.y) * scale, (c.x - d.x) * scale, (c.y - d.y) * scale};
  bool small = true;
  for (const double offset : offsets) {
    small &= std::fabs(offset) < k_most_units;
  }
  if (small) {
    return in_circle_on_lattice(offsets);
  }
  const Two ax = two_difference(a.x, d.x), ay = two_difference(a.y, d.y);
  const Two bx = two_difference(b.x, d.x), by = two_difference(b.y, d.y);
  const Two cx = two_difference(c.x, d.x), cy = two_difference(c.y, d.y);
  const Two bc = bx * cy, cb = cx * by, ca = cx * ay, ac = ax * cy, ab = ax * by, ba = bx * ay;
  const Two a_lift = ax * ax + ay * ay, b_lift = bx * bx + by * by, c_lift = cx * cx + cy * cy;
  const Two determinant = a_lift * (bc - cb) + b_lift * (ca - ac) + c_lift * (ab - ba);
  const double magnitude = (std::fabs(bc.high) + std::fabs(cb.high)) * a_lift.high +
                           (std::fabs(ca.high) + std::fabs(ac.high)) * b_lift.high +
                           (std::fabs(ab.high) + std::fabs(ba.high)) * c_lift.high;
  // Lifts and minors are off by 14 u^2 of their magnitudes, their products by 38 u^2 and a little, the sum by 46 u^2
  // and a little: less than 2^-100 of the whole magnitude.
  constexpr double k_bound = 0x1p-98;
  if (std::fabs(determinant.high) > k_bound * magnitude) {
    return sign(determinant);
  }
  return exact::in_circle(a, b, c, d);
}

}  // namespace detail

}  // namespace radvor::delaunay
