// Points that keep their distance, against all pairs, as given sites were once tested: in time that grew with the
// square.
#include "surface/spaced_points.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random_numbers.h"

namespace radvor {
namespace {

TEST(SpacedPoints, AreThoseThatAllPairsLeave) {
  for (const float distance : {0.01f, 0.3f, 5.0f}) {
    test::RandomNumbers random(7);
    SpacedPoints spaced(distance, std::pmr::get_default_resource());
    std::vector<Vec2> kept;
    for (int k = 0; k < 2000; ++k) {
      const Vec2 point(random.vector_between(-1, 1));
      const bool clear = std::ranges::none_of(
          kept, [&](const Vec2& other) { return glm::distance(other, point) < static_cast<double>(distance); });
      ASSERT_EQ(spaced.add(point), clear) << k;
      if (clear) {
        kept.push_back(point);
      }
    }
  }
}

TEST(SpacedPoints, MayBeExactlyThatFarApart) {
  SpacedPoints spaced(0.25, std::pmr::get_default_resource());
  for (int k = -8; k <= 8; ++k) {
    EXPECT_TRUE(spaced.add({0.25 * k, 0}));
    EXPECT_FALSE(spaced.add({0.25 * k, 0.125}));
  }
}

}  // namespace
}  // namespace radvor
