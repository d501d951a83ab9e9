// How exact the light of a sample has to be: the smaller its area, the less.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

// Cards of a hundredth under slats, too many to be clipped, that hide parts of a lamp; a large floor in the open
// beside them. Slats and specks face away from all light; specks are samples of next to no area.
Scene cards_and_floor(int specks) {
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0)), lamp = builder.material(Color(0.0), Color(10.0));
  for (int i = 0; i < 20; ++i) {
    const double x = 0.05 * i;
    builder.quad({x, 0, 0}, {x + 0.03, 0, 0}, {x + 0.03, 0.3, 0}, {x, 0.3, 0}, black);
  }
  for (int i = 0; i < 160; ++i) {
    const double x = 0.1 + 0.0047 * i;
    builder.quad({x, -0.2, 0.5}, {x + 0.1, 0.4, 0.5}, {x + 0.102, 0.4, 0.5}, {x + 0.002, -0.2, 0.5}, black);
  }
  builder.quad({0.2, -0.2, 1}, {0.2, 0.4, 1}, {0.8, 0.4, 1}, {0.8, -0.2, 1}, lamp);
  builder.quad({5, 0, 0}, {15, 0, 0}, {15, 10, 0}, {5, 10, 0}, black);
  builder.quad({8, 3, 1}, {8, 7, 1}, {12, 7, 1}, {12, 3, 1}, lamp);
  for (int i = 0; i < specks; ++i) {
    const double x = 0.01 * i;
    builder.triangle({x, 5, -1}, {x, 5.001, -1}, {x + 0.001, 5, -1}, black);
  }
  return builder.take();
}

BakeStats baked(int specks) {
  BakeOptions options;
  options.tolerance = 5e-4;
  options.spacing.patch_spacing = 1;
  options.spacing.element_levels = 0;
  options.spacing.refines = false;
  options.disable = Disable::indirect;
  TestBake bake(cards_and_floor(specks), options);
  EXPECT_EQ(bake.run(), BakeStatus::converged);
  return bake->stats();
}

TEST(Leeway, SamplesUnderTheMeanAreaAreQuarteredLess) {
  const BakeStats large_mean = baked(0), small_mean = baked(4000);
  EXPECT_GT(2 * small_mean.rays, 3 * large_mean.rays);
}

}  // namespace
}  // namespace radvor
