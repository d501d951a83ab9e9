// Where samples look around from: what light from all around does within less than a cell must not become the cell's.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

constexpr double k_pi = 3.14159265358979323846;

// A floor of 2 by 8 beside a wall of little height, under a sky of radiance one. At a distance x from the wall the
// floor sees it under an angle whose tangent is height / x, and has pi (1 + x / hypot(x, height)) / 2.
double mean_beside_a_wall(double height) {
  return k_pi * 0.5 * (1 + (std::hypot(2, height) - height) / 2);
}

TEST(Lookout, ACornerThatIsDarkInLessThanItsCellDoesNotDarkenTheCell) {
  for (const double height : {0.02, 0.05, 0.1}) {
    SceneBuilder builder;
    const std::uint32_t black = builder.material(Color(0.0));
    builder.quad({0, -4, 0}, {2, -4, 0}, {2, 4, 0}, {0, 4, 0}, black);
    builder.quad({0, -4, 0}, {0, 4, 0}, {0, 4, height}, {0, -4, height}, black);
    builder.under_sky(Color(1.0));
    BakeOptions options;
    options.tolerance = options.spacing.tolerance = 0.02;
    options.spacing.patch_spacing = 2;
    options.spacing.element_levels = 0;
    options.spacing.refines = false;
    TestBake bake(builder.take(), options);
    ASSERT_EQ(bake.run(), BakeStatus::converged);
    const Surface& surface = (*bake).surface();
    double received = 0, area = 0;
    for (const ShareTriangle& triangle : surface.triangles(0)) {
      std::array<Vec3, 3> corners;
      double light = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t sample = surface.shares()[triangle[k]].sample;
        corners[k] = surface.sites()[surface.samples()[sample].site].position;
        light += bake.irradiance(sample).g / 3;
      }
      const double size = 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
      received += size * light;
      area += size;
    }
    ASSERT_NEAR(area, 16, 1e-9);
    EXPECT_NEAR(received / area, mean_beside_a_wall(height), 0.02 * k_pi) << height;
  }
}

TEST(Lookout, NothingIsLookedFromInsideOfWhatStandsInTheWay) {
  // The block crosses the floor's middle, near its border, and contacts are not asked for.
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0));
  builder.quad({0, -4, 0}, {2, -4, 0}, {2, 4, 0}, {0, 4, 0}, black);
  builder.quad({0, -4, 0}, {0, 4, 0}, {0, 4, 0.02}, {0, -4, 0.02}, black);
  builder.box({0.05, -5, -0.5}, {1.9, 5, 0.5}, false, black);
  builder.under_sky(Color(1.0));
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = 0.02;
  options.spacing.patch_spacing = 4;
  options.spacing.refines = false;
  options.disable = Disable::intersections;
  TestBake bake(builder.take(), options);
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  const Surface& surface = (*bake).surface();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < surface.samples().size(); ++i) {
    const Sample& sample = surface.samples()[i];
    const Vec3& at = surface.sites()[sample.site].position;
    if (at.x == 0 && at.z == 0 && std::abs(at.y) < 3.5 && sample.normal.z > 0.5) {
      EXPECT_GT(bake.irradiance(i).g, 0.2 * k_pi) << at.y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1u);
}

}  // namespace
}  // namespace radvor
