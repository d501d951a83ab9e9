// Light sources against closed forms, most of them those of CIE 171:2006.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "plates.h"
#include "radiosity/emitter.h"
#include "radiosity/form_factor.h"
#include "radiosity/punctual_light.h"
#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

constexpr double k_pi = 3.14159265358979323846;

double shine(const Light& light, const Receiver& receiver, const Visibility& visibility) {
  Tracer tracer(visibility);
  Sight sight;
  return irradiance_of_punctual_light(light, receiver, tracer, 1000, sight).r;
}

// Two triangles that make up the quadrilateral a, b, c, d and emit radiosity 1.
std::vector<Emitter> square_emitter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::vector<Emitter> emitters;
  for (const auto& corners : {std::array<Vec3, 3>{a, b, c}, std::array<Vec3, 3>{a, c, d}}) {
    const Vec3 twice = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    emitters.push_back({corners, glm::normalize(twice), Color(1.0), 0.5 * glm::length(twice)});
  }
  return emitters;
}

// As bakes do: what stands between is clipped away.
double glow(const std::vector<Emitter>& emitters, const Receiver& receiver, const Visibility& visibility,
            const EmitterAccuracy& accuracy, const Plates& plates = {}) {
  const OccluderTree occluders({plates.positions, plates.corners}, std::pmr::get_default_resource());
  Tracer tracer(visibility);
  double sum = 0;
  Sight sight;
  for (const Emitter& emitter : emitters) {
    sum += irradiance_of_emitter(emitter, receiver, tracer, accuracy, &occluders, sight).r;
  }
  return sum;
}

TEST(PointLight, IsotropicOfCie171Case52) {
  // 10000 lm at height 3; intensity = flux / (4 pi). Points and values of the closed form E = I h / d^3.
  const auto open = Plates{}.visibility();
  Light light;
  light.type = LightType::point;
  light.position = {0, 0, 3};
  light.color = Color(10000 / (4 * k_pi));
  const double at[10][2] = {{0, 0},  {.5, 0},   {1, 0}, {1.5, 0}, {.5, .5},
                            {1, .5}, {1.5, .5}, {1, 1}, {1.5, 1}, {1.5, 1.5}};
  const double exact[10] = {88.419413, 84.859172, 75.493818, 63.267782, 81.531603,
                            72.74876,  61.215955, 65.436847, 55.68103,  48.129432};
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(shine(light, receiver_at({at[i][0], at[i][1], 0}, {0, 0, 1}, open), open), exact[i], 1e-5);
  }
  EXPECT_EQ(shine(light, receiver_at({0, 0, 0}, {0, 0, -1}, open), open), 0);
}

TEST(PointLight, LuminousSphereGivesWhatItsCentreWould) {
  // A uniform sphere wholly above the horizon: exactly I cos / d^2, at any distance outside of it.
  const auto open = Plates{}.visibility();
  Light light;
  light.type = LightType::point;
  light.position = {0, 1, 2};
  light.color = Color(7.0);
  const Receiver receiver = receiver_at({0.5, 0, 0}, {0, 0, 1}, open);
  const double as_point = shine(light, receiver, open);
  for (double radius : {1e-3, 0.3, 1.0, 1.9}) {
    light.radius = radius;
    EXPECT_NEAR(shine(light, receiver, open), as_point, 2e-3 * as_point) << radius;
  }
}

TEST(DirectionalLight, CosineLawAndHardShadow) {
  Plates plates;
  plates.add({0, -5, 1}, {5, -5, 1}, {5, 5, 1}, {0, 5, 1});
  const auto visibility = plates.visibility();
  Light sun;
  sun.type = LightType::directional;
  sun.direction = {0.6, 0, -0.8};
  sun.color = Color(3.0);
  // The shadow's edge lies where the ray through the plate's edge x = 0, z = 1 meets the floor: x = 0.75.
  EXPECT_NEAR(shine(sun, receiver_at({0.75 - 1e-3, 0, 0}, {0, 0, 1}, visibility), visibility), 3 * 0.8, 1e-12);
  EXPECT_EQ(shine(sun, receiver_at({0.75 + 1e-3, 0, 0}, {0, 0, 1}, visibility), visibility), 0);
}

TEST(DirectionalLight, SunDiscCutByAStraightEdge) {
  // Uniform disc cut at signed distance u (radii) from its centre: visible = (acos u - u sqrt(1 - u^2)) / pi.
  const double angle = 0.02;
  Plates plates;
  plates.add({0, -500, 1}, {500, -500, 1}, {500, 500, 1}, {0, 500, 1});
  const auto visibility = plates.visibility();
  Light sun;
  sun.type = LightType::directional;
  sun.direction = {0, 0, -1};
  sun.color = Color(1.0);
  sun.angle = angle;
  for (double u : {-1.1, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.1}) {
    const double inside = std::clamp(u, -1.0, 1.0);
    const double exact = (std::acos(inside) - inside * std::sqrt(1 - inside * inside)) / k_pi;
    const Receiver receiver = receiver_at({u * std::tan(angle / 2), 0, 0}, {0, 0, 1}, visibility);
    EXPECT_NEAR(shine(sun, receiver, visibility), exact, 0.01) << u;
  }
}

TEST(SpotLight, FallsOffAsKhrLightsPunctual) {
  const auto open = Plates{}.visibility();
  Light spot;
  spot.type = LightType::spot;
  spot.position = {0, 0, 2};
  spot.direction = {0, 0, -1};
  spot.color = Color(5.0);
  spot.inner_angle = 0.3;
  spot.outer_angle = 0.7;
  for (double angle : {0.0, 0.2, 0.3, 0.5, 0.69, 0.71, 1.0}) {
    const Vec3 x(2 * std::tan(angle), 0, 0);
    const double distance = 2 / std::cos(angle);
    double ramp = (std::cos(angle) - std::cos(0.7)) / (std::cos(0.3) - std::cos(0.7));
    ramp = std::clamp(ramp, 0.0, 1.0);
    EXPECT_NEAR(shine(spot, receiver_at(x, {0, 0, 1}, open), open),
                5 * ramp * ramp * std::cos(angle) / (distance * distance), 1e-12);
  }
}

TEST(Emitter, HalfPlanePenumbra) {
  // 1 x 1 square at z = 2 facing down over an opaque half-plane z = 1, x < 0; receivers at z = 0. Closed form: the
  // square is cut by the line that the half-plane's edge projects onto its plane, and the rest is a rectangle.
  Plates plates;
  plates.add({-100, -100, 1}, {0, -100, 1}, {0, 100, 1}, {-100, 100, 1});
  const auto visibility = plates.visibility();
  const auto emitters = square_emitter({-.5, -.5, 2}, {-.5, .5, 2}, {.5, .5, 2}, {.5, -.5, 2});
  const double at[] = {-0.75, -0.5, -0.375, -0.25, -0.125, 0, 0.125, 0.25, 0.375, 0.5, 0.75, 1, 1.5};
  const double exact[] = {0,        0,        0.007078, 0.015898, 0.026048, 0.036739, 0.046942,
                          0.055656, 0.062167, 0.066183, 0.058406, 0.049522, 0.032663};
  EmitterAccuracy accuracy;
  accuracy.mean_irradiance = 0.04;
  accuracy.tolerance = 0.01;
  for (std::size_t i = 0; i < std::size(at); ++i) {
    // Off the lines that strata and shadow's edge would share.
    EXPECT_NEAR(glow(emitters, receiver_at({at[i], 1e-4, 0}, {0, 0, 1}, visibility), visibility, accuracy, plates),
                exact[i], 0.01 * 0.0367)
        << at[i];
  }
}

// By rays, across the penumbra of a half-plane: what a receiver's leeway saves, and what it may cost.
TEST(Emitter, LeewayIsRaysForError) {
  Plates plates;
  const Vec3 along(0.31, 0.95, 0), back(-0.95, 0.31, 0), up(0, 0, 1);  // as no side of the emitter, or of its parts
  plates.add(up + 100.0 * (back - along), up - 100.0 * along, up + 100.0 * along, up + 100.0 * (back + along));
  const auto visibility = plates.visibility();
  const auto emitters = square_emitter({-.5, -.5, 2}, {-.5, .5, 2}, {.5, .5, 2}, {.5, -.5, 2});
  EmitterAccuracy accuracy;
  accuracy.mean_irradiance = 0.04;
  accuracy.tolerance = 0.01;
  std::uint64_t rays_before = std::numeric_limits<std::uint64_t>::max();
  for (const double leeway : {0.125, 1.0, 8.0}) {
    Tracer tracer(visibility);
    double squares = 0;
    constexpr int k_receivers = 100;
    for (int i = 0; i < k_receivers; ++i) {
      Receiver receiver = receiver_at({(i + 0.5) / k_receivers - 0.5, 1e-4, 0}, {0, 0, 1}, visibility);
      const double exact = glow(emitters, receiver, visibility, accuracy, plates);
      receiver.leeway = leeway;
      double by_rays = 0;
      for (const Emitter& emitter : emitters) {
        Sight sight;
        by_rays += irradiance_of_emitter(emitter, receiver, tracer, accuracy, nullptr, sight).r;
      }
      squares += (by_rays - exact) * (by_rays - exact) / k_receivers;
    }
    // Where sixteen rays agree no more are asked, so less leeway than 1 gains little.
    EXPECT_LT(std::sqrt(squares), std::max(1.0, leeway) * accuracy.tolerance * accuracy.mean_irradiance) << leeway;
    EXPECT_LT(tracer.counters.rays, rays_before / 2) << leeway;
    rays_before = tracer.counters.rays;
  }
}

// Strips hide half of a square. Closed form: it shines through the gaps between them, rectangles on its plane.
TEST(Emitter, ACrowdIsClippedWhereThereIsLittleLeeway) {
  constexpr int k_strips = 20;  // two triangles each: more than few, not too many to be clipped
  constexpr double k_pitch = 0.5 / k_strips;
  Plates plates;
  for (int i = 0; i < k_strips; ++i) {
    const double x = -0.25 + k_pitch * i;
    plates.add({x, -100, 1}, {x + k_pitch / 2, -100, 1}, {x + k_pitch / 2, 100, 1}, {x, 100, 1});
  }
  const auto visibility = plates.visibility();
  const OccluderTree occluders({plates.positions, plates.corners}, std::pmr::get_default_resource());
  const auto emitters = square_emitter({-.5, -.5, 2}, {-.5, .5, 2}, {.5, .5, 2}, {.5, -.5, 2});
  EmitterAccuracy accuracy;
  accuracy.mean_irradiance = 0.04;
  accuracy.tolerance = 0.01;
  Receiver receiver = receiver_at({0, 1e-4, 0}, {0, 0, 1}, visibility);  // sees all on z = 1 twice as large on z = 2
  double exact = 0;
  for (int i = 0; i < k_strips; ++i) {
    const double low = -0.5 + 2 * k_pitch * (i + 0.5), high = low + k_pitch;
    const Vec3 gap[] = {{low, -.5, 2}, {low, .5, 2}, {high, .5, 2}, {high, -.5, 2}};
    exact += polygon_form_factor(receiver.point, receiver.normal, gap, {0, 0, -1});
  }
  const auto light = [&](double leeway, std::uint64_t& rays) {
    receiver.leeway = leeway;
    Tracer tracer(visibility);
    double sum = 0;
    for (const Emitter& emitter : emitters) {
      Sight sight;
      sum += irradiance_of_emitter(emitter, receiver, tracer, accuracy, &occluders, sight).r;
      EXPECT_TRUE(sight.open && sight.hidden) << leeway;
    }
    rays = tracer.counters.rays;
    return sum;
  };
  std::uint64_t rays = 0;
  for (const double leeway : {0.125, 1.0}) {
    EXPECT_NEAR(light(leeway, rays), exact, 1e-9) << leeway;
    EXPECT_LE(rays, 32u) << leeway;  // sixteen a triangle, whether it is all dark
  }
  EXPECT_NEAR(light(8, rays), exact, 8 * accuracy.tolerance * accuracy.mean_irradiance);
  EXPECT_GT(rays, 32u);
}

TEST(Emitter, ObstructedSquaresAreaMean) {
  // Unit squares z = 0 and 1 with a black plate of half their size between; area-mean form factors, closed forms.
  const double heights[] = {1.0 / 3, 0.4, 0.5};
  const double exact[] = {0.10635096, 0.10190811, 0.09950629};
  for (int i = 0; i < 3; ++i) {
    Plates plates;
    const double h = heights[i];
    plates.add({.25, .25, h}, {.75, .25, h}, {.75, .75, h}, {.25, .75, h});
    const auto visibility = plates.visibility();
    const auto emitters = square_emitter({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1});
    EmitterAccuracy accuracy;
    accuracy.mean_irradiance = 0.1;
    double mean = 0;
    const int side = 40;
    for (int a = 0; a < side; ++a) {
      for (int b = 0; b < side; ++b) {
        const Vec3 x((a + 0.5) / side, (b + 0.5) / side, 0);
        mean += glow(emitters, receiver_at(x, {0, 0, 1}, visibility), visibility, accuracy, plates) / (side * side);
      }
    }
    EXPECT_NEAR(mean / exact[i], 1, 2e-3) << h;
  }
}

TEST(Emitter, UnoccludedIsExactAndCutByTheHorizon) {
  const auto open = Plates{}.visibility();
  // CIE 171:2006, 5.6: a 4 x 4 patch on the floor as seen from a wall, half of it under the horizon of none.
  const auto patch = square_emitter({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  EXPECT_NEAR(100 * glow(patch, receiver_at({2, 0, 0.25}, {0, 1, 0}, open), open, {}), 45.122604, 1e-5);
  // A wall through the receiver's horizon: only what is above counts, and the points below are not "blocked".
  const auto wall = square_emitter({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1});
  const auto upper = square_emitter({1, -1, 0}, {1, -1, 1}, {1, 1, 1}, {1, 1, 0});
  const Receiver floor = receiver_at({0, 0, 0}, {0, 0, 1}, open);
  EXPECT_NEAR(glow(wall, floor, open, {}), glow(upper, floor, open, {}), 1e-12);
}

// Whatever shape two triangles have together, what they shine past a plate is the sum of both.
TEST(DirectLight, TwoTrianglesShineAsOneOnlyWhereTheyAreConvexTogether) {
  const Vec3 a(-1, -1, 2), b(1, -1, 2), c(1, 1, 2);
  const Vec3 outlines[3] = {{-1, 1, 2}, {1.5, 3, 2}, {1, 3, 2}};  // a square, a dart, a triangle in two
  Plates plates;
  plates.add({-.5, -.5, 1}, {.5, -.5, 1}, {.5, .5, 1}, {-.5, .5, 1});
  const BruteForceVisibility visibility = plates.visibility();
  for (const Vec3& d : outlines) {
    SceneBuilder builder;
    const std::uint32_t floor = builder.material(Color(0.0)), lamp = builder.material(Color(0.0), Color(1.0));
    builder.quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, floor);
    builder.quad({-.5, -.5, 1}, {.5, -.5, 1}, {.5, .5, 1}, {-.5, .5, 1}, floor);
    builder.triangle(c, b, a, lamp);
    builder.triangle(d, c, a, lamp);
    BakeOptions options;
    options.spacing.patch_spacing = 0.5;
    options.spacing.refines = false;
    TestBake bake(builder.take(), options);
    ASSERT_EQ(bake.run(), BakeStatus::converged);
    const auto samples = (*bake).surface().samples();
    std::size_t compared = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (samples[i].point.z == 0 && samples[i].normal.z > 0.5) {
        const std::vector<Emitter> halves = square_emitter(c, b, a, d);
        ASSERT_LT(halves[1].normal.z, 0);
        const Receiver receiver = receiver_at(samples[i].point, {0, 0, 1}, visibility);
        const double expected = k_pi * glow(halves, receiver, visibility, {}, plates);
        EXPECT_NEAR((*bake).direct()[i].r, expected, 1e-4) << samples[i].point.x << " " << samples[i].point.y;
        ++compared;
      }
    }
    EXPECT_GT(compared, 50);
  }
}

}  // namespace
}  // namespace radvor
