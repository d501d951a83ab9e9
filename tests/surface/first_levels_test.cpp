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
  options.raises_first = true;
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
  MadeSurface made(builder.take(), graded(0.5, 2));
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
  MadeSurface made(builder.take(), graded(0.5, 2));
  for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
    EXPECT_EQ(made.surface.level_of(site), 0u);
  }
}

TEST(FirstLevels, WhereAWallStandsTheFloorIsSampledFinerToo) {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  builder.begin_mesh().receives = false;
  builder.quad({1, 2, -1}, {3, 2, -1}, {3, 2, 1}, {1, 2, 1});
  MadeSurface made(builder.take(), graded(0.5, 2));
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
    MadeSurface made(builder.take(), graded(0.5, 1));
    for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
      EXPECT_EQ(made.surface.level_of(site), size < 0.25 ? 0u : 1u) << size;
    }
  }
}

// What rises before there are shares gives the surface that it gives afterwards.
TEST(FirstLevels, AreWhatARefinementMakesOfThem) {
  const auto scene = [] {
    SceneBuilder builder(heap());
    builder.box({0, 0, 0}, {4, 4, 4}, true);
    builder.mesh().sites.assign({glm::vec3(0.7f, 3.2f, 0), glm::vec3(0.9f, 3.3f, 0)});
    test::cylinder(builder, 12, 0.4, 2, true);
    builder.begin_mesh();
    const std::uint32_t both = builder.add_material({Color(0.5), Color(0.0), true});
    builder.quad({3, 0, 0}, {3, 4, 0}, {3, 4, 1}, {3, 0, 1}, both);
    builder.triangle({3.2, 3.2, 2}, {3.4, 3.2, 2}, {3.3, 3.4, 2.1}, both);
    builder.box({1.1, 1.3, 2.5}, {2.3, 2.9, 3.98}, false);
    return builder.take();
  };
  SurfaceOptions options = graded(0.5, 2);
  const MadeSurface at_once(scene(), options);
  options.raises_first = false;
  MadeSurface later(scene(), options);
  raise_first_levels(later.surface, options, heap());
  later.surface.refine({});
  test::audit(at_once);
  const auto& a = at_once.surface;
  const auto& b = later.surface;
  const MadeSurface plain(scene(), options);
  ASSERT_GT(a.sites().size(), plain.surface.sites().size() + 200);
  ASSERT_EQ(a.sites().size(), b.sites().size());
  ASSERT_EQ(a.samples().size(), b.samples().size());
  ASSERT_EQ(a.shares().size(), b.shares().size());
  for (std::uint32_t k = 0; k < a.sites().size(); ++k) {
    EXPECT_EQ(a.sites()[k].position, b.sites()[k].position);
    EXPECT_EQ(a.sites()[k].parents, b.sites()[k].parents);
    EXPECT_EQ(a.level_of(k), b.level_of(k));
  }
  for (std::uint32_t k = 0; k < a.shares().size(); ++k) {
    EXPECT_EQ(a.shares()[k].centroid, b.shares()[k].centroid);
    EXPECT_EQ(a.shares()[k].area, b.shares()[k].area);
    EXPECT_EQ(a.shares()[k].sample, b.shares()[k].sample);
    EXPECT_EQ(a.shares()[k].facet, b.shares()[k].facet);
    EXPECT_EQ(a.shares()[k].other_side, b.shares()[k].other_side);
    EXPECT_EQ(a.shares()[k].back, b.shares()[k].back);
  }
  for (std::uint32_t facet = 0; facet < at_once.facets.facets.size(); ++facet) {
    EXPECT_TRUE(std::ranges::equal(a.triangles(facet), b.triangles(facet)));
  }
  for (std::uint32_t k = 0; k < a.samples().size(); ++k) {
    EXPECT_EQ(a.samples()[k].point, b.samples()[k].point);
    EXPECT_EQ(a.samples()[k].area, b.samples()[k].area);
    EXPECT_EQ(a.samples()[k].normal, b.samples()[k].normal);
    EXPECT_EQ(a.samples()[k].site, b.samples()[k].site);
  }
}

TEST(FirstLevels, StaysWithinTheLimit) {
  const auto room = [](const SurfaceOptions& options) {
    SceneBuilder builder(heap());
    builder.box({0, 0, 0}, {4, 4, 4}, true);
    return MadeSurface(builder.take(), options);
  };
  SurfaceOptions options = graded(0.5, 2);
  options.raises_first = false;
  const std::size_t before = room(options).surface.sites().size();
  options.raises_first = true;
  options.max_sites = static_cast<std::uint32_t>(before + 100);
  const MadeSurface made = room(options);
  EXPECT_LE(made.surface.sites().size(), before + 50);  // half is left to the light
  EXPECT_GT(made.surface.sites().size(), before + 25);
  test::audit(made);
}

}  // namespace
}  // namespace radvor
