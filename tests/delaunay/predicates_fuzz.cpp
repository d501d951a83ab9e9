// Eight numbers from the bytes make four points; the predicates must have the signs that GMP's rationals give.
#include <gmpxx.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "delaunay/predicates.h"

using radvor::Vec2;
using radvor::delaunay::Lattice;

namespace {

mpq_class exact(double x) {
  return mpq_class(x);
}

int sign_of_orientation(const Vec2 (&p)[4]) {
  const mpq_class x = exact(p[2].x), y = exact(p[2].y);
  return sgn(mpq_class((exact(p[0].x) - x) * (exact(p[1].y) - y) - (exact(p[0].y) - y) * (exact(p[1].x) - x)));
}

int sign_of_in_circle(const Vec2 (&p)[4]) {
  mpq_class x[3], y[3], lift[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = exact(p[i].x) - exact(p[3].x);
    y[i] = exact(p[i].y) - exact(p[3].y);
    lift[i] = x[i] * x[i] + y[i] * y[i];
  }
  return sgn(mpq_class(lift[0] * (x[1] * y[2] - x[2] * y[1]) + lift[1] * (x[2] * y[0] - x[0] * y[2]) +
                       lift[2] * (x[0] * y[1] - x[1] * y[0])));
}

bool in_bounds(double x) {
  const double magnitude = std::fabs(x);
  return x == 0 ||
         (magnitude >= radvor::delaunay::k_least_coordinate && magnitude <= radvor::delaunay::k_greatest_coordinate);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A first byte says how: raw doubles, small integers, or small integers and a few ulps.
  if (size < 9) {
    return 0;
  }
  const std::uint8_t kind = data[0] % 3;
  const std::size_t width = kind == 0 ? 8 : 2;
  if (size < 1 + 8 * width) {
    return 0;
  }
  Vec2 p[4];
  for (int i = 0; i < 8; ++i) {
    double value = 0;
    const std::uint8_t* at = data + 1 + static_cast<std::size_t>(i) * width;
    if (kind == 0) {
      std::memcpy(&value, at, sizeof value);
    } else {
      value = static_cast<std::int8_t>(at[0]);
      const int steps = kind == 2 && value != 0 ? at[1] % 5 - 2 : 0;
      for (int k = 0; k < std::abs(steps); ++k) {
        value = std::nextafter(value, steps > 0 ? INFINITY : -INFINITY);
      }
    }
    if (!in_bounds(value)) {
      return 0;
    }
    p[i / 2][i % 2] = value;
  }
  Lattice lattice;
  for (const Vec2 point : p) {
    lattice.include(point);
  }
  const int side = sign_of_orientation(p), inside = sign_of_in_circle(p);
  if (radvor::delaunay::orientation(p[0], p[1], p[2], lattice) != side ||
      radvor::delaunay::exact::orientation(p[0], p[1], p[2]) != side ||
      radvor::delaunay::in_circle(p[0], p[1], p[2], p[3], lattice) != inside ||
      radvor::delaunay::exact::in_circle(p[0], p[1], p[2], p[3]) != inside) {
    for (const Vec2 point : p) {
      std::fprintf(stderr, "{%a, %a}\n", point.x, point.y);
    }
    std::abort();
  }
  return 0;
}
