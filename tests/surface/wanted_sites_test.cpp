// Sites off the lattice that refinement is asked for: on shadows' edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/error.h"
#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor {
namespace {

using test::MadeSurface;
using test::SceneBuilder;
using test::unit_floor;

double distance_to_nearest(const Surface& surface, const Vec3& point, std::size_t bound) {
  double least = 1e30;
  for (std::size_t k = 0; k < bound; ++k) {
    least = std::min(least, glm::distance(surface.sites()[k].position, point));
  }
  return least;
}

// A shadow's edge along a line: raised as refinement would, then a site where the line crosses each triangle's edge.
TEST(WantedSites, LieWhereTheyAreWanted) {
  for (const Lattice lattice : {Lattice::hexagonal, Lattice::quadrilateral}) {
    MadeSurface made(unit_floor(), {lattice, 0.125, 0, 0.125 / 8});
    const auto side = [](const Vec3& p) { return 0.61 * p.x - p.y + 0.137; };
    for (std::uint32_t level = 0; level < 3; ++level) {
      std::vector<std::uint32_t> sites;
      for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
        if (made.surface.level_of(site) == level &&
            std::abs(side(made.surface.sites()[site].position)) < std::ldexp(0.125, -static_cast<int>(level))) {
          sites.push_back(site);
        }
      }
      made.surface.refine(sites);
    }
    std::vector<WantedSite> wanted;
    for (const ShareTriangle& triangle : made.surface.triangles(0)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& a = test::site_of(made.surface, triangle[k]).position;
        const Vec3& b = test::site_of(made.surface, triangle[(k + 1) % 3]).position;
        if (side(a) < 0 && side(b) > 0) {
          wanted.push_back({0, a + side(a) / (side(a) - side(b)) * (b - a)});
        }
      }
    }
    ASSERT_GT(wanted.size(), 60u);
    const std::size_t before = made.surface.sites().size();
    const std::size_t samples = made.surface.samples().size();
    const auto origins = made.surface.refine({}, 0, wanted);
    const double apart = 0.25 * 0.125 / 8;
    std::size_t made_sites = 0;
    for (std::size_t k = before; k < made.surface.sites().size(); ++k) {
      const Site& site = made.surface.sites()[k];
      if (std::abs(side(site.position)) < 1e-9) {
        ++made_sites;
        EXPECT_GE(distance_to_nearest(made.surface, site.position, k), 0.99 * apart);
      }
    }
    EXPECT_GT(made_sites, wanted.size() / 5);
    for (const WantedSite& wish : wanted) {  // there, or something else is near
      EXPECT_LT(distance_to_nearest(made.surface, wish.position, made.surface.sites().size()), 1.01 * apart);
    }
    EXPECT_EQ(std::count_if(origins.begin(), origins.end(), [](const SampleOrigin& o) { return o.kept; }),
              static_cast<std::ptrdiff_t>(samples));
    test::audit(made);
    test::audit_cells(made);
    test::expect_balanced(made);

    // They stay where they are as refinement goes on about them.
    std::mt19937 random(2);
    const std::vector<Site> sites(made.surface.sites().begin(), made.surface.sites().end());
    for (int round = 0; round < 3; ++round) {
      std::vector<std::uint32_t> more;
      for (int k = 0; k < 20; ++k) {
        more.push_back(static_cast<std::uint32_t>(random() % made.surface.sites().size()));
      }
      made.surface.refine(more);
      test::audit(made);
      test::audit_cells(made);
      test::expect_balanced(made);
    }
    for (std::size_t k = 0; k < sites.size(); ++k) {
      EXPECT_EQ(made.surface.sites()[k].position, sites[k].position);
    }
  }
}

TEST(WantedSites, AreLeftOutWhereTheyWouldBeTooNear) {
  MadeSurface made(unit_floor(), {Lattice::quadrilateral, 0.25, 0, 0.125});
  const std::size_t before = made.surface.sites().size();
  const Vec3 inside(0.37, 0.41, 0);
  const std::vector<WantedSite> wanted = {{0, {0.5, 0, 0}},                    // on the border
                                          {0, {0.4, 0.01, 0}},                 // beside it
                                          {0, {0.5, 0.5, 0}},                  // a site already
                                          {0, {0.51, 0.5, 0}},                 // beside one
                                          {0, {2, 2, 0}},                      // nowhere
                                          {0, inside},                         // free
                                          {0, inside},                         // again
                                          {0, inside + Vec3(0.01, 0.01, 0)}};  // beside it
  made.surface.refine({}, 0, wanted);
  ASSERT_EQ(made.surface.sites().size(), before + 1);
  EXPECT_LT(glm::distance(made.surface.sites()[before].position, inside), 1e-9);
  test::audit(made);
  made.surface.refine({}, 0, wanted);
  EXPECT_EQ(made.surface.sites().size(), before + 1);
  made.surface.refine({}, static_cast<std::uint32_t>(before) + 1, std::vector<WantedSite>{{0, {0.6, 0.65, 0}}});
  EXPECT_EQ(made.surface.sites().size(), before + 1);
  EXPECT_THROW(made.surface.refine({}, 0, std::vector<WantedSite>{{7, inside}}), Error);
}

TEST(WantedSites, AnywhereKeepBodiesClosedAndCellsTrue) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double spacing : {0.4, 3.0}) {
    SceneBuilder builder(std::pmr::get_default_resource());
    test::cylinder(builder, 24, 1.0, 2.0, true);
    MadeSurface made(builder.take(), {Lattice::hexagonal, spacing, 0, spacing / 16});
    for (int round = 0; round < 5; ++round) {
      std::vector<WantedSite> wanted;
      for (int k = 0; k < 40; ++k) {
        const std::uint32_t triangle = static_cast<std::uint32_t>(random() % made.welded.triangles.size());
        const auto& corners = made.welded.triangles[triangle].vertices;
        const double u = uniform(random);
        const double v = uniform(random) * (1 - u);
        wanted.push_back({made.facets.facet_of_triangle[triangle], (1 - u - v) * made.welded.positions[corners[0]] +
                                                                       u * made.welded.positions[corners[1]] +
                                                                       v * made.welded.positions[corners[2]]});
      }
      std::vector<std::uint32_t> sites;
      for (int k = 0; k < 6; ++k) {
        sites.push_back(static_cast<std::uint32_t>(random() % made.surface.sites().size()));
      }
      made.surface.refine(sites, 0, wanted);
      test::audit(made);
      test::audit_cells(made);
      EXPECT_EQ(test::unmatched_edges(made), 0u);
    }
    EXPECT_GT(made.surface.sites().size(), 100u);
  }
}

}  // namespace
}  // namespace radvor
