// Points are found in the triangles that they lie in, wherever a facet is dense, concave or has holes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor {
namespace {

using test::MadeSurface;
using test::SceneBuilder;

Vec3 position_of(const MadeSurface& made, const FacetPoint& found) {
  Vec3 position(0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_GE(found.weights[c], 0);
    position += found.weights[c] * test::site_of(made.surface, found.shares[c]).position;
  }
  return position;
}

// All at once is one after the other, but for the rounding of floats at the size of a facet.
void expect_same_together(const MadeSurface& made, const std::vector<PlanePoint>& asked,
                          const std::vector<FacetPoint>& told, double size) {
  std::vector<FacetPoint> found(asked.size());
  made.surface.locate(asked, found.data());
  for (std::size_t k = 0; k < asked.size(); ++k) {
    EXPECT_EQ(made.surface.shares()[found[k].shares[0]].facet, asked[k].facet);
    EXPECT_LT(glm::distance(position_of(made, found[k]), position_of(made, told[k])), 1e-6 * size);
    EXPECT_NEAR(found[k].weights[0] + found[k].weights[1] + found[k].weights[2], 1, 1e-12);
  }
}

void expect_found(const MadeSurface& made, std::mt19937& random, int points) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<PlanePoint> asked;
  std::vector<FacetPoint> told;
  for (int k = 0; k < points; ++k) {
    const auto t = static_cast<std::uint32_t>(random() % made.welded.triangles.size());
    const auto& corners = made.welded.triangles[t].vertices;
    const double u = uniform(random);
    const double v = uniform(random) * (1 - u);
    const Vec3 point = (1 - u - v) * made.welded.positions[corners[0]] + u * made.welded.positions[corners[1]] +
                       v * made.welded.positions[corners[2]];
    const std::uint32_t facet = made.facets.facet_of_triangle[t];
    asked.push_back({facet, made.facets.facets[facet].frame.to_plane(point)});
    const FacetPoint found = told.emplace_back(made.surface.locate(facet, asked.back().at));
    for (const std::uint32_t share : found.shares) {
      EXPECT_EQ(made.surface.shares()[share].facet, facet);
    }
    EXPECT_LT(glm::distance(position_of(made, found), point), 1e-9);  // weights would be cut off in another triangle
  }
  expect_same_together(made, asked, told, glm::distance(made.welded.low, made.welded.high));
}

TEST(Locate, FindsPointsOnRefinedFacetsWithHoles) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 12; ++trial) {
    SceneBuilder builder(std::pmr::get_default_resource());
    std::vector<Vec2> outer, inner;
    test::random_rings(random, 4 + static_cast<std::size_t>(trial), outer, inner);
    builder.prism(outer, trial % 3 == 0 ? std::vector<Vec2>() : inner, 0.7f);
    const double spacing = std::uniform_real_distribution<double>(0.05, 1.0)(random);
    MadeSurface made(builder.take(),
                     {trial % 2 ? Lattice::hexagonal : Lattice::quadrilateral, spacing, 0, spacing / 16});
    expect_found(made, random, 300);
    for (int round = 0; round < 4; ++round) {
      const auto count = static_cast<std::uint32_t>(made.surface.sites().size());
      std::vector<std::uint32_t> sites = {static_cast<std::uint32_t>(random() % count), count - 1};
      made.surface.refine(sites);
    }
    expect_found(made, random, 300);
    made.surface.align_ties(std::vector<double>(made.surface.samples().size(), 1.0), 0);
    expect_found(made, random, 300);
  }
}

// Single triangles without a mesh, thin ones, and larger ones, in any order.
TEST(Locate, ManyAtOnceOnAllKindsOfFacets) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  SceneBuilder builder(std::pmr::get_default_resource());
  for (int k = 0; k < 60; ++k) {
    const double size = k % 3 == 0 ? 2.0 : 0.05;
    const Vec3 a(3.0 * k, 0, 0), along(size * uniform(random), size * uniform(random), size);
    const Vec3 across = k % 5 == 0 ? 1e-3 * Vec3(uniform(random), 1, 0) : size * Vec3(1, uniform(random), 0);
    builder.quad(a, a + across, a + along + across, a + along);
    builder.triangle(a + Vec3(1, 0, 0), a + Vec3(1, 0, 0) + across, a + Vec3(1, 0, 0) + along);
  }
  const MadeSurface made(builder.take(), {Lattice::hexagonal, 0.3, 0, 0.1});
  std::vector<PlanePoint> asked;
  std::vector<FacetPoint> told;
  for (int k = 0; k < 1000; ++k) {
    const auto facet = static_cast<std::uint32_t>(random() % made.facets.facets.size());
    asked.push_back({facet, 2.0 * Vec2(uniform(random), uniform(random))});  // beside the facet as well
    told.push_back(made.surface.locate(facet, asked.back().at));
  }
  expect_same_together(made, asked, told, 3);
}

// Where floats no longer tell the sites apart, too.
TEST(Locate, ManyAtOnceAboutASiteOfAFacetThatIsVeryMuchLarger) {
  SceneBuilder builder(std::pmr::get_default_resource());
  constexpr double k_size = 1 << 19, k_spacing = 64;
  builder.quad({0, 0, 0}, {k_size, 0, 0}, {k_size, k_spacing, 0}, {0, k_spacing, 0});
  MadeSurface made(builder.take(), {Lattice::hexagonal, k_spacing, 0, std::ldexp(k_spacing, -12)});
  const auto sites = made.surface.sites();
  std::uint32_t corner = 0;
  while (sites[corner].position != Vec3(k_size, k_spacing, 0)) {
    ++corner;
  }
  for (int round = 0; round < 12; ++round) {
    made.surface.refine(std::array{corner});
  }
  ASSERT_EQ(made.surface.level_of(corner), 12u);  // a spacing of size / 2^25
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<PlanePoint> asked;
  std::vector<FacetPoint> told;
  for (int k = 0; k < 2000; ++k) {
    const double away = std::ldexp(k_spacing, -static_cast<int>(random() % 13));
    const Vec3 point = Vec3(k_size, k_spacing, 0) - away * Vec3(uniform(random), uniform(random), 0);
    asked.push_back({0, made.facets.facets[0].frame.to_plane(point)});
    told.push_back(made.surface.locate(0, asked.back().at));
  }
  expect_same_together(made, asked, told, k_size);
}

}  // namespace
}  // namespace radvor
