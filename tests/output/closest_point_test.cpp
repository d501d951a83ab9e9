// Nearest surface points against brute force.
#include "output/closest_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <random>
#include <vector>

#include "support/test_host.h"

namespace radvor {
namespace {

constexpr double k_far = std::numeric_limits<double>::infinity();

struct Soup {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint8_t> two_sided;

  void add(const Vec3& a, const Vec3& b, const Vec3& c, bool both = false) {
    for (const Vec3& p : {a, b, c}) {
      corners.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(p);
    }
    two_sided.push_back(both);
  }
  Vec3 corner(std::uint32_t triangle, std::uint32_t i) const { return positions[corners[3 * triangle + i]]; }
  Vec3 normal(std::uint32_t t) const { return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)); }
  Vec3 at(std::uint32_t t, const Vec3& weights) const {
    return weights.x * corner(t, 0) + weights.y * corner(t, 1) + weights.z * corner(t, 2);
  }
};

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double unit() { return std::uniform_real_distribution<double>()(engine_); }
  Vec3 point() {
    const double x = unit();
    const double y = unit();
    return {x, y, unit()};
  }
  Vec3 direction() { return point() - 0.5; }

 private:
  std::mt19937 engine_;
};

Soup random_soup(int count, double size, std::uint32_t seed) {
  Random random(seed);
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const Vec3 a = random.point();
    const Vec3 b = a + size * random.direction();
    const Vec3 c = a + size * random.direction();
    soup.add(a, b, c, i % 3 == 0);
  }
  return soup;
}

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double squared = dot(b - a, b - a);
  const double along = squared > 0 ? std::clamp(dot(p - a, b - a) / squared, 0.0, 1.0) : 0;
  return length(p - (a + along * (b - a)));
}

// From the sides and, where the foot of the perpendicular is inside, the plane: not the way the library does it.
double distance_to(const Soup& soup, std::uint32_t t, const Vec3& p) {
  const Vec3 a = soup.corner(t, 0), b = soup.corner(t, 1), c = soup.corner(t, 2);
  double result = std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
  const Vec3 n = soup.normal(t);
  if (dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0) {
    result = std::min(result, std::abs(dot(p - a, n)) / length(n));
  }
  return result;
}

struct Nearest : testing::Test {
  test::TestHost host{1};

  ClosestPoint find(const Soup& soup, const Vec3& position, const Vec3& normal, double distance = k_far) {
    return ClosestPoints(soup.positions, soup.corners, soup.two_sided, &host.memory).find(position, normal, distance);
  }
};

TEST_F(Nearest, AgreesWithBruteForce) {
  std::size_t found_at_all = 0;
  std::size_t backs = 0;
  for (const double size : {0.02, 0.3, 2.0}) {
    const Soup soup = random_soup(300, size, 7);
    const ClosestPoints closest(soup.positions, soup.corners, soup.two_sided, &host.memory);
    Random random(11);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p = 1.5 * random.point() - 0.25;
      const Vec3 n = 7.0 * random.direction();
      const double max_distance = i % 4 == 0 ? k_far : 0.2 * random.unit();
      double least = k_far;
      for (std::uint32_t t = 0; t < soup.two_sided.size(); ++t) {
        if (dot(soup.normal(t), n) > 0 || soup.two_sided[t]) {
          least = std::min(least, distance_to(soup, t, p));
        }
      }
      const ClosestPoint found = closest.find(p, n, max_distance);
      if (least > max_distance) {
        EXPECT_EQ(found.triangle, ClosestPoint::k_nothing);
        continue;
      }
      ++found_at_all;
      backs += found.back;
      ASSERT_NE(found.triangle, ClosestPoint::k_nothing);
      EXPECT_LT(std::abs(found.distance - least), 1e-6);  // float rounding of the position, where normals decide
      EXPECT_LT(std::abs(length(soup.at(found.triangle, found.weights) - p) - found.distance), 1e-12);
      EXPECT_LT(std::abs(found.weights.x + found.weights.y + found.weights.z - 1), 1e-12);
      EXPECT_GE(std::min({found.weights.x, found.weights.y, found.weights.z}), 0);
      EXPECT_GT(dot(soup.normal(found.triangle), n) * (found.back ? -1 : 1), 0);
      EXPECT_TRUE(!found.back || soup.two_sided[found.triangle]);
    }
  }
  EXPECT_GT(found_at_all, 2000u);
  EXPECT_GT(backs, 200u);
}

TEST_F(Nearest, FindsTheSideThatFaces) {
  Soup soup;
  soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(find(soup, {0.2, 0.2, 1}, {0, 0, 1}).triangle, 0u);
  EXPECT_EQ(find(soup, {0.2, 0.2, -1}, {0, 0, 1}).triangle, 0u)
      << "from behind too: the normal says which side is meant";
  EXPECT_EQ(find(soup, {0.2, 0.2, 1}, {0, 0, -1}).triangle, ClosestPoint::k_nothing);
  EXPECT_EQ(find(soup, {0.2, 0.2, 1}, {1, 0, 0}).triangle, ClosestPoint::k_nothing) << "perpendicular";
  EXPECT_EQ(find(soup, {0.2, 0.2, 1}, {0, 0, 0}).triangle, ClosestPoint::k_nothing);
  soup.two_sided[0] = 1;
  const ClosestPoint back = find(soup, {0.2, 0.2, 1}, {0, 0, -1});
  EXPECT_EQ(back.triangle, 0u);
  EXPECT_TRUE(back.back);
}

TEST_F(Nearest, MaxDistanceCounts) {
  Soup soup;
  soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(find(soup, {0.2, 0.2, 0.5}, {0, 0, 1}, 0.5).triangle, 0u) << "inclusive";
  EXPECT_EQ(find(soup, {0.2, 0.2, 0.5}, {0, 0, 1}, 0.499).triangle, ClosestPoint::k_nothing);
  EXPECT_EQ(find(soup, {1, 0, 0}, {0, 0, 1}, 0).triangle, 0u);
}

// A point on a ridge, a float's rounding off: the face it was taken from is meant, however near the other is.
TEST_F(Nearest, OnARidgeTheNormalDecides) {
  Soup soup;
  soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, 1});
  soup.add({1, 0, 0}, {0, 0, 0}, {0, -1, 1});
  for (const double off : {-3e-8, 0.0, 3e-8}) {
    EXPECT_EQ(find(soup, {0.5, off, 0}, {0, -1, 1}).triangle, 0u) << off;
    EXPECT_EQ(find(soup, {0.5, off, 0}, {0, 1, 1}).triangle, 1u) << off;
  }
}

TEST_F(Nearest, NothingAndNoAreaAreNeverFound) {
  EXPECT_EQ(find(Soup(), {0, 0, 0}, {0, 0, 1}).triangle, ClosestPoint::k_nothing);
  Soup soup;
  soup.add({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, true);
  EXPECT_EQ(find(soup, {0, 0, 0}, {0, 0, 1}).triangle, ClosestPoint::k_nothing);
}

TEST_F(Nearest, ManyQueriesTakeLittleTime) {
  constexpr int k_side = 354;  // a rippled sheet of 250,000 triangles
  Soup soup;
  const auto at = [](int x, int y) {
    return Vec3(x / double{k_side}, y / double{k_side}, 0.05 * std::sin(0.2 * x) * std::cos(0.3 * y));
  };
  for (int x = 0; x < k_side; ++x) {
    for (int y = 0; y < k_side; ++y) {
      soup.add(at(x, y), at(x + 1, y), at(x + 1, y + 1));
      soup.add(at(x, y), at(x + 1, y + 1), at(x, y + 1));
    }
  }
  std::clock_t start = std::clock();
  const ClosestPoints closest(soup.positions, soup.corners, soup.two_sided, &host.memory);
  const double build_time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  start = std::clock();
  Random random(3);
  int found = 0;
  for (int i = 0; i < 10000; ++i) {
    Vec3 p = random.point();
    p.z = 0.2 * (p.z - 0.5);
    found += closest.find(p, {0, 0, 1}, k_far).triangle != ClosestPoint::k_nothing;
  }
  const double query_time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("250,000 triangles: built in %.3f s, 10,000 queries in %.3f s\n", build_time, query_time);
  EXPECT_EQ(found, 10000);
  EXPECT_LT(query_time, 10) << "not logarithmic";  // 0.1 s in a release build
}

}  // namespace
}  // namespace radvor
