// What a bake shows between slices: light from the first ones on, at every sample, whatever the mesh is about to do.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

// A ground with a thin pole on it, under sky and sun: the pole's shadow makes the mesh refine, the ground sees nearly
// all of the sky.
Scene ground_with_a_pole() {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.5));
  builder.quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, grey);
  builder.box({-0.1, -0.1, 0.2}, {0.1, 0.1, 0.6}, false, grey);
  builder.under_sky(Color(1.0));
  Light sun;
  sun.type = LightType::directional;
  sun.direction = glm::normalize(Vec3(0.6, 0.2, -1));
  sun.color = Color(0.5);
  builder.scene.lights.push_back(sun);
  return builder.take();
}

BakeOptions fine() {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = 0.02;
  options.spacing.patch_spacing = 0.25;
  options.spacing.refines = true;
  return options;
}

TEST(Meanwhile, TheSkyShowsFromTheFirstSlicesOnAtEverySampleOfTheGround) {
  TestBake bake(ground_with_a_pole(), fine());
  const double sky = 3.141592653589793;
  std::size_t slices = 0, first_sites = 0, last_sites = 0;
  for (BakeStatus status = BakeStatus::time_spent; status == BakeStatus::time_spent; ++slices) {
    status = bake->advance(1e-9, {});
    if (slices < 2) {
      continue;  // a unit of work each: the glimpse takes two
    }
    const auto samples = (*bake).surface().samples();
    ASSERT_EQ((*bake).direct().size(), samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Vec3& at = samples[i].point;
      if (std::abs(at.z) < 1e-6 && samples[i].normal.z > 0.5 && std::max(std::abs(at.x), std::abs(at.y)) > 0.3) {
        ASSERT_GT((*bake).direct()[i].g, 0.8 * sky) << "slice " << slices;
        ASSERT_LT((*bake).direct()[i].g, 1.01 * (sky + 0.5));
      }
    }
    last_sites = (*bake).surface().sites().size();
    first_sites = first_sites == 0 ? last_sites : first_sites;
  }
  EXPECT_GT(slices, 20u);
  EXPECT_GT(last_sites, first_sites + first_sites / 5);
}

// Sites beside a block that hangs over the ground look from elsewhere once the mesh there is finer, and until the lamp
// has shone on them anew they show what they had.
TEST(Meanwhile, WhatIsDueAgainShowsWhatItHad) {
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0));
  builder.quad({-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, black);
  builder.box({-1, -1, 0.05}, {1, 1, 1}, false, black);
  Light lamp;
  lamp.position = {3, 0, 0.6};
  lamp.color = Color(1.0);
  builder.scene.lights = {lamp};
  BakeOptions options = fine();
  options.spacing.patch_spacing = 0.8;
  options.spacing.tolerance = 0.5;  // the gap is not resolved before there is light
  TestBake bake(builder.take(), options);
  std::set<std::array<double, 2>> lit;
  for (BakeStatus status = BakeStatus::time_spent; status == BakeStatus::time_spent;) {
    status = bake->advance(1e-9, {});
    const auto samples = (*bake).surface().samples();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Vec3& at = (*bake).surface().sites()[samples[i].site].position;
      if (samples[i].normal.z > 0.5 && at.z == 0 && std::abs(at.x - 1) < 1e-6 && std::abs(at.y) < 0.9 &&
          samples[i].point.x > 1) {
        const bool is_lit = (*bake).direct()[i].g > 0.02;
        if (is_lit) {
          lit.insert({at.x, at.y});
        }
        ASSERT_TRUE(is_lit || lit.count({at.x, at.y}) == 0) << at.y;
      }
    }
  }
  EXPECT_GT(lit.size(), 10u);
}

TEST(Meanwhile, NewSamplesShowWhatTheyLieBetween) {
  Scene scene = ground_with_a_pole();
  scene.lights.erase(scene.lights.begin());  // the sun alone
  const double lit = 0.5 * std::abs(scene.lights[0].direction.z);
  TestBake bake(std::move(scene), fine());
  const std::size_t first = (*bake).surface().samples().size();
  std::size_t refined = 0;
  for (BakeStatus status = BakeStatus::time_spent; status == BakeStatus::time_spent;) {
    status = bake->advance(1e-9, {});
    const auto samples = (*bake).surface().samples();
    if (samples.size() == first) {
      continue;  // the sun has not shone on all of them yet
    }
    ++refined;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Vec3& at = samples[i].point;
      const bool beside = at.x < -0.05 || at.x > 0.55 || at.y < -0.12 || at.y > 0.3;  // of the shadow
      const bool in_the_sun = std::abs(at.z) < 1e-6 && samples[i].normal.z > 0.5 && beside;
      ASSERT_TRUE(!in_the_sun || (*bake).direct()[i].g > 0.1 * lit) << at.x << " " << at.y;
    }
  }
  EXPECT_GT(refined, 5u);
}

// A room, a wall from floor to ceiling across the middle of it.
SceneBuilder room_with_a_wall() {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.5));
  builder.box({0, 0, 0}, {4, 2, 2}, true, grey);
  builder.box({1.95, 0, 0}, {2.05, 2, 2}, false, grey);
  return builder;
}

BakeOptions uniform() {
  BakeOptions options;
  options.disable = Disable::indirect;
  options.spacing.patch_spacing = 0.5;
  return options;
}

// Units of work until all sources are guessed at everywhere and none has shone: then the samples' light.
std::vector<Color> guessed(TestBake& bake) {
  for (const double before = (*bake).progress().converged; (*bake).progress().converged == before;) {
    const auto shown = (*bake).direct();
    std::vector<Color> guess(shown.begin(), shown.end());
    if (bake->advance(1e-9, {}) != BakeStatus::time_spent || (*bake).progress().converged > before) {
      return guess;  // the first source shines
    }
  }
  return {};
}

TEST(Meanwhile, WhatNothingHidesIsGuessedExactlyFromLamps) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {4, 2, 2}, true, builder.material(Color(0.5)));
  for (int lamp = 0; lamp < 20; ++lamp) {  // more than are asked
    Light light;
    light.type = LightType::point;
    light.position = {0.2 + 0.18 * lamp, 1 + 0.5 * std::sin(lamp), 1.5};
    light.color = Color(1, 0.5, 0.1 * lamp);
    builder.scene.lights.push_back(light);
  }
  TestBake bake(builder.take(), uniform());
  const std::vector<Color> guess = guessed(bake);
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  ASSERT_EQ(guess.size(), (*bake).direct().size());
  for (std::size_t i = 0; i < guess.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const double light = (*bake).direct()[i][channel];
      ASSERT_NEAR(guess[i][channel], light, 1e-9 * light);
    }
  }
}

TEST(Meanwhile, WhatAWallHidesIsGuessedToATenthOfTheLampsLight) {
  SceneBuilder builder = room_with_a_wall();
  for (const double x : {0.7, 1.2, 3.1}) {
    Light light;
    light.type = LightType::point;
    light.position = {x, 1, 1};
    light.color = Color(x);
    builder.scene.lights.push_back(light);
  }
  const std::pmr::vector<Light> lights = builder.scene.lights;
  TestBake bake(builder.take(), uniform());
  const std::vector<Color> guess = guessed(bake);
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  ASSERT_EQ(guess.size(), (*bake).direct().size());
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < guess.size(); ++i) {
    const Sample& sample = (*bake).surface().samples()[i];
    double unhindered = 0;
    for (const Light& light : lights) {
      const Vec3 apart = light.position - sample.point;
      const double distance = glm::length(apart);
      unhindered += light.color.r * std::max(0.0, glm::dot(sample.normal, apart)) / (distance * distance * distance);
    }
    ASSERT_NEAR(guess[i].r, (*bake).direct()[i].r, 0.1 * unhindered + 1e-12);
    hidden += (*bake).direct()[i].r < 0.9 * unhindered ? 1 : 0;
  }
  EXPECT_GT(hidden, guess.size() / 10);
}

TEST(Meanwhile, PanelsAreGuessedToTenPercentFromTheFirstSlicesOn) {
  SceneBuilder builder = room_with_a_wall();
  const std::uint32_t lamp = builder.material(Color(0.5), Color(10.0));
  builder.quad({0.5, 0.5, 1.9}, {0.5, 1.5, 1.9}, {1.5, 1.5, 1.9}, {1.5, 0.5, 1.9}, lamp);
  builder.quad({3, 0.9, 1.5}, {3, 1.1, 1.5}, {3.2, 1.1, 1.5}, {3.2, 0.9, 1.5}, lamp);
  TestBake bake(builder.take(), uniform());
  const std::vector<Color> guess = guessed(bake);
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  ASSERT_EQ(guess.size(), (*bake).direct().size());
  double squares = 0, light = 0;
  for (std::size_t i = 0; i < guess.size(); ++i) {
    const double off = guess[i].r - (*bake).direct()[i].r;
    squares += off * off;
    light += (*bake).direct()[i].r;
  }
  const auto count = static_cast<double>(guess.size());
  EXPECT_LT(std::sqrt(squares / count), 0.1 * light / count);
}

TEST(Meanwhile, CornersAreGuessedAtBeforeAllElse) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {4, 2, 2}, true, builder.material(Color(0.5)));
  Light light;
  light.type = LightType::point;
  light.position = {1, 1, 1};
  light.color = Color(1);
  builder.scene.lights.push_back(light);
  BakeOptions options = uniform();
  options.spacing.patch_spacing = 0.1;
  TestBake bake(builder.take(), options);
  std::size_t corners_alone = 0, some_of_the_rest = 0;
  for (const double before = (*bake).progress().converged;
       bake->advance(1e-9, {}) == BakeStatus::time_spent && (*bake).progress().converged == before;) {
    const Surface& surface = (*bake).surface();
    std::size_t dark_corners = 0, bright_corners = 0, bright_others = 0, others = 0;
    for (std::size_t i = 0; i < surface.samples().size(); ++i) {
      const bool corner = surface.sites()[surface.samples()[i].site].vertex != k_none;
      const bool bright = (*bake).direct()[i].r > 0;
      dark_corners += corner && !bright ? 1 : 0;
      bright_corners += corner && bright ? 1 : 0;
      bright_others += !corner && bright ? 1 : 0;
      others += corner ? 0 : 1;
    }
    ASSERT_TRUE(dark_corners == 0 || bright_others == 0);
    corners_alone += bright_corners > 0 && bright_others == 0 ? 1 : 0;
    some_of_the_rest += bright_others > 0 && bright_others < others ? 1 : 0;
  }
  EXPECT_GT(corners_alone, 0u);
  EXPECT_GT(some_of_the_rest, 0u);
}

TEST(Meanwhile, WhatIsShownChangesNothing) {
  TestBake sliced(ground_with_a_pole(), fine()), whole(ground_with_a_pole(), fine());
  ASSERT_EQ(sliced.run(1e-9), BakeStatus::converged);
  ASSERT_EQ(whole.run(), BakeStatus::converged);
  EXPECT_TRUE(std::equal((*sliced).direct().begin(), (*sliced).direct().end(), (*whole).direct().begin(),
                         (*whole).direct().end()));
  EXPECT_TRUE(std::equal((*sliced).indirect().begin(), (*sliced).indirect().end(), (*whole).indirect().begin(),
                         (*whole).indirect().end()));
  EXPECT_EQ((*sliced).stats().rays, (*whole).stats().rays);
}

}  // namespace
}  // namespace radvor
