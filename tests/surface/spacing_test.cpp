// Spacing from the scene and the tolerance.
#include "surface/spacing.h"

#include <gtest/gtest.h>

#include <numbers>

#include "support/made_facets.h"
#include "surface/lattice.h"
#include "surface/solids.h"

namespace radvor {
namespace {

struct Room : test::MadeFacets {
  Room() : MadeFacets(make()) {}
  static Scene make() {
    test::SceneBuilder builder(std::pmr::get_default_resource());
    builder.box({0, 0, 0}, {4, 4, 3}, true);  // 80 square units, 44 of edges
    return builder.take();
  }
  SurfaceOptions choose(const SpacingRequest& request) const { return choose_spacing(scene, welded, facets, request); }
};

TEST(Spacing, GivesTwentyPatchesOverTheTolerance) {
  const Room room;
  for (const double tolerance : {0.1, 0.02, 0.004}) {
    for (const Lattice lattice : {Lattice::hexagonal, Lattice::quadrilateral}) {
      SpacingRequest request;
      request.tolerance = tolerance;
      request.lattice = lattice;
      const double spacing = room.choose(request).patch_spacing;
      const double cell = spacing * spacing * (lattice == Lattice::hexagonal ? std::numbers::sqrt3 / 2 : 1);
      EXPECT_NEAR(80 / cell, 20 / tolerance, 1e-6 * 20 / tolerance);
    }
  }
}

TEST(Spacing, LevelsFollowTheTolerance) {
  const Room room;
  const auto levels = [&](double tolerance, std::uint32_t asked) {
    SpacingRequest request;
    request.tolerance = tolerance;
    request.element_levels = asked;
    return room.choose(request).element_levels;
  };
  EXPECT_EQ(levels(0.1, 0), 1u);
  EXPECT_EQ(levels(0.08, 0), 1u);
  EXPECT_EQ(levels(0.02, 0), 2u);
  EXPECT_EQ(levels(0.005, 0), 3u);
  EXPECT_EQ(levels(0.02, 4), 4u);
}

TEST(Spacing, WhatIsAskedForIsTaken) {
  const Room room;
  SpacingRequest request;
  request.patch_spacing = 0.37;
  request.min_spacing = 0.01;
  const SurfaceOptions options = room.choose(request);
  EXPECT_EQ(options.patch_spacing, 0.37);
  EXPECT_EQ(options.min_spacing, 0.01);
  EXPECT_EQ(options.element_levels, 2u);
}

TEST(Spacing, RefinementBeginsWithThePatchesAndEndsAtAThirtySecond) {
  const Room room;
  SpacingRequest request;
  request.refines = true;
  SurfaceOptions options = room.choose(request);
  EXPECT_EQ(options.element_levels, 0u);
  EXPECT_EQ(options.border_levels, 2u);
  EXPECT_EQ(options.min_spacing, options.patch_spacing / 32);
  EXPECT_EQ(refinements(options), 5u);
  request.element_levels = 3;
  EXPECT_EQ(refinements(room.choose(request)), 2u);
  request.element_levels = 5;
  EXPECT_EQ(refinements(room.choose(request)), 0u);
  request.refines = false;
  request.element_levels = 0;
  EXPECT_EQ(refinements(room.choose(request)), 0u);
  EXPECT_EQ(room.choose(request).border_levels, 0u);
  request.refines = true;
  request.patch_spacing = 0.4;
  request.min_spacing = 0.11;
  EXPECT_EQ(refinements(room.choose(request)), 1u);
}

TEST(Spacing, FirstElementsAreNoFinerThanTheLeastSpacing) {
  const Room room;
  SpacingRequest request;
  request.patch_spacing = 0.4;
  request.min_spacing = 0.15;
  EXPECT_EQ(room.choose(request).element_levels, 1u);
}

TEST(Spacing, CoarsensUntilSitesAreWithinTheLimit) {
  const Room room;
  for (const std::uint32_t limit : {100u, 1000u, 10000u}) {
    SpacingRequest request;
    request.max_sites = limit;
    const SurfaceOptions options = room.choose(request);
    test::TestHost host;
    const Surface surface(room.scene, room.welded, room.facets, options, host);
    EXPECT_LE(surface.sites().size(), limit);
    EXPECT_GE(surface.sites().size(), limit / 3);
  }
}

// The same room with small boxes, of eight corners each.
Scene room_with_boxes(int rows, bool receive) {
  test::SceneBuilder builder(std::pmr::get_default_resource());
  builder.box({0, 0, 0}, {4, 4, 3}, true);
  builder.begin_mesh().receives = receive;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Vec3 at(0.2 + 3.5 * i / rows, 0.2 + 3.5 * j / rows, 1);
      builder.box(at, at + Vec3(0.01), false);
    }
  }
  return builder.take();
}

TEST(Spacing, WhereCornersAreMostOfTheSitesTheFirstElementsAreFiner) {
  const test::MadeFacets made(room_with_boxes(10, true));  // 808 corners
  SpacingRequest request;
  request.refines = true;
  const auto levels = [&](const test::MadeFacets& scene, double tolerance) {
    request.tolerance = tolerance;
    return choose_spacing(scene.scene, scene.welded, scene.facets, request).element_levels;
  };
  EXPECT_EQ(levels(made, 0.02), 0u);                                      // 1000 patches, 4 x 1000 > 32
  EXPECT_EQ(levels(made, 0.3), 1u);                                       // 67 patches, 4 x 67 <= 485 < 16 x 67
  EXPECT_EQ(levels(made, 0.8), 2u);                                       // 25 patches, 16 x 25 <= 1292 < 64 x 25
  EXPECT_EQ(levels(test::MadeFacets(room_with_boxes(20, true)), 1), 3u);  // 256 x 20 <= 6416, but three are the most
  EXPECT_EQ(levels(test::MadeFacets(room_with_boxes(20, false)), 1),
            0u);  // corners that get no light count for nothing
  request.refines = false;
  EXPECT_EQ(levels(made, 0.8), 1u);
  request.refines = true;
  request.patch_spacing = 2;
  EXPECT_EQ(levels(made, 0.8), 0u);
  request.element_levels = 3;
  EXPECT_EQ(levels(made, 0.02), 3u);
}

TEST(Spacing, ContactsAreResolvedAsTheToleranceAsks) {
  const Room room;
  SpacingRequest request;
  request.refines = true;
  for (const double tolerance : {0.1, 0.02}) {
    request.tolerance = tolerance;
    EXPECT_NEAR(room.choose(request).contact_spacing, 0.2 * tolerance * std::sqrt(80.0), 1e-9);
  }
}

TEST(Spacing, CornersAloneMayExceedTheLimit) {
  const Room room;
  SpacingRequest request;
  request.max_sites = 1;
  EXPECT_GT(room.choose(request).patch_spacing, 1);  // and it ends
}

}  // namespace
}  // namespace radvor
