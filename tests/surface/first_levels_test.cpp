// What the mesh resolves before there is light: borders.
#include "surface/first_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor {
namespace {

using test::heap;
using test::MadeSurface;
using test::SceneBuilder;

SurfaceOptions graded(double spacing, std::uint32_t border_levels) {
  SurfaceOptions options{Lattice::hexagonal, spacing, 0, spacing / 32};
  options.border_levels = border_levels;
  return options;
}

bool on_the_edge(const Vec3& p, double size) {
  int at_ends = 0;
  for (int k = 0; k < 3; ++k) {
    at_ends += std::abs(p[k]) < 1e-9 || std::abs(p[k] - size) < 1e-9;
  }
  return at_ends >= 2;
}

TEST(FirstLevels, TheBordersOfARoomAreSampledTwoLevelsFinerAndItsMiddleAsItWas) {
  SceneBuilder builder(heap());
  builder.box({0, 0, 0}, {4, 4, 4}, true);
  const SurfaceOptions options = graded(0.5, 2);
  MadeSurface made(builder.take(), options);
  raise_first_levels(made.surface, options, 0, heap());
  test::audit(made);
  test::audit_cells(made);
  std::size_t on_one_edge = 0;
  for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
    const Vec3& at = made.surface.sites()[site].position;
    if (on_the_edge(at, 4)) {
      EXPECT_EQ(made.surface.level_of(site), 2u);
      on_one_edge += at.x > 0 && at.x < 4 && at.y == 0 && at.z == 0;
    }
    const Vec3 from_middle = glm::abs(at - Vec3(2.0));
    const double second = from_middle.x + from_middle.y + from_middle.z -
                          std::max({from_middle.x, from_middle.y, from_middle.z}) -
                          std::min({from_middle.x, from_middle.y, from_middle.z});
    if (second < 0.6) {  // 1.4 and more from the borders of its wall
      EXPECT_EQ(made.surface.sites()[site].level, 0u);
    }
  }
  EXPECT_EQ(on_one_edge, 31u);  // 4 / 0.125 less the ends
}

TEST(FirstLevels, WhereASurfaceEndsAndNothingAdjoinsNoSiteIsAdded) {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  const SurfaceOptions options = graded(0.5, 2);
  MadeSurface made(builder.take(), options);
  const std::size_t before = made.surface.sites().size();
  raise_first_levels(made.surface, options, 0, heap());
  EXPECT_EQ(made.surface.sites().size(), before);
}

TEST(FirstLevels, WhereAWallStandsTheFloorIsSampledFinerToo) {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  builder.begin_mesh().receives = false;
  builder.quad({1, 2, -1}, {3, 2, -1}, {3, 2, 1}, {1, 2, 1});
  const SurfaceOptions options = graded(0.5, 2);
  MadeSurface made(builder.take(), options);
  raise_first_levels(made.surface, options, 0, heap());
  test::audit(made);
  std::size_t along = 0;
  for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
    const Vec3& at = made.surface.sites()[site].position;
    if (at.y == 2 && at.x >= 1 && at.x <= 3) {
      EXPECT_EQ(made.surface.level_of(site), 2u) << at.x;
      ++along;
    }
    if (at.y == 0 || at.x == 0) {
      EXPECT_EQ(made.surface.level_of(site), 0u);  // nothing adjoins, and what stands there gets no light
    }
  }
  EXPECT_EQ(along, 17u);  // 2 / 0.125 and one
}

TEST(FirstLevels, AFacetSmallerThanACellGetsNone) {
  for (const double size : {0.2, 0.3}) {  // cells of levels 1 and 2: 0.25 and 0.125
    SceneBuilder builder(heap());
    builder.box({0, 0, 0}, {size, size, size}, false);
    const SurfaceOptions options = graded(0.5, 1);
    MadeSurface made(builder.take(), options);
    raise_first_levels(made.surface, options, 0, heap());
    for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
      EXPECT_EQ(made.surface.level_of(site), size < 0.25 ? 0u : 1u) << size;
    }
  }
}

TEST(FirstLevels, StaysWithinTheLimit) {
  SceneBuilder builder(heap());
  builder.box({0, 0, 0}, {4, 4, 4}, true);
  const SurfaceOptions options = graded(0.5, 2);
  MadeSurface made(builder.take(), options);
  const std::size_t before = made.surface.sites().size();
  raise_first_levels(made.surface, options, static_cast<std::uint32_t>(before + 100), heap());
  EXPECT_LE(made.surface.sites().size(), before + 50);  // half is left to the light
  EXPECT_GT(made.surface.sites().size(), before + 25);
  test::audit(made);
}

}  // namespace
}  // namespace radvor
