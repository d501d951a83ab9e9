// What a bake skips since it cannot matter: without a skip the light is the same, and more is done for it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "plates.h"
#include "radiosity/emitter.h"
#include "radiosity/punctual_light.h"
#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

constexpr double k_tolerance = 0.02;

// A closed room with a block in it, a lamp that faces the floor, one that faces the ceiling, a small sun of a sphere
// and a spot. The block is a pile of slats, too many to be clipped away.
Scene room_of_lamps() {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {2, 1.5, 1}, true, builder.material(Color(0.6, 0.5, 0.4)));
  const std::uint32_t grey = builder.material(Color(0.3));
  for (int i = 0; i < 12; ++i) {
    const double x = 0.3 + 0.05 * i;
    builder.box({x, 0.3, 0.35}, {x + 0.02, 0.8, 0.4}, false, grey);
  }
  const std::uint32_t lamp = builder.material(Color(0.0), Color(10.0, 8.0, 6.0));
  const std::uint32_t dim = builder.material(Color(0.0), Color(5.0, 4.0, 3.0));
  builder.quad({1.2, 0.5, 0.95}, {1.2, 0.9, 0.95}, {1.6, 0.9, 0.95}, {1.6, 0.5, 0.95}, lamp);
  builder.quad({0.2, 1.1, 0.5}, {0.4, 1.1, 0.5}, {0.4, 1.3, 0.5}, {0.2, 1.3, 0.5}, dim);
  Light bulb, spot;
  bulb.type = LightType::point;
  bulb.position = {1.7, 1.2, 0.6};
  bulb.radius = 0.1;
  bulb.color = Color(0.4);
  spot.type = LightType::spot;
  spot.position = {0.5, 0.5, 0.9};
  spot.direction = {0, 0, -1};
  spot.outer_angle = 0.6;
  spot.color = Color(0.5);
  builder.scene.lights = {bulb, spot};
  return builder.take();
}

// A white room lit by a spot on its floor alone: what surrounds the spot has all of its light from later bounces.
Scene room_with_a_spot() {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {2, 1.5, 1}, true, builder.material(Color(0.85, 0.8, 0.75)));
  Light spot;
  spot.type = LightType::spot;
  spot.position = {1.1, 0.8, 0.95};
  spot.direction = {0, 0, -1};
  spot.outer_angle = 0.35;
  spot.color = Color(1.0);
  builder.scene.lights = {spot};
  return builder.take();
}

struct Baked {
  std::vector<Color> light;
  std::vector<double> areas;
  BakeStats stats;
};

Baked bake_without(std::uint32_t skip, bool refines, std::uint32_t max_bounces = 0, Scene (*scene)() = room_of_lamps) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = refines ? 5 * k_tolerance : k_tolerance;
  options.spacing.patch_spacing = 0.3;
  options.spacing.element_levels = refines ? 0 : 1;
  options.spacing.refines = refines;
  options.disable = skip;
  options.max_bounces = max_bounces;
  TestBake bake(scene(), options);
  EXPECT_EQ(bake.run(), BakeStatus::converged);
  Baked baked;
  baked.stats = bake->stats();
  for (std::size_t i = 0; i < (*bake).direct().size(); ++i) {
    baked.light.push_back(bake.irradiance(i));
    baked.areas.push_back((*bake).surface().samples()[i].area);
  }
  return baked;
}

// Root of the mean square of the difference over the mean, all by area.
double moved(const Baked& a, const Baked& b) {
  double square = 0, mean = 0, area = 0;
  for (std::size_t i = 0; i < a.light.size(); ++i) {
    const Color apart = a.light[i] - b.light[i];
    square += a.areas[i] * glm::dot(apart, apart) / 3;
    mean += a.areas[i] * (a.light[i].r + a.light[i].g + a.light[i].b) / 3;
    area += a.areas[i];
  }
  return std::sqrt(square * area) / mean;
}

TEST(Skips, FacingMovesNoBitAndSavesRays) {
  for (const bool refines : {false, true}) {
    const Baked on = bake_without(0, refines), off = bake_without(Disable::facing, refines);
    EXPECT_GT(on.stats.skipped_facing, 0u);
    EXPECT_EQ(off.stats.skipped_facing, 0u);
    EXPECT_GT(off.stats.rays, on.stats.rays);
    EXPECT_GE(off.stats.form_factors, on.stats.form_factors);
    ASSERT_EQ(on.light.size(), off.light.size());
    EXPECT_EQ(std::memcmp(on.light.data(), off.light.data(), on.light.size() * sizeof(Color)), 0);
  }
}

// Without patches that shoot by themselves: there are as many as a share of all rays allows, and there are more rays.
TEST(Skips, NegligibleMovesLessThanATenthOfTheTolerance) {
  for (const std::uint32_t other : {Disable::indirect, 0u}) {
    const Baked on = bake_without(other, false, 100), off = bake_without(other | Disable::negligible, false, 100);
    EXPECT_GT(on.stats.skipped_negligible, 0u);
    EXPECT_EQ(off.stats.skipped_negligible, 0u);
    EXPECT_GT(off.stats.rays, on.stats.rays);
    ASSERT_EQ(on.light.size(), off.light.size());
    const double by = moved(on, off);
    EXPECT_GT(by, 0);  // it does leave something undone
    EXPECT_LT(by, 0.1 * k_tolerance);
  }
}

// And is off by chance alone: too much here, too little there.
TEST(Skips, NegligibleReadsLessOfWhatBringsLittle) {
  const Baked on = bake_without(0, false, 100, room_with_a_spot);
  const Baked off = bake_without(Disable::negligible, false, 100, room_with_a_spot);
  // At most once a sample what is outside of the cone, and the last bounce.
  EXPECT_GT(on.stats.skipped_negligible, 2 * on.light.size());
  ASSERT_EQ(on.light.size(), off.light.size());
  double brighter = 0, all = 0;
  for (std::size_t i = 0; i < on.light.size(); ++i) {
    brighter += on.areas[i] * (on.light[i].g - off.light[i].g);
    all += on.areas[i] * off.light[i].g;
  }
  EXPECT_LT(moved(on, off), 0.1 * k_tolerance);
  EXPECT_LT(std::abs(brighter), 0.02 * k_tolerance * all);
}

// The series at the end goes on with what the last two bounces read.
TEST(Skips, NegligibleLeavesTheSeriesAtTheEndRight) {
  const Baked on = bake_without(0, false, 0, room_with_a_spot);
  const Baked off = bake_without(Disable::negligible, false, 0, room_with_a_spot);
  ASSERT_EQ(on.light.size(), off.light.size());
  EXPECT_LT(moved(on, off), 0.01 * k_tolerance);
}

TEST(Skips, NegligibleEndsBouncesThatAreLeftToThemselves) {
  const Baked on = bake_without(0, false, 100), off = bake_without(Disable::negligible, false, 100);
  EXPECT_GT(off.stats.shots, on.stats.shots);
  EXPECT_LT(off.stats.unshot_power, 1e-6 * off.stats.emitted_power);
}

TEST(Skips, NegligibleWithAMeshThatFollowsTheLight) {
  const Baked on = bake_without(0, true), off = bake_without(Disable::negligible, true);
  EXPECT_GT(on.stats.skipped_negligible, 0u);
  EXPECT_EQ(off.stats.skipped_negligible, 0u);
  EXPECT_GE(off.stats.rays, on.stats.rays);
}

// One receiver and one source, in the open and behind its back.
class OneSource : public testing::Test {
 protected:
  Color from_emitter(const Vec3& normal, Tracer& tracer, Sight& sight) const {
    Emitter emitter;
    emitter.corners = {Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 0, 1)};  // faces down
    emitter.normal = {0, 0, -1};
    emitter.radiosity = Color(1.0);
    emitter.area = 0.5;
    return irradiance_of_emitter(emitter, {Vec3(0), Vec3(0), normal}, tracer, {}, nullptr, sight);
  }

  Color from_lamp(const Light& light, const Vec3& normal, Tracer& tracer, Sight& sight) const {
    return irradiance_of_punctual_light(light, {Vec3(0), Vec3(0), normal}, tracer, 100, sight);
  }

  const BruteForceVisibility visibility_ = Plates{}.visibility();
};

TEST_F(OneSource, BehindTheReceiverCastsRaysThatDoNotCount) {
  Light lamp;
  lamp.position = {0, 0, 2};
  lamp.color = Color(1.0);
  for (const double radius : {0.0, 0.5}) {
    lamp.radius = radius;
    for (const bool skips : {true, false}) {
      Tracer tracer(visibility_, {skips, true});
      Sight sight;
      EXPECT_EQ(from_lamp(lamp, {0, 0, -1}, tracer, sight), Color(0.0));
      EXPECT_EQ(from_emitter({0, 0, -1}, tracer, sight), Color(0.0));
      EXPECT_FALSE(sight.open || sight.hidden);  // else shadow edges would be looked for along the horizon
      EXPECT_EQ(tracer.counters.rays == 0, skips);
      EXPECT_EQ(tracer.counters.skipped_facing > 0, skips);
    }
  }
}

TEST_F(OneSource, OutsideOfASpotsConeIsNegligible) {
  Light spot;
  spot.type = LightType::spot;
  spot.position = {0, 0, 2};
  spot.direction = {1, 0, 0};
  spot.color = Color(1.0);
  for (const bool skips : {true, false}) {
    Tracer tracer(visibility_, {true, skips});
    Sight sight;
    EXPECT_EQ(from_lamp(spot, {0, 0, 1}, tracer, sight), Color(0.0));
    EXPECT_FALSE(sight.open || sight.hidden);
    EXPECT_EQ(tracer.counters.rays, skips ? 0u : 1u);
    EXPECT_EQ(tracer.counters.skipped_negligible, skips ? 1u : 0u);
  }
}

TEST_F(OneSource, AWeakLampIsAskedByFewerRays) {
  Emitter emitter;
  emitter.corners = {Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 0, 1)};
  emitter.normal = {0, 0, -1};
  emitter.radiosity = Color(1e-3);
  emitter.area = 0.5;
  std::uint64_t rays[2];
  for (const bool skips : {true, false}) {
    Tracer tracer(visibility_, {true, skips});
    Sight sight;
    const Color light =
        irradiance_of_emitter(emitter, {Vec3(0), Vec3(0), Vec3(0, 0, 1)}, tracer, {1, k_tolerance}, nullptr, sight);
    EXPECT_GT(light.r, 0);
    rays[skips] = tracer.counters.rays;
    EXPECT_EQ(tracer.counters.skipped_negligible, skips ? 1u : 0u);
  }
  EXPECT_LT(rays[1], rays[0]);
}

}  // namespace
}  // namespace radvor
