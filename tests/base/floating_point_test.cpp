// The guard sets what the numbers rely on and gives all of the caller's environment back.
#include "base/floating_point.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <limits>

namespace radvor {
namespace {

// Through volatile, so that the sums and products below are made at run time, under the mode of the moment.
double sum(double a, double b) {
  volatile double x = a, y = b;
  return x + y;
}
double product(double a, double b) {
  volatile double x = a, y = b;
  return x * y;
}

constexpr double k_tiny = std::numeric_limits<double>::epsilon() / 4;
constexpr double k_smallest_normal = std::numeric_limits<double>::min();

TEST(FloatingPointGuard, RoundsToNearestWhateverTheCallerSet) {
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const double up_outside = sum(1.0, k_tiny), down_outside = sum(1.0, -k_tiny / 2);
    double up_inside = 0, down_inside = 0;
    {
      const FloatingPointGuard guard(Denormals::keep);
      up_inside = sum(1.0, k_tiny);
      down_inside = sum(1.0, -k_tiny / 2);
    }
    const double up_after = sum(1.0, k_tiny), down_after = sum(1.0, -k_tiny / 2);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(up_inside, 1.0);
    EXPECT_EQ(down_inside, 1.0);
    EXPECT_EQ(up_after, up_outside) << "mode " << mode;
    EXPECT_EQ(down_after, down_outside) << "mode " << mode;
    if (mode == FE_UPWARD) {
      EXPECT_GT(up_outside, 1.0);
    }
    if (mode == FE_DOWNWARD) {
      EXPECT_LT(down_outside, 1.0);
    }
  }
}

#if defined(__SSE2__) || defined(__aarch64__)
TEST(FloatingPointGuard, KeepsOrFlushesDenormals) {
  EXPECT_GT(product(k_smallest_normal, 0.5), 0.0);
  {
    const FloatingPointGuard flushing(Denormals::flush);
    EXPECT_EQ(product(k_smallest_normal, 0.5), 0.0);
    {
      const FloatingPointGuard keeping(Denormals::keep);
      EXPECT_GT(product(k_smallest_normal, 0.5), 0.0);
    }
    EXPECT_EQ(product(k_smallest_normal, 0.5), 0.0);
  }
  EXPECT_GT(product(k_smallest_normal, 0.5), 0.0);
}
#endif

TEST(FloatingPointGuard, GivesTheStickyFlagsBack) {
  std::feclearexcept(FE_ALL_EXCEPT);
  {
    const FloatingPointGuard guard(Denormals::keep);
    EXPECT_GT(sum(1.0, k_tiny), 0.5);
    volatile double zero = 0.0;
    volatile double quotient = 1.0 / zero;
    (void)quotient;
  }
  EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO | FE_INEXACT), 0);
  std::feraiseexcept(FE_OVERFLOW);
  { const FloatingPointGuard guard(Denormals::keep); }
  EXPECT_NE(std::fetestexcept(FE_OVERFLOW), 0);
  std::feclearexcept(FE_ALL_EXCEPT);
}

}  // namespace
}  // namespace radvor
