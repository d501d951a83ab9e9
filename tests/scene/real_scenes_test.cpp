// The real scenes: what is found in them, and in what time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>

#include "scene/audit.h"
#include "scene/obj_scene.h"
#include "support/test_host.h"

namespace radvor {
namespace {

// What is known to be in them; how many triangles each file has is kept + degenerate + duplicate.
struct Expected {
  const char* name;
  std::size_t kept;
  std::uint32_t degenerate, duplicate, t_junctions;
  std::size_t facets, flat, open_edges;
};

class RealScene : public testing::TestWithParam<Expected> {};

TEST_P(RealScene, IsWeldedAndCutIntoFacets) {
  const Expected& expected = GetParam();
  test::TestHost host(1);
  const auto scene = test::real_scene(expected.name, &host.memory);
  if (!scene) {
    GTEST_SKIP() << "no " << RADVOR_SHARED_DIR << "/scenes/" << expected.name;
  }
  // Of this thread alone, which does all the work: other processes don't count.
  const auto seconds = [start = std::clock()] { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; };
  const WeldedScene welded = weld(*scene, 0, host);
  const double weld_time = seconds();
  const Facets facets = find_facets(*scene, welded, std::numbers::pi / 6, host);
  const double facet_time = seconds() - weld_time;
  const auto flat =
      static_cast<std::size_t>(std::ranges::count_if(facets.facets, [](const Facet& facet) { return facet.flat; }));
  std::printf("%s: welding %.3f s, facets %.3f s on one thread\n", expected.name, weld_time, facet_time);
  EXPECT_EQ(welded.triangles.size(), expected.kept);
  EXPECT_EQ(welded.degenerate_triangles, expected.degenerate);
  EXPECT_EQ(welded.duplicate_triangles, expected.duplicate);
  EXPECT_EQ(welded.t_junctions, expected.t_junctions);
  EXPECT_EQ(facets.facets.size(), expected.facets);
  EXPECT_EQ(flat, expected.flat);
  EXPECT_EQ(test::open_edges(welded), expected.open_edges);
  EXPECT_EQ(test::audit(welded), "");
  EXPECT_EQ(test::audit(welded, facets), "");
  EXPECT_LT(weld_time + facet_time, 30) << "not in proportion to the size";  // 0.8 s in a release build
}

INSTANTIATE_TEST_SUITE_P(All, RealScene,
                         testing::Values(Expected{"cornell", 36, 0, 0, 0, 19, 17, 16},
                                         Expected{"cornell-defective", 34, 0, 2, 0, 18, 16, 16},
                                         Expected{"kenney-fps", 2385, 7, 0, 24, 1492, 372, 136},
                                         Expected{"gazebo", 730, 0, 0, 2, 419, 419, 8},
                                         Expected{"navtest", 1611, 1, 0, 1, 1611, 0, 0},
                                         Expected{"dungeon", 10181, 0, 0, 1, 7222, 1146, 648},
                                         Expected{"lq-e3m4", 36767, 0, 15, 4731, 19419, 17780, 10},
                                         Expected{"living-room", 131803, 194, 0, 162, 117917, 4857, 5649},
                                         Expected{"staircase", 249175, 768, 0, 153, 240055, 12187, 6913}),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace radvor
