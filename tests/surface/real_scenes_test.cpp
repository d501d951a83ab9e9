// The real scenes: all of them become surfaces; what is made of them, and in what time.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "scene/obj_scene.h"
#include "surface/made_surface.h"
#include "surface/spacing.h"

namespace radvor {
namespace {

class RealScene : public testing::TestWithParam<const char*> {};

TEST_P(RealScene, BecomesASurface) {
  test::TestHost host(2);
  const auto scene = test::real_scene(GetParam(), &host.memory);
  if (!scene) {
    GTEST_SKIP() << "no " << RADVOR_SHARED_DIR << "/scenes/" << GetParam();
  }
  const WeldedScene welded = weld(*scene, 0, host);
  const Facets facets = find_facets(*scene, welded, std::numbers::pi / 6, host);
  const SurfaceOptions options = choose_spacing(*scene, welded, facets, {});
  const std::uint64_t before = host.memory.live_bytes();
  const auto start = std::chrono::steady_clock::now();
  const Surface surface(*scene, welded, facets, options, host);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf(
      "%s: %zu triangles, %zu facets, spacing %.4g / 2^%u: %zu sites, %zu samples, %zu shares, %u patches, %u "
      "triangles, "
      "%.3f s, %.0f MB, peak %.0f MB\n",
      GetParam(), welded.triangles.size(), facets.facets.size(), options.patch_spacing, options.element_levels,
      surface.sites().size(), surface.samples().size(), surface.shares().size(), surface.patch_count(),
      surface.triangle_count(), seconds, 1e-6 * static_cast<double>(host.memory.live_bytes() - before),
      1e-6 * static_cast<double>(host.memory.peak_bytes()));
  EXPECT_GT(surface.patch_count(), 500u);
  EXPECT_LT(surface.patch_count(), 6000u);
  double area = 0;
  for (const Share& share : surface.shares()) {
    area += share.area;
  }
  double expected = 0;
  for (const Facet& facet : facets.facets) {
    expected += facet.area;
  }
  EXPECT_NEAR(area, expected, 1e-6 * expected);
}

INSTANTIATE_TEST_SUITE_P(All, RealScene,
                         testing::Values("cornell", "cornell-defective", "kenney-fps", "gazebo", "navtest", "dungeon",
                                         "lq-e3m4", "living-room", "staircase"));

}  // namespace
}  // namespace radvor
