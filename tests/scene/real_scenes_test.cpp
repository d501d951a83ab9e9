// The real scenes: what is found in them, and in what time.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <numbers>

#include "scene/audit.h"
#include "scene/obj_scene.h"
#include "support/test_host.h"

namespace radvor {
namespace {

class RealScene : public testing::TestWithParam<const char*> {};

TEST_P(RealScene, IsWeldedAndCutIntoFacets) {
  test::TestHost host(1);
  const auto scene = test::real_scene(GetParam(), &host.memory);
  if (!scene) {
    GTEST_SKIP() << "no " << RADVOR_SHARED_DIR << "/scenes/" << GetParam();
  }
  const auto seconds = [start = std::chrono::steady_clock::now()] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const WeldedScene welded = weld(*scene, 0, host);
  const double weld_time = seconds();
  const Facets facets = find_facets(*scene, welded, std::numbers::pi / 6, host);
  const double facet_time = seconds() - weld_time;
  std::size_t kinds[4] = {};
  for (const EdgeKind kind : facets.edge_kinds) {
    ++kinds[static_cast<std::size_t>(kind)];
  }
  std::size_t flat = 0;
  for (const Facet& facet : facets.facets) {
    flat += facet.flat;
  }
  std::printf(
      "%s: %zu triangles kept, %u degenerate, %u duplicate, %u T-junctions; %zu facets (%zu flat); edges: %zu "
      "interior, "
      "%zu seam, %zu smooth, %zu sharp, %zu open; welding %.3f s, facets %.3f s\n",
      GetParam(), welded.triangles.size(), welded.degenerate_triangles, welded.duplicate_triangles, welded.t_junctions,
      facets.facets.size(), flat, kinds[0], kinds[1], kinds[2], kinds[3], test::open_edges(welded), weld_time,
      facet_time);
  EXPECT_EQ(test::audit(welded), "");
  EXPECT_EQ(test::audit(welded, facets), "");
}

INSTANTIATE_TEST_SUITE_P(All, RealScene,
                         testing::Values("cornell", "cornell-defective", "kenney-fps", "gazebo", "navtest", "dungeon",
                                         "lq-e3m4", "living-room", "staircase"));

}  // namespace
}  // namespace radvor
