// The predicates against GMP's rationals, where they are hardest.
#include "delaunay/predicates.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace radvor::delaunay {
namespace {

// Doubles are integers times a power of two; scaled by 2^200 they are integers up to 2^400.
mpz_class scaled(double x) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(x, &exponent), 53);
  mpz_class result(mantissa);
  const int shift = exponent - 53 + 200;
  if (x == 0) {
    return 0;
  }
  if (shift >= 0) {
    mpz_mul_2exp(result.get_mpz_t(), result.get_mpz_t(), static_cast<unsigned long>(shift));
  } else {
    mpz_fdiv_q_2exp(result.get_mpz_t(), result.get_mpz_t(), static_cast<unsigned long>(-shift));
  }
  return result;
}

struct Exact {
  explicit Exact(Vec2 p) : x(scaled(p.x)), y(scaled(p.y)) {}
  Exact(const mpz_class& x_, const mpz_class& y_) : x(x_), y(y_) {}
  Exact operator-(const Exact& other) const { return {mpz_class(x - other.x), mpz_class(y - other.y)}; }
  mpz_class x, y;
};

int oracle_orientation(Vec2 a, Vec2 b, Vec2 c) {
  const Exact p = Exact(a) - Exact(c), q = Exact(b) - Exact(c);
  return sgn(mpz_class(p.x * q.y - p.y * q.x));
}

int oracle_in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Exact at(d);
  const Exact p = Exact(a) - at, q = Exact(b) - at, r = Exact(c) - at;
  const mpz_class pp = p.x * p.x + p.y * p.y, qq = q.x * q.x + q.y * q.y, rr = r.x * r.x + r.y * r.y;
  return sgn(mpz_class(pp * (q.x * r.y - r.x * q.y) + qq * (r.x * p.y - p.x * r.y) + rr * (p.x * q.y - q.x * p.y)));
}

struct Counts {
  int zero = 0, other = 0;
};

// Both the filtered and the plain exact forms, with the lattice that the points make.
void check(const Vec2 (&p)[4], Counts& counts) {
  Lattice lattice;
  for (const Vec2 point : p) {
    lattice.include(point);
  }
  const int side = oracle_orientation(p[0], p[1], p[2]);
  ASSERT_EQ(orientation(p[0], p[1], p[2], lattice), side);
  ASSERT_EQ(exact::orientation(p[0], p[1], p[2]), side);
  const int inside = oracle_in_circle(p[0], p[1], p[2], p[3]);
  ASSERT_EQ(in_circle(p[0], p[1], p[2], p[3], lattice), inside);
  ASSERT_EQ(exact::in_circle(p[0], p[1], p[2], p[3]), inside);
  ++(side == 0 || inside == 0 ? counts.zero : counts.other);
}

constexpr int k_cases = 250000;  // each decided four times, and once more where it is nudged

double nudged(double x, std::mt19937_64& random) {
  if (x == 0) {
    return x;  // beside it are denormals, out of bounds
  }
  switch (random() % 4) {
    case 0:
      return std::nextafter(x, INFINITY);
    case 1:
      return std::nextafter(x, -INFINITY);
    default:
      return x;
  }
}

TEST(predicates, integer_grids) {
  std::mt19937_64 random(1);
  Counts counts;
  for (int i = 0; i < k_cases; ++i) {
    const int bits = static_cast<int>(random() % 45) + 1;
    const double unit = std::ldexp(1.0, static_cast<int>(random() % 20) - 10);
    Vec2 p[4];
    for (Vec2& point : p) {
      point =
          unit * Vec2(static_cast<double>(random() % (1ull << bits)), static_cast<double>(random() % (1ull << bits)));
    }
    ASSERT_NO_FATAL_FAILURE(check(p, counts));
  }
  EXPECT_GT(counts.zero, 1000);
}

TEST(predicates, pythagorean_circles_and_one_ulp_beside) {
  std::mt19937_64 random(2);
  Counts exact_ones, nudged_ones;
  for (int i = 0; i < k_cases; ++i) {
    // (m^2 - n^2, 2 m n) is at distance m^2 + n^2 from 0; multiply four of them to a common radius.
    std::int64_t x[4], y[4], r[4];
    for (int k = 0; k < 4; ++k) {
      const auto m = static_cast<std::int64_t>(random() % 30 + 2), n = static_cast<std::int64_t>(random() % 30);
      x[k] = m * m - n * n;
      y[k] = 2 * m * n;
      r[k] = m * m + n * n;
    }
    const std::int64_t product = r[0] * r[1] * r[2] * r[3];
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    Vec2 p[4];
    for (int k = 0; k < 4; ++k) {
      const double sign_x = random() % 2 ? 1 : -1, sign_y = random() % 2 ? 1 : -1;
      p[k] = scale * Vec2(sign_x * static_cast<double>(product / r[k] * x[k]),
                          sign_y * static_cast<double>(product / r[k] * y[k]));
    }
    ASSERT_NO_FATAL_FAILURE(check(p, exact_ones));
    for (Vec2& point : p) {
      point = {nudged(point.x, random), nudged(point.y, random)};
    }
    ASSERT_NO_FATAL_FAILURE(check(p, nudged_ones));
  }
  EXPECT_GT(exact_ones.zero, k_cases / 2);
  EXPECT_GT(nudged_ones.other, k_cases / 2);
}

TEST(predicates, collinear_runs_and_one_ulp_beside) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  Counts counts;
  for (int i = 0; i < k_cases; ++i) {
    const Vec2 from(unit(random), unit(random)), along(unit(random), unit(random));
    Vec2 p[4];
    for (Vec2& point : p) {
      point = from + static_cast<double>(static_cast<int>(random() % 64) - 32) / 32 * along;
      point = {nudged(point.x, random), nudged(point.y, random)};
    }
    ASSERT_NO_FATAL_FAILURE(check(p, counts));
  }
}

// Differences of the coordinates are not doubles here, and determinants about as large as the errors of doubles.
TEST(predicates, rounded_circles_and_lines_away_from_zero) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  Counts counts;
  for (int i = 0; i < k_cases; ++i) {
    const Vec2 centre(unit(random), unit(random));
    const double radius = std::ldexp(1 + std::fabs(unit(random)), -static_cast<int>(random() % 30));
    const double slope = unit(random);
    Vec2 on_circle[4], on_line[4];
    for (int k = 0; k < 4; ++k) {
      const double angle = 4 * unit(random), at = unit(random);
      on_circle[k] = centre + radius * Vec2(std::cos(angle), std::sin(angle));
      on_line[k] = centre + radius * Vec2(at, at * slope);
    }
    ASSERT_NO_FATAL_FAILURE(check(on_circle, counts));
    ASSERT_NO_FATAL_FAILURE(check(on_line, counts));
  }
}

TEST(predicates, all_magnitudes_within_the_bound) {
  std::mt19937_64 random(4);
  std::uniform_int_distribution<int> exponent(-142, 199);
  std::uniform_real_distribution<double> mantissa(1, 2);
  Counts counts;
  const auto coordinate = [&](int near) {
    const int e = random() % 2 ? near : exponent(random);
    const double m = random() % 3 == 0 ? 1 : mantissa(random);
    return random() % 8 == 0 ? 0.0 : std::ldexp(random() % 2 ? m : -m, e);
  };
  for (int i = 0; i < k_cases; ++i) {
    const int near = random() % 4 == 0 ? (random() % 2 ? -142 : 199) : exponent(random);
    Vec2 p[4];
    for (Vec2& point : p) {
      point = {coordinate(near), coordinate(near)};
    }
    if (random() % 2) {
      p[3] = {nudged(p[0].x, random), nudged(p[1].y, random)};
      for (int axis = 0; axis < 2; ++axis) {
        if (std::fabs(p[3][axis]) < k_least_coordinate || std::fabs(p[3][axis]) > k_greatest_coordinate) {
          p[3][axis] = 0;
        }
      }
    }
    ASSERT_NO_FATAL_FAILURE(check(p, counts));
  }
  EXPECT_GT(counts.zero, 1000);
}

TEST(predicates, need_no_fused_multiply_add) {
  // 1 - (1 + 2^-30)(1 - 2^-30) is 2^-60; contracted or not, the sign below is that of the exact value.
  const double e = 0x1p-30;
  const Vec2 a(1 + e, 1), b(1, 1 - e), c(0, 0);
  Lattice lattice;
  lattice.include(a);
  lattice.include(b);
  EXPECT_EQ(orientation(a, b, c, lattice), -1);
  EXPECT_EQ(exact::orientation(a, b, c), -1);
}

}  // namespace
}  // namespace radvor::delaunay
