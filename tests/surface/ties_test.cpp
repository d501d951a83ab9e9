// Ties follow the light: diagonals run along a shadow's edge, and nothing else moves.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/error.h"
#include "surface/made_surface.h"
#include "surface/solids.h"
#include "surface/triangle_cells.h"

namespace radvor {
namespace {

using test::MadeSurface;
using test::SceneBuilder;
using test::unit_floor;

Vec3 corner(const MadeSurface& made, std::uint32_t share) {
  return test::site_of(made.surface, share).position;
}

template <class Light>
std::vector<double> values(const MadeSurface& made, Light&& light) {
  std::vector<double> found;
  for (const Sample& sample : made.surface.samples()) {
    found.push_back(light(made.surface.sites()[sample.site].position));
  }
  return found;
}

template <class Light>
std::size_t crossing_edges(const MadeSurface& made, Light&& light) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> crossing;
  for (const ShareTriangle& triangle : made.surface.triangles(0)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k];
      const std::uint32_t b = triangle[(k + 1) % 3];
      if (light(corner(made, a)) != light(corner(made, b))) {
        crossing.insert({std::min(a, b), std::max(a, b)});
      }
    }
  }
  return crossing.size();
}

double area(const MadeSurface& made) {
  double sum = 0;
  for (const ShareTriangle& triangle : made.surface.triangles(0)) {
    const double doubled =
        doubled_area(Vec2(corner(made, triangle[0])), Vec2(corner(made, triangle[1])), Vec2(corner(made, triangle[2])));
    EXPECT_GT(doubled, 0);
    sum += 0.5 * doubled;
  }
  return sum;
}

// On a lattice of squares a shadow's edge at 45 degrees passes between sites: with the diagonals along it, it crosses
// 16 sides of the 8 x 8 squares; else a diagonal in each square too.
TEST(Ties, DiagonalsRunAlongAShadowsEdgeOnSquares) {
  for (const bool rising : {true, false}) {
    MadeSurface made(unit_floor(), {Lattice::quadrilateral, 0.125, 0, 0.125});
    const auto light = [&](const Vec3& p) { return (rising ? p.x - p.y : p.x + p.y - 1) > 0.0625 ? 1.0 : 0.0; };
    const std::size_t before = crossing_edges(made, light);
    const Ties ties = made.surface.align_ties(values(made, light), 1e-9);
    EXPECT_EQ(ties.count, 64u);
    const std::size_t after = crossing_edges(made, light);
    EXPECT_EQ(after, 16u);
    EXPECT_EQ(before, after + ties.realigned);
    EXPECT_NEAR(area(made), 1, 1e-12);
    test::audit(made);
    test::audit_cells(made);
    EXPECT_EQ(made.surface.align_ties(values(made, light), 1e-9).realigned, ties.realigned);
    EXPECT_EQ(crossing_edges(made, light), after);
    // Even light: as it was.
    EXPECT_EQ(made.surface.align_ties(values(made, [](const Vec3&) { return 1.0; }), 1e-9).realigned, 0u);
    EXPECT_EQ(crossing_edges(made, light), before);
  }
}

TEST(Ties, OneOfTheTwoDirectionsIsThereWithoutLight) {
  std::size_t realigned = 0;
  for (const bool rising : {true, false}) {
    MadeSurface made(unit_floor(), {Lattice::quadrilateral, 0.125, 0, 0.125});
    const auto light = [&](const Vec3& p) { return (rising ? p.x - p.y : p.x + p.y - 1) > 0.0625 ? 1.0 : 0.0; };
    realigned += made.surface.align_ties(values(made, light), 1e-9).realigned;
  }
  EXPECT_EQ(realigned, 15u);
}

// Where levels meet on the hexagonal lattice there are trapezoids. In two of three directions rounding hides that they
// are ties.
TEST(Ties, AreSeenOnTheHexagonalLatticeWhereLevelsMeet) {
  MadeSurface made(unit_floor(), {Lattice::hexagonal, 0.125, 0, 0.125 / 4});
  const std::vector<double> even(made.surface.samples().size(), 1.0);
  const std::uint32_t before = made.surface.align_ties(even, 0).count;
  std::uint32_t middle = 0;
  for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
    const Vec3 centre(0.5, 0.5, 0);
    middle = glm::distance(made.surface.sites()[site].position, centre) <
                     glm::distance(made.surface.sites()[middle].position, centre)
                 ? site
                 : middle;
  }
  made.surface.refine(std::vector<std::uint32_t>{middle});
  // Six new sites about the middle: the rim's twelve triangles make six trapezoids of two or three triangles each.
  const std::vector<double> more(made.surface.samples().size(), 1.0);
  EXPECT_EQ(made.surface.align_ties(more, 0).count, before + 6);
  test::audit(made);
}

TEST(Ties, OnRefinedSurfacesPointsAreFoundInTheTrianglesThatThereAre) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Lattice lattice : {Lattice::hexagonal, Lattice::quadrilateral}) {
    MadeSurface made(unit_floor(), {lattice, 0.2, 0, 0.2 / 16});
    for (int round = 0; round < 6; ++round) {
      const auto count = static_cast<std::uint32_t>(made.surface.sites().size());
      made.surface.refine(std::vector<std::uint32_t>{static_cast<std::uint32_t>(random()) % count,
                                                     count - 1 - static_cast<std::uint32_t>(random()) % (count / 4)});
      const auto light = [](const Vec3& p) { return std::sin(9 * p.x) * std::cos(7 * p.y) > 0.3 ? 5.0 : p.x; };
      const Ties ties = made.surface.align_ties(values(made, light), 1e-6);
      EXPECT_GT(ties.count, 0u);
      EXPECT_NEAR(area(made), 1, 1e-12);
      test::audit(made);
      for (int k = 0; k < 200; ++k) {
        const Vec3 p(uniform(random), uniform(random), 0);
        const FacetPoint found = made.surface.locate(0, made.facets.facets[0].frame.to_plane(p));
        Vec3 back(0.0);
        for (std::size_t c = 0; c < 3; ++c) {
          back += found.weights[c] * corner(made, found.shares[c]);
        }
        EXPECT_LT(glm::distance(back, p), 1e-9);  // weights would be cut off in another triangle
      }
    }
  }
}

TEST(Ties, ValuesAreOnePerSample) {
  MadeSurface made(unit_floor(), {Lattice::quadrilateral, 0.5, 0, 0.5});
  EXPECT_THROW(made.surface.align_ties(std::vector<double>(1, 1.0), 0), Error);
}

TEST(Ties, NothingBreaksWhateverCountsAsOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double tolerance : {1e-3, 0.1, 1.0}) {
    MadeSurface made(unit_floor(), {Lattice::hexagonal, 0.1, 0, 0.1 / 8});
    for (int round = 0; round < 5; ++round) {
      const auto count = static_cast<std::uint32_t>(made.surface.sites().size());
      made.surface.refine(std::vector<std::uint32_t>{count - 1, static_cast<std::uint32_t>(random()) % count});
    }
    std::vector<double> noise(made.surface.samples().size());
    for (double& value : noise) {
      value = uniform(random);
    }
    made.surface.align_ties(noise, tolerance);
    EXPECT_NEAR(area(made), 1, 1e-12);
    test::audit(made);
  }
}

}  // namespace
}  // namespace radvor
