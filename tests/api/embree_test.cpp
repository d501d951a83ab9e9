// Whole bakes with another Embree than the system's.
#include <gtest/gtest.h>
#include <radvor.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "api/engine.h"
#include "api/shadowed_floor.h"

namespace radvor::test {
namespace {

// A stand-in with the signatures of Embree 4 that answers by brute force and aborts a caller who takes it for an
// Embree 3, which is what Debian has.
TEST(Embree4, GivesTheSameLightAsTheSystems) {
  Lends stand_in;
  stand_in.embree_path = RADVOR_STAND_IN_EMBREE;
  const LightOf expected = bake_shadowed_floor(Engine());
  const LightOf light = bake_shadowed_floor(Engine(stand_in));
  ASSERT_EQ(light.vertices.size(), expected.vertices.size());
  for (std::size_t quantity = 0; quantity < light.vertices.size(); ++quantity) {
    const std::vector<float>& all = expected.vertices[quantity];
    const float brightest = *std::ranges::max_element(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_NEAR(light.vertices[quantity][i], all[i], 1e-3f * brightest) << "quantity " << quantity << ", float " << i;
    }
  }
}

}  // namespace
}  // namespace radvor::test
