#include "output/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/hash.h"

namespace radvor {
namespace {

double random(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return to_unit(hash(a, b, c)) * 2 - 1;
}

Vec3 random_point(std::uint64_t a, std::uint64_t b) {
  return {random(a, b, 0), random(a, b, 1), random(a, b, 2)};
}

ClosestPoint::Triangle triangle_of(const std::array<Vec3, 3>& corners, bool two_sided = false) {
  return {corners, normalize(cross(corners[1] - corners[0], corners[2] - corners[0])), two_sided};
}

ClosestPoint index_of(const std::vector<ClosestPoint::Triangle>& triangles) {
  std::pmr::memory_resource* memory = std::pmr::new_delete_resource();
  return {std::pmr::vector<ClosestPoint::Triangle>(triangles.begin(), triangles.end(), memory), memory};
}

TEST(ClosestPointOfTriangle, IsInTheTriangleAndNoPointOfItIsNearer) {
  constexpr int k_steps = 12;
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    const std::array<Vec3, 3> t = {random_point(trial, 1), random_point(trial, 2), random_point(trial, 3)};
    const Vec3 p = 2.0 * random_point(trial, 4);
    const Vec3 closest = closest_point_of_triangle(p, t);
    const double distance = length(p - closest);
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= k_steps; ++i) {
      for (int j = 0; i + j <= k_steps; ++j) {
        const double u = static_cast<double>(i) / k_steps;
        const double v = static_cast<double>(j) / k_steps;
        const Vec3 q = (1 - u - v) * t[0] + u * t[1] + v * t[2];
        nearest = std::min(nearest, length(p - q));
        // A convex set: the closest point sees all others behind the plane through it.
        EXPECT_LE(dot(p - closest, q - closest), 1e-12);
      }
    }
    EXPECT_LE(distance, nearest + 1e-12);
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    EXPECT_NEAR(dot(closest - t[0], normal), 0, 1e-12);
  }
}

TEST(ClosestPoint, AgreesWithLookingAtEveryTriangle) {
  std::vector<ClosestPoint::Triangle> triangles;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Vec3 middle = 4.0 * random_point(i, 0);
    triangles.push_back(triangle_of(
        {middle + random_point(i, 1), middle + random_point(i, 2), middle + random_point(i, 3)}, i % 3 == 0));
  }
  const ClosestPoint index = index_of(triangles);
  int backs = 0;
  int misses = 0;
  for (std::uint64_t query = 0; query < 2000; ++query) {
    const Vec3 point = 6.0 * random_point(query, 10);
    const Vec3 normal = random_point(query, 11);
    const double max_distance = 2 * to_unit(hash(query, 12));
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t expected = 0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      const double cosine = dot(triangles[i].normal, normalize(normal));
      if ((triangles[i].two_sided ? std::abs(cosine) : cosine) <= 0.01) {
        continue;
      }
      const double distance = length(point - closest_point_of_triangle(point, triangles[i].corners));
      if (distance < nearest) {
        nearest = distance;
        expected = i;
      }
    }
    const auto found = index.find(point, normal, max_distance);
    ASSERT_EQ(found.has_value(), nearest <= max_distance);
    if (!found) {
      ++misses;
      continue;
    }
    EXPECT_EQ(found->triangle, expected);
    EXPECT_EQ(found->back, dot(triangles[expected].normal, normal) < 0);
    EXPECT_NEAR(length(found->point - point), nearest, 1e-12);
    backs += found->back ? 1 : 0;
  }
  EXPECT_GT(backs, 50);
  EXPECT_GT(misses, 200);
}

TEST(ClosestPoint, OnAnEdgeTheTriangleThatFacesMostAnswers) {
  // A floor, and a wall that stands on it; the point is on both.
  const ClosestPoint index = index_of({triangle_of({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}),
                                       triangle_of({Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})});
  const Vec3 point(0, 0.3, 1e-17);
  EXPECT_EQ(index.find(point, Vec3(0.1, 0, 3), 1)->triangle, 0u);
  EXPECT_EQ(index.find(point, Vec3(3, 0, 0.1), 1)->triangle, 1u);
  EXPECT_EQ(index.find(point, Vec3(1e-9, 0, 1), 1)->triangle, 0u);
  EXPECT_FALSE(index.find(point, Vec3(-1, 0, 1e-9), 1).has_value());
}

TEST(ClosestPoint, QuestionsWithoutAnAnswerHaveNone) {
  const ClosestPoint none = index_of({});
  EXPECT_FALSE(none.find(Vec3(0.0), Vec3(0, 0, 1), 1e300).has_value());
  const ClosestPoint index = index_of({triangle_of({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)})});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(index.find(Vec3(0.2, 0.2, 5), Vec3(0, 0, 1), infinity).has_value());
  EXPECT_TRUE(index.find(Vec3(0.25, 0.25, 0), Vec3(0, 0, 1), 0).has_value());
  EXPECT_FALSE(index.find(Vec3(0.2, 0.2, 5), Vec3(0.0), infinity).has_value());
  EXPECT_FALSE(index.find(Vec3(0.2, 0.2, 5), Vec3(0, 0, nan), infinity).has_value());
  EXPECT_FALSE(index.find(Vec3(nan, 0.2, 5), Vec3(0, 0, 1), infinity).has_value());
  EXPECT_FALSE(index.find(Vec3(0.2, 0.2, 5), Vec3(0, 0, 1), nan).has_value());
  EXPECT_FALSE(index.find(Vec3(0.2, 0.2, 5), Vec3(0, 0, 1), -1).has_value());
}

}  // namespace
}  // namespace radvor
