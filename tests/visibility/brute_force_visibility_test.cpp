// The oracle itself, on cases whose answer is seen at a glance.
#include "visibility/brute_force_visibility.h"

#include <gtest/gtest.h>

#include "visibility/triangle_soup.h"

namespace radvor {
namespace {

BruteForceVisibility brute_force(const TriangleSoup& soup) {
  return {soup.occluders(), std::pmr::get_default_resource()};
}

bool is_blocked(const Visibility& visibility, const Vec3& from, const Vec3& to) {
  std::uint8_t blocked = 7;
  visibility.blocked_from(from, {&to, 1}, &blocked);
  std::uint8_t again = 7;
  const Sightline segment{from, to};
  visibility.blocked({&segment, 1}, &again);
  EXPECT_EQ(blocked, again);
  return blocked != 0;
}

// (0,0,0), (1,0,0), (0,1,0): counter-clockwise from above.
TriangleSoup one_triangle() {
  TriangleSoup soup;
  soup.add(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  return soup;
}

TEST(BruteForce, BlocksFromBothSides) {
  const auto visibility = brute_force(one_triangle());
  EXPECT_TRUE(is_blocked(visibility, Vec3(0.2, 0.2, 1), Vec3(0.3, 0.3, -1)));
  EXPECT_TRUE(is_blocked(visibility, Vec3(0.3, 0.3, -1), Vec3(0.2, 0.2, 1)));
}

TEST(BruteForce, DoesNotBlockBesideBeforeOrBehind) {
  const auto visibility = brute_force(one_triangle());
  EXPECT_FALSE(is_blocked(visibility, Vec3(0.6, 0.6, 1), Vec3(0.6, 0.6, -1)));
  EXPECT_FALSE(is_blocked(visibility, Vec3(0.2, 0.2, 2), Vec3(0.2, 0.2, 1)));
  EXPECT_FALSE(is_blocked(visibility, Vec3(0.2, 0.2, -1), Vec3(0.2, 0.2, -2)));
}

TEST(BruteForce, SegmentsAreOpen) {
  const auto visibility = brute_force(one_triangle());
  EXPECT_FALSE(is_blocked(visibility, Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 1)));
  EXPECT_FALSE(is_blocked(visibility, Vec3(0.2, 0.2, -1), Vec3(0.2, 0.2, 0)));
  EXPECT_FALSE(is_blocked(visibility, Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 0)));
  EXPECT_FALSE(is_blocked(visibility, Vec3(-1, 0.2, 0), Vec3(2, 0.2, 0)));
}

TEST(BruteForce, NothingSlipsThroughEdgesAndCorners) {
  const TriangleSoup ball = sphere(12, 17);
  const auto visibility = brute_force(ball);
  const Vec3 inside(0.1, -0.2, 0.05);
  for (std::size_t i = 0; i < ball.corners.size() / 3; ++i) {
    const auto [a, b, c] = ball.triangle(i);
    for (const Vec3& target : {a, 0.5 * (a + b), 0.3 * b + 0.7 * c}) {
      EXPECT_TRUE(is_blocked(visibility, inside, inside + 2.0 * (target - inside)));
    }
  }
}

TEST(BruteForce, TrianglesWithoutAreaBlockNothing) {
  TriangleSoup soup;
  soup.add(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0));
  soup.add(Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 1, 0));
  const auto visibility = brute_force(soup);
  EXPECT_FALSE(is_blocked(visibility, Vec3(0.5, 0, 1), Vec3(0.5, 0, -1)));
  EXPECT_EQ(visibility.first_hit(Vec3(0.5, 0, 1), Vec3(0, 0, -1)).triangle, FirstHit::k_miss);
}

TEST(BruteForce, FirstHitIsTheNearestWithItsSide) {
  TriangleSoup soup = one_triangle();
  soup.add(Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 0, 1));  // clockwise from above
  const auto visibility = brute_force(soup);
  const FirstHit down = visibility.first_hit(Vec3(0.2, 0.2, 3), Vec3(0, 0, -4));
  EXPECT_EQ(down.triangle, 1u);
  EXPECT_FALSE(down.front);
  EXPECT_DOUBLE_EQ(down.distance, 0.5);
  const FirstHit between = visibility.first_hit(Vec3(0.2, 0.2, 0.5), Vec3(0, 0, -1));
  EXPECT_EQ(between.triangle, 0u);
  EXPECT_TRUE(between.front);
  EXPECT_EQ(visibility.first_hit(Vec3(0.2, 0.2, 3), Vec3(0, 0, 1)).triangle, FirstHit::k_miss);
}

TEST(BruteForce, NothingBlocksInAnEmptyScene) {
  const auto visibility = brute_force({});
  EXPECT_FALSE(is_blocked(visibility, Vec3(0), Vec3(1)));
  EXPECT_EQ(visibility.first_hit(Vec3(0), Vec3(1)).triangle, FirstHit::k_miss);
}

}  // namespace
}  // namespace radvor
