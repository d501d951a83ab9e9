// How many rays a scene is worth, where the first ones say little: they find nothing, or more than can be counted.
#include <gtest/gtest.h>

#include <cmath>

#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

constexpr double k_tolerance = 1.0 / 300;  // 32 + 450 rays a hemisphere by themselves, 32 + 150 at least

BakeOptions uniform(double spacing) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = k_tolerance;
  options.spacing.patch_spacing = spacing;  // so that there are many more samples than sound out
  options.spacing.element_levels = 0;
  options.disable = Disable::lazy;  // all look around
  return options;
}

struct Counts {
  double rays_a_sample;
  bool finite;
  std::size_t samples;
};

Counts bake(Scene scene, const BakeOptions& options) {
  TestBake bake(std::move(scene), options);
  EXPECT_EQ(bake.run(), BakeStatus::converged);
  Counts counts{0, true, (*bake).direct().size()};
  for (std::size_t i = 0; i < counts.samples; ++i) {
    const double light = luminance(bake.irradiance(i));
    counts.finite = counts.finite && std::isfinite(light) && light >= 0;
  }
  counts.rays_a_sample = static_cast<double>(bake->stats().rays) / static_cast<double>(counts.samples);
  return counts;
}

// A floor, with a lamp over it or none, and walls around it or none.
Scene floor(const Color& lamp, bool walled) {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.5, 0.3, 0.0));
  if (walled) {
    builder.box({-1, -1, 0}, {1, 1, 2}, true, grey);
  } else {
    builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, grey);
  }
  Light light;
  light.type = LightType::point;
  light.position = {0, 0, 1};
  light.color = lamp;
  builder.scene.lights = {light};
  return builder.take();
}

TEST(Soundings, ThatFindNothingDoNotTakeItForCertain) {
  if (test::plain_threads_wanted()) {
    GTEST_SKIP() << "says nothing of threads, and takes minutes by brute force";
  }
  // On a plain all rays miss. Where nothing shines either, that is no news; where something does, fewer rays than by
  // themselves would miss it as well.
  const double lit = bake(floor(Color(1.0), false), uniform(0.2)).rays_a_sample;
  const double certain = bake(floor(Color(1.0), true), uniform(0.5)).rays_a_sample;
  EXPECT_GT(lit, 400);
  EXPECT_LT(certain, 350);  // what rays find in a box lit by a lamp in its middle differs little
}

TEST(Soundings, InTheDarkLeaveTheNumberOfRays) {
  if (test::plain_threads_wanted()) {
    GTEST_SKIP() << "says nothing of threads, and takes minutes by brute force";
  }
  EXPECT_GT(bake(floor(Color(0.0), false), uniform(0.2)).rays_a_sample, 400);
}

TEST(Soundings, OfLightBeyondCountingLeaveTheNumberOfRays) {
  if (test::plain_threads_wanted()) {
    GTEST_SKIP() << "says nothing of threads, and takes minutes by brute force";
  }
  // As of a lamp as bright as the interface takes, 3e38, that is near: more than a float holds. One channel is black,
  // so that infinity would be no number after one reflection.
  const Counts little = bake(floor(Color(1.0), true), uniform(0.5));
  const Counts much = bake(floor(Color(1e40), true), uniform(0.5));
  EXPECT_TRUE(much.finite);
  EXPECT_NEAR(much.rays_a_sample, little.rays_a_sample, 0.1 * little.rays_a_sample);
}

}  // namespace
}  // namespace radvor
