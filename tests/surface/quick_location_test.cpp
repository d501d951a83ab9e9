// Points are where floats say that they are, in thin triangles and at any scale.
#include "surface/quick_location.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace radvor {
namespace {

class Quick {
 public:
  /// constrained: the first two points are joined.
  Quick(const std::vector<Vec2>& points, bool constrained)
      : triangulation_(std::pmr::get_default_resource()), quick_(std::pmr::get_default_resource()) {
    triangulation_.insert_many(points, nullptr);
    if (constrained) {
      triangulation_.constrain(0, 1, delaunay::constraint::k_discontinuous);
    }
    std::vector<std::uint32_t> indices(triangulation_.triangle_bound());
    std::iota(indices.begin(), indices.end(), 0u);
    quick_.fill(triangulation_, indices);
  }

  /// How far from the point its weights put it; infinite where it is not found.
  double error_at(const Vec2& point) const {
    std::array<double, 3> weights;
    const std::uint32_t t = quick_.find(point, quick_.start(point), weights);
    if (t == delaunay::k_none) {
      return HUGE_VAL;
    }
    Vec2 told(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      told += weights[k] * triangulation_.position(triangulation_.triangle(t)[k]);
    }
    return glm::distance(told, point);
  }

 private:
  delaunay::Triangulation triangulation_;
  QuickLocation quick_;
};

TEST(QuickLocation, IsOffByAFloatsRoundingAtTheFacetsSizeHoweverThinATriangleIs) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int thin = 2; thin < 24; ++thin) {
    const Vec2 along(0.8, 0.3), across(-0.3, 0.8);
    const Vec2 a(0.1, 0.1), b = a + along, c = a + 0.4 * along + std::ldexp(1.0, -thin) * across;
    const Quick quick({a, b, c, {0, 0}, {1, 0}, {1, 1}, {0, 1}}, true);
    int found = 0;
    for (int k = 0; k < 400; ++k) {
      const double u = uniform(random), v = uniform(random) * (1 - u);
      const double error = quick.error_at((1 - u - v) * a + u * b + v * c);
      if (error < HUGE_VAL) {
        EXPECT_LT(error, 3e-7) << thin;
        ++found;
      }
    }
    EXPECT_TRUE(thin > 18 || found > 380) << thin << " " << found;
  }
}

// Sites so near to a constraint that no walk leads from one side of it to the other.
TEST(QuickLocation, FindsWhatLiesBehindARowOfNeedles) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec2> points = {{0.3, 0}, {0.3, 1}};
  for (int k = 0; k < 40; ++k) {
    points.emplace_back(0.3 + 1e-8, (k + 0.5) / 40.0);
  }
  for (int k = 0; k < 1000; ++k) {
    points.emplace_back(uniform(random), uniform(random));
  }
  const Quick quick(points, true);
  int found = 0;
  for (int k = 0; k < 1000; ++k) {
    found += quick.error_at({0.02 + 0.96 * uniform(random), 0.02 + 0.96 * uniform(random)}) < 3e-7 ? 1 : 0;
  }
  EXPECT_GT(found, 980);
}

TEST(QuickLocation, NoNumberLiesNowhere) {
  const Quick quick({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, false);
  EXPECT_EQ(quick.error_at({NAN, 0.5}), HUGE_VAL);
  EXPECT_EQ(quick.error_at({0.5, NAN}), HUGE_VAL);
  EXPECT_LT(quick.error_at({0.5, 0.25}), 1e-6);
}

TEST(QuickLocation, AtAnyScale) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double scale : {1e-30, 1e-6, 1.0, 1e9}) {
    std::vector<Vec2> points;
    for (int k = 0; k < 200; ++k) {
      points.push_back(scale * Vec2(3 + uniform(random), uniform(random)));
    }
    const Quick quick(points, false);
    for (int k = 0; k < 200; ++k) {
      EXPECT_LT(quick.error_at(scale * Vec2(3.2 + 0.6 * uniform(random), 0.2 + 0.6 * uniform(random))), 3e-7 * scale);
    }
  }
}

}  // namespace
}  // namespace radvor
