// What finer samples take from the coarser ones between which they lie, against its integral.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "radiosity/method.h"
#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

// Before a black wall, with a spot of light in its middle that its mesh follows, a bright shelf at half its height:
// from there on the wall sees its top.
constexpr double k_low = 0.25, k_high = 0.75, k_half_width = 0.5, k_albedo = 0.9;
constexpr Vec3 k_lamp{0.5, 0.5, 0};
constexpr double k_intensity = 4;  // W/sr
const double k_cosine_of_cone = std::cos(0.5);

Scene wall_behind_a_shelf() {
  SceneBuilder builder;
  builder.quad({0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}, builder.material(Color(0.0)));
  builder.quad({k_low, 0, -k_half_width}, {k_low, 0, k_half_width}, {k_high, 0, k_half_width},
               {k_high, 0, -k_half_width}, builder.material(Color(k_albedo)));
  Light on_shelf, on_wall;
  on_shelf.type = on_wall.type = LightType::spot;
  on_shelf.position = k_lamp;
  on_shelf.direction = {0, -1, 0};
  on_shelf.outer_angle = on_shelf.inner_angle = std::acos(k_cosine_of_cone);
  on_shelf.color = Color(k_intensity);
  on_wall.position = {2, 0.6, 0};
  on_wall.direction = glm::normalize(-on_wall.position);
  on_wall.outer_angle = 0.3;
  on_wall.color = Color(8.0);
  builder.scene.lights = {on_shelf, on_wall};
  return builder.take();
}

// By the midpoint rule.
double reflected_to(const Vec3& point) {
  constexpr int k_steps = 100;
  constexpr double depth = (k_high - k_low) / k_steps, width = 2 * k_half_width / k_steps;
  double light = 0;
  for (int i = 0; i < k_steps; ++i) {
    for (int j = 0; j < k_steps; ++j) {
      const Vec3 at(k_low + (i + 0.5) * depth, 0, -k_half_width + (j + 0.5) * width);
      const Vec3 to_lamp = k_lamp - at, to_point = point - at;
      const double lamp2 = glm::dot(to_lamp, to_lamp), point2 = glm::dot(to_point, to_point);
      const double cosine = to_lamp.y / std::sqrt(lamp2);
      const double irradiance = cosine > k_cosine_of_cone ? k_intensity * cosine / lamp2 : 0;
      light += k_albedo * irradiance * std::max(0.0, to_point.y) * -to_point.x / (k_pi * point2 * point2);
    }
  }
  return light * depth * width;
}

// Root of the mean square, by area, of what light from all around is off by in a strip of the wall at the shelf's
// height; over the mean light of all that receives.
double error_at_the_height(std::uint32_t disabled, std::uint64_t& skipped) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = 0.02;
  options.spacing.refines = true;
  options.spacing.patch_spacing = 0.5;
  options.spacing.min_spacing = 0.02;
  options.max_bounces = 1;
  options.disable = disabled;
  TestBake bake(wall_behind_a_shelf(), options);
  EXPECT_EQ(bake.run(), BakeStatus::converged);
  skipped = bake->stats().skipped_lazy;
  const auto samples = (*bake).surface().samples();
  double squares = 0, area = 0, light = 0, all = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    all += samples[i].area;
    light += samples[i].area * bake.irradiance(i).g;
    const Vec3& at = samples[i].point;
    if (at.x < 0.01 && std::abs(at.y) < 0.15 && std::abs(at.z) < 0.4) {
      const double off = (*bake).indirect()[i].g - reflected_to(at);
      area += samples[i].area;
      squares += samples[i].area * off * off;
    }
  }
  return std::sqrt(squares / area) / (light / all);
}

TEST(Lazy, LooksWhereWhatIsSeenChangesAtOnce) {
  std::uint64_t skipped = 0, none = 0;
  const double lazy = error_at_the_height(0, skipped), all = error_at_the_height(Disable::lazy, none);
  EXPECT_GT(skipped, 0u);
  EXPECT_EQ(none, 0u);
  EXPECT_LT(all, 0.06);  // chance
  EXPECT_LT(lazy, 1.3 * all);
}

}  // namespace
}  // namespace radvor
