// Light in slots: what lies between surfaces that nearly touch is dark but for a strip as wide as the gap, however
// coarse the mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

constexpr double k_pi = 3.14159265358979323846;

BakeOptions coarse(double patch_spacing) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = 0.05;
  options.spacing.patch_spacing = patch_spacing;
  return options;
}

// Between a floor and what hangs `gap` over it, far from the sides of both: irradiance `inside` of the edge of what
// hangs, under a sky of radiance one. A strip that is seen from 0 to an angle whose tangent is gap / inside.
double under_an_edge(double inside, double gap) {
  return k_pi * 0.5 * (1 - inside / std::hypot(inside, gap));
}

TEST(Slots, NoMoreLightIsReceivedThanEntersThroughTheMouths) {
  for (const double gap : {0.001, 0.01}) {
    for (const bool refines : {false, true}) {
      SceneBuilder builder;
      const std::uint32_t black = builder.material(Color(0.0));
      builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, black);
      builder.quad({-1, -1, gap}, {-1, 1, gap}, {1, 1, gap}, {1, -1, gap}, black);
      builder.under_sky(Color(1.0));
      BakeOptions options = coarse(0.8);
      options.spacing.refines = refines;
      TestBake bake(builder.take(), options);
      ASSERT_EQ(bake.run(), BakeStatus::converged);
      double received = 0;
      const auto samples = (*bake).surface().samples();
      for (std::size_t i = 0; i < samples.size(); ++i) {
        received += samples[i].area * bake.irradiance(i).g;
      }
      // Through mouths of 8 together.
      EXPECT_LT(received, 1.5 * k_pi * gap * 8) << gap << " " << refines;
      EXPECT_GT(received, 0.5 * k_pi * gap * 8) << gap << " " << refines;
    }
  }
}

// A block that hangs over a floor.
Scene hanging_block(double gap) {
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0));
  builder.quad({-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, black);
  builder.box({-1, -1, gap}, {1, 1, 1}, false, black);
  builder.under_sky(Color(1.0));
  return builder.take();
}

TEST(Slots, BesideAContactWithAGapOneSideIsInTheDarkAndTheOtherIsNot) {
  TestBake bake(hanging_block(0.02), coarse(0.5));
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  const auto samples = (*bake).surface().samples();
  std::size_t dark = 0, lit = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3& at = (*bake).surface().sites()[samples[i].site].position;
    if (samples[i].normal.z > 0.5 && at.z == 0 && std::abs(at.x - 1) < 1e-6 && std::abs(at.y) < 0.7) {
      (samples[i].point.x < at.x ? dark : lit) += 1;
      if (samples[i].point.x < at.x) {
        // Its cell, a sixteenth deep, is as bright as this in the mean; at the edge itself it is half of pi.
        EXPECT_NEAR(bake.irradiance(i).g, 0.135 * k_pi, 0.03 * k_pi) << at.y;
      } else {
        EXPECT_GT(bake.irradiance(i).g, 0.4 * k_pi) << at.y;  // a wall one high takes half of the sky or less
      }
    }
  }
  EXPECT_GT(dark, 8u);
  EXPECT_EQ(lit, dark);
}

// Once sites are as close as the gap, those on the contact see what there is to see there, though the light of the
// first ones was another.
TEST(Slots, WhereTheMeshIsAsFineAsTheGapLightIsAsTheFormulaHasIt) {
  const double gap = 0.1;
  BakeOptions options = coarse(0.4);
  options.tolerance = 0.005;
  options.spacing.refines = true;
  options.spacing.min_spacing = 0.0125;
  TestBake bake(hanging_block(gap), options);
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  const auto samples = (*bake).surface().samples();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3& at = (*bake).surface().sites()[samples[i].site].position;
    if (samples[i].normal.z > 0.5 && at.z == 0 && at.x <= 1 + 1e-9 && at.x > 0.7 && std::abs(at.y) < 0.3 &&
        samples[i].point.x <= 1) {
      EXPECT_NEAR(bake.irradiance(i).g, under_an_edge(1 - at.x, gap), 0.06 * k_pi) << at.x << " " << at.y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100u);
}

// A corner of another surface divides the floor's border, welded from half a millimetre over it: where a sample there
// looks from is on the floor all the same.
TEST(Slots, ASiteOffThePlaneLooksFromThePlane) {
  const double gap = 0.01;
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0));
  builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, black);
  builder.quad({-1, -1, gap}, {-1, 1, gap}, {1, 1, gap}, {1, -1, gap}, black);
  builder.triangle({1, 0.05, 0.0005}, {1.5, -0.5, -1}, {1.5, 0.5, -1}, black);
  builder.under_sky(Color(1.0));
  BakeOptions options = coarse(0.8);
  options.tolerance = 0.005;  // many rays
  options.weld_distance = 0.001;
  TestBake bake(builder.take(), options);
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  const auto samples = (*bake).surface().samples();
  double at_corner = -1, others = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec3& at = (*bake).surface().sites()[samples[i].site].position;
    if (samples[i].facet_normal.z > 0.5 && std::abs(at.x - 1) < 1e-6 && std::abs(at.y) < 0.9) {
      if (std::abs(at.y - 0.05) < 1e-6) {
        EXPECT_GT(at.z, 0.0004);
        at_corner = bake.irradiance(i).g;
      } else {
        others += bake.irradiance(i).g;
        ++count;
      }
    }
  }
  ASSERT_GT(count, 4u);
  EXPECT_GT(at_corner, 0.5 * others / static_cast<double>(count));
}

}  // namespace
}  // namespace radvor
