// Reflected light: a bright gradient near by against its integral, and what many small triangles cost.
#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "radiosity/method.h"
#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

// A lamp of 1 W/sr just above a floor of 1 x 1 and of albedo 0.8, and a plate above it that sees the floor from twice
// the lamp's height.
constexpr double k_albedo = 0.8, k_lamp_height = 0.05, k_plate_height = 0.1;

Scene floor_with_low_lamp() {
  SceneBuilder builder;
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, builder.material(Color(k_albedo)));
  const std::uint32_t black = builder.material(Color(0.0));
  const double low = 0.4, high = 0.6, z = k_plate_height;
  builder.quad({low, low, z}, {low, high, z}, {high, high, z}, {high, low, z}, black);
  Light lamp;
  lamp.position = {0.5, 0.5, k_lamp_height};
  lamp.color = Color(1.0);
  builder.scene.lights.push_back(lamp);
  return builder.take();
}

double floor_irradiance(const Vec2& at) {
  const double squared = glm::dot(at - Vec2(0.5), at - Vec2(0.5)) + k_lamp_height * k_lamp_height;
  return k_lamp_height / (squared * std::sqrt(squared));
}

// Of a point of the plate, of what a floor reflects: the integral over the floor by the midpoint rule, in steps of a
// fortieth of the lamp's height.
template <class Radiosity>
double seen_from_plate(const Vec3& point, Radiosity&& radiosity) {
  constexpr int k_steps = 800;
  double sum = 0;
  for (int i = 0; i < k_steps; ++i) {
    for (int j = 0; j < k_steps; ++j) {
      const Vec2 at((i + 0.5) / k_steps, (j + 0.5) / k_steps);
      const Vec2 aside = at - Vec2(point);
      const double squared = glm::dot(aside, aside) + k_plate_height * k_plate_height;
      sum += radiosity(at) * k_plate_height * k_plate_height / (k_pi * squared * squared);
    }
  }
  return sum / (k_steps * k_steps);
}

TEST(Reflection, OfABrightGradientNearBy) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = 0.005;
  options.spacing.patch_spacing = 0.2;
  options.spacing.element_levels = 1;
  options.spacing.min_spacing = 0.003;
  options.spacing.refines = true;
  options.max_bounces = 1;
  options.disable = Disable::lazy;  // what finer samples take from coarser ones is 0.8 % less here
  TestBake bake(floor_with_low_lamp(), options);
  ASSERT_EQ(bake.run(), BakeStatus::converged);

  double mean_floor = 0;
  constexpr int k_steps = 800;
  for (int i = 0; i < k_steps * k_steps; ++i) {
    mean_floor += floor_irradiance({(i % k_steps + 0.5) / k_steps, (i / k_steps + 0.5) / k_steps});
  }
  mean_floor /= k_steps * k_steps;
  const auto samples = (*bake).surface().samples();
  double found = 0, exact = 0, constant = 0, area = 0, squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].point.z > 0.5 * k_plate_height && ++count % 7 == 0) {
      const double here =
          seen_from_plate(samples[i].point, [](const Vec2& at) { return k_albedo * floor_irradiance(at); });
      const double off = (*bake).indirect()[i].g / here - 1;
      squares += samples[i].area * off * off;
      found += samples[i].area * (*bake).indirect()[i].g;
      exact += samples[i].area * here;
      constant +=
          samples[i].area * seen_from_plate(samples[i].point, [&](const Vec2&) { return k_albedo * mean_floor; });
      area += samples[i].area;
    }
  }
  ASSERT_GT(area, 0);
  EXPECT_NEAR(found, exact, 0.005 * exact);
  EXPECT_LT(std::sqrt(squares / area), 0.01);
  EXPECT_GT(std::abs(constant - exact), 0.3 * exact);  // what the floor as one patch of constant light would give
}

// Triangles of no neighbours, scattered in a cube under a sky.
Scene confetti(std::uint32_t count) {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.7));
  auto random = [draw = std::uint64_t{0}]() mutable { return 2 * to_unit(mix(++draw)) - 1; };
  const double size = 2 / std::cbrt(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 at{random(), random(), random()};
    const Vec3 along = size * Vec3{random(), random(), random()}, beside = size * Vec3{random(), random(), random()};
    builder.triangle(at, at + along, at + beside, grey);
  }
  builder.under_sky(Color(1.0));
  return builder.take();
}

double work_of_confetti(std::uint32_t count) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = 0.2;
  options.spacing.patch_spacing = 100;  // none is divided
  options.spacing.element_levels = 0;
  TestBake bake(confetti(count), options);
  EXPECT_EQ(bake.run(), BakeStatus::converged);
  const BakeStats stats = bake->stats();
  EXPECT_GT(stats.rays, count);
  return static_cast<double>(stats.rays + stats.form_factors);
}

TEST(Reflection, AmongManySmallTrianglesCostsNLogN) {
  if (test::plain_threads_wanted()) {
    GTEST_SKIP() << "says nothing of threads, and takes minutes by brute force";
  }
  const auto n_log_n = [](double n) { return n * std::log2(n); };
  const double few = work_of_confetti(500);
  for (const std::uint32_t count : {2000u, 8000u}) {
    EXPECT_LT(work_of_confetti(count), few * n_log_n(count) / n_log_n(500)) << count;
  }
}

}  // namespace
}  // namespace radvor
