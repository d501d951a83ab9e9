// The bits that turn skips off, through the C ABI.
#include <gtest/gtest.h>
#include <radvor.h>

#include "api/room.h"

namespace radvor::test {
namespace {

// A floor under a lamp that faces down, and its mirror image: the lower lamp faces up, below the floor.
radvor_stats stats_without(std::uint32_t skip, std::vector<float>& light) {
  const Engine engine;
  const SceneOf scene(engine);
  FloorAndLamp room;
  EXPECT_EQ(scene.add(room.desc()), 0u);
  for (std::size_t i = 1; i < room.positions.size(); i += 3) {
    room.positions[i] -= 2;
  }
  EXPECT_EQ(scene.add(room.desc()), 1u);
  radvor_bake_options options = coarse();
  options.disable = RADVOR_DISABLE_REFINEMENT | skip;
  radvor_solution* solution = nullptr;
  EXPECT_EQ(radvor_bake(scene, &options, &solution), RADVOR_OK) << engine.error();
  radvor_stats stats{};
  stats.struct_size = sizeof stats;
  EXPECT_EQ(radvor_solution_stats(solution, &stats), RADVOR_OK) << engine.error();
  light.assign(room.positions.size(), -1.0f);
  EXPECT_EQ(radvor_solution_vertices(solution, 0, RADVOR_IRRADIANCE, RADVOR_VERTEX_SAMPLE, light.data(), 0,
                                     static_cast<std::uint32_t>(room.positions.size() / 3)),
            RADVOR_OK)
      << engine.error();
  radvor_solution_destroy(solution);
  return stats;
}

TEST(Skips, AreCountedAndTurnedOff) {
  std::vector<float> light, light_without;
  const radvor_stats on = stats_without(0, light);
  EXPECT_GT(on.skipped_facing, 0u);
  EXPECT_GT(on.skipped_negligible, 0u);

  const radvor_stats faces = stats_without(RADVOR_DISABLE_FACING, light_without);
  EXPECT_EQ(faces.skipped_facing, 0u);
  EXPECT_EQ(faces.skipped_negligible, on.skipped_negligible);
  EXPECT_GT(faces.rays, on.rays);
  EXPECT_EQ(light_without, light);

  const radvor_stats all = stats_without(RADVOR_DISABLE_NEGLIGIBLE, light_without);
  EXPECT_EQ(all.skipped_negligible, 0u);
  EXPECT_GE(all.rays, on.rays);
  ASSERT_EQ(light_without.size(), light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    EXPECT_NEAR(light_without[i], light[i], 0.1 * 0.2 * light[i]);  // a tenth of the tolerance
  }
}

}  // namespace
}  // namespace radvor::test
