// Whole bakes against what is known of them: furnaces, enclosures, energy, invariance, determinism.
#include "radiosity/bake.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "radiosity/form_factor.h"
#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

constexpr double k_pi = 3.14159265358979323846;

BakeOptions coarse(double tolerance, double patch_spacing = 0.2) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = tolerance;
  options.spacing.patch_spacing = patch_spacing;
  options.spacing.element_levels = 1;
  return options;
}

// Every surface emits radiance 1 and reflects rho: outgoing radiance is 1 / (1 - rho) everywhere, corners included.
void expect_furnace(SceneBuilder& builder, double rho) {
  if (test::plain_threads_wanted()) {
    GTEST_SKIP() << "says nothing of threads, and takes minutes by brute force";
  }
  BakeOptions options = coarse(0.005);
  TestBake bake(builder.take(), options);
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  const auto samples = (*bake).surface().samples();
  ASSERT_GT(samples.size(), 500u);
  double worst = 0, mean = 0;
  Vec3 where(0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double error = (1 + rho * bake.irradiance(i).g / k_pi) * (1 - rho) - 1;
    mean += error / static_cast<double>(samples.size());
    if (std::abs(error) > std::abs(worst)) {
      worst = error;
      where = samples[i].point;
    }
  }
  // With albedo 0 radiosity says nothing of irradiance, which must be pi.
  for (std::size_t i = 0; i < samples.size() && rho == 0; ++i) {
    const double error = bake.irradiance(i).g / k_pi - 1;
    if (std::abs(error) > std::abs(worst)) {
      worst = error;
      where = samples[i].point;
    }
  }
  EXPECT_LT(std::abs(worst), 0.001) << "at " << where.x << " " << where.y << " " << where.z << ", mean error " << mean;
  const BakeStats stats = bake->stats();
  std::printf("furnace rho %.1f: %zu samples, worst %+.5f mean %+.6f, %.2f s direct, %.2f s indirect, %.1f M rays\n",
              rho, samples.size(), worst, mean, stats.seconds_direct, stats.seconds_indirect,
              double(stats.rays) * 1e-6);
  const double end = stats.absorbed_power + stats.absorbed_back_power + stats.unshot_power + stats.escaped_power;
  EXPECT_NEAR(end / stats.emitted_power, 1, 0.01);
  EXPECT_EQ(stats.escaped_power, 0);
}

class Furnace : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Albedo, Furnace, testing::Values(0.0, 0.5, 0.9));

TEST_P(Furnace, BoxRoom) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {2, 1.5, 1}, true, builder.material(Color(GetParam()), Color(1.0)));
  expect_furnace(builder, GetParam());
}

TEST_P(Furnace, LShapedRoom) {
  SceneBuilder builder;
  builder.prism(l_shape(), 0, 1, true, builder.material(Color(GetParam()), Color(1.0)));
  expect_furnace(builder, GetParam());
}

TEST_P(Furnace, RoomWithFloatingBox) {
  SceneBuilder builder;
  const std::uint32_t material = builder.material(Color(GetParam()), Color(1.0));
  builder.box({0, 0, 0}, {2, 1.5, 1}, true, material);
  builder.box({0.7, 0.5, 0.3}, {1.3, 0.9, 0.6}, false, material);
  expect_furnace(builder, GetParam());
}

TEST(Enclosure, AreaMeanOfPointLightInCubeOfCie171Case58) {
  // Any closed enclosure of uniform albedo: area means E_direct = Phi / S and E_indirect = rho Phi / (S (1 - rho)).
  if (test::plain_threads_wanted()) {
    GTEST_SKIP() << "says nothing of threads, and takes minutes by brute force";
  }
  for (const double rho : {0.2, 0.8}) {
    SceneBuilder builder;
    builder.box({0, 0, 0}, {4, 4, 4}, true, builder.material(Color(rho)));
    Light lamp;
    lamp.position = {2, 2, 2};
    lamp.color = Color(10000 / (4 * k_pi));
    builder.scene.lights.push_back(lamp);
    BakeOptions options = coarse(0.01);
    options.spacing.patch_spacing = 0.5;
    options.spacing.element_levels = 2;
    TestBake bake(builder.take(), options);
    bake.run();
    double direct = 0, indirect = 0, area = 0;
    const auto samples = (*bake).surface().samples();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      direct += samples[i].area * (*bake).direct()[i].g;
      indirect += samples[i].area * (*bake).indirect()[i].g;
      area += samples[i].area;
    }
    EXPECT_NEAR(area, 96, 1e-9);
    EXPECT_NEAR(direct / area, 104.1667, 0.005 * 104.1667) << rho;
    EXPECT_NEAR(indirect / area, rho * 10000 / (96 * (1 - rho)), 0.005 * rho * 10000 / (96 * (1 - rho))) << rho;
  }
}

TEST(Sky, RoofOpeningOfCie171Case59) {
  // Room 4 x 4 x 3 m, black, the whole roof open to a uniform sky: E / E_out is the form factor of the opening.
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0));
  builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, black);
  builder.quad({0, 0, 0}, {0, 0, 3}, {4, 0, 3}, {4, 0, 0}, black);
  builder.quad({0, 4, 0}, {4, 4, 0}, {4, 4, 3}, {0, 4, 3}, black);
  builder.quad({0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3}, black);
  builder.quad({4, 0, 0}, {4, 0, 3}, {4, 4, 3}, {4, 4, 0}, black);
  builder.under_sky(Color(1.0));
  TestBake bake(builder.take(), coarse(0.02, 0.5));
  bake.run();
  const std::array<Vec3, 4> opening = {Vec3(0, 0, 3), Vec3(0, 4, 3), Vec3(4, 4, 3), Vec3(4, 0, 3)};
  const auto samples = (*bake).surface().samples();
  double squares = 0, error = 0, mean = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double exact = polygon_form_factor(samples[i].point, samples[i].normal, opening, {0, 0, -1});
    const double baked = (*bake).direct()[i].g / k_pi;
    EXPECT_NEAR(baked, exact, 0.06) << i;
    squares += (baked - exact) * (baked - exact);
    error += baked - exact;
    mean += exact;
  }
  const auto count = static_cast<double>(samples.size());
  EXPECT_GT(count, 500);
  EXPECT_LT(std::sqrt(squares / count), 0.02 * mean / count);
  EXPECT_LT(std::abs(error), 0.002 * mean);
}

// Half a percent of what the floor sees is sky: most hemispheres have no ray there, and the mean has to be right
// anyway.
TEST(Sky, LittleOfItIsNotLess) {
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0));
  builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, black);
  builder.scene.meshes.push_back(std::move(builder.mesh()));
  builder.mesh() = Mesh(std::pmr::get_default_resource());
  builder.mesh().receives = false;  // a lid of 40 x 40 with a hole of 0.2 x 0.2, one unit above
  const Vec2 hole[4] = {{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 &a = hole[i], &b = hole[(i + 1) % 4];
    builder.quad({a, 1}, {200.0 * a, 1}, {200.0 * b, 1}, {b, 1}, black);
    builder.quad({200.0 * a, 0}, {200.0 * b, 0}, {200.0 * b, 1}, {200.0 * a, 1}, black);
  }
  builder.under_sky(Color(1.0));
  TestBake bake(builder.take(), coarse(0.05, 0.1));
  bake.run();
  const std::array<Vec3, 4> opening = {Vec3(-0.1, -0.1, 1), Vec3(-0.1, 0.1, 1), Vec3(0.1, 0.1, 1), Vec3(0.1, -0.1, 1)};
  const auto samples = (*bake).surface().samples();
  double baked = 0, exact = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    baked += (*bake).direct()[i].g / k_pi;
    exact += polygon_form_factor(samples[i].point, samples[i].normal, opening, {0, 0, -1});
  }
  EXPECT_GT(samples.size(), 1000u);
  EXPECT_LT(exact / static_cast<double>(samples.size()), 0.01);
  EXPECT_NEAR(baked / exact, 1, 0.03);
}

TEST(Sky, OpenPlainSeesAllOfIt) {
  SceneBuilder builder;
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, builder.material(Color(0.5)));
  builder.under_sky(Color(0.25));
  TestBake bake(builder.take(), coarse(0.02));
  bake.run();
  for (std::size_t i = 0; i < (*bake).surface().samples().size(); ++i) {
    EXPECT_EQ((*bake).direct()[i], Color(k_pi * 0.25));
    EXPECT_EQ((*bake).indirect()[i], Color(0.0));
  }
}

// A white room beside a bright one, closed both: what the white one lacks when all light has converged is nothing to
// the scene and half of its own.
TEST(Bounces, EndAsEachPlacesOwnSeries) {
  SceneBuilder builder;
  builder.box({0, 0, 0}, {4, 4, 4}, true, builder.material(Color(0.5), Color(100.0)));
  builder.box({10, 0, 0}, {11, 1, 1}, true, builder.material(Color(0.95), Color(0.001)));
  TestBake bake(builder.take(), coarse(0.05, 0.5));
  bake.run();
  const auto samples = (*bake).surface().samples();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double exact = samples[i].point.x < 5 ? k_pi * 100.0 / 0.5 : k_pi * 0.001 / 0.05;
    EXPECT_NEAR(bake.irradiance(i).g, exact, 0.02 * exact) << i;
  }
}

void expect_energy_closes(bool refines) {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.6));
  builder.quad({-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, grey);
  builder.box({-1, -1, 0.5}, {1, 0.5, 1.5}, false, grey);
  builder.quad({-0.5, -0.5, 3}, {-0.5, 0.5, 3}, {0.5, 0.5, 3}, {0.5, -0.5, 3},
               builder.material(Color(0.3), Color(20.0)));
  Light sun;
  sun.type = LightType::directional;
  sun.direction = glm::normalize(Vec3(1, 0.5, -2));
  sun.color = Color(3.0, 2.5, 2.0);
  Light sky;
  sky.type = LightType::sky;
  sky.color = Color(0.5);
  Light spot;
  spot.type = LightType::spot;
  spot.position = {2, 2, 2};
  spot.direction = glm::normalize(Vec3(-1, -1, -1));
  spot.color = Color(30.0);
  spot.inner_angle = 0.3;
  spot.outer_angle = 0.6;
  builder.scene.lights = {sun, sky, spot};
  BakeOptions options = coarse(0.01);
  options.spacing.refines = refines;
  TestBake bake(builder.take(), options);
  bake.run();
  const BakeStats stats = bake->stats();
  const double end = stats.absorbed_power + stats.absorbed_back_power + stats.unshot_power + stats.escaped_power;
  EXPECT_NEAR(end / stats.emitted_power, 1, 0.01)
      << stats.emitted_power << " = " << stats.absorbed_power << " + " << stats.absorbed_back_power << " + "
      << stats.unshot_power << " + " << stats.escaped_power;
  EXPECT_GT(stats.escaped_power, 0);
}

TEST(Energy, ClosesInAnOpenSceneWithEveryLight) {
  expect_energy_closes(false);
  expect_energy_closes(true);
}

Scene room_with_box_and_lamp(double scale = 1, const Transform& transform = k_identity) {
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.6, 0.5, 0.4));
  builder.box(Vec3(0.0), scale * Vec3(2, 1.5, 1), true, grey);
  builder.box(scale * Vec3(0.5, 0.4, 0.2), scale * Vec3(1.0, 0.9, 0.5), false, grey);
  builder.quad(scale * Vec3(1.2, 0.5, 0.95), scale * Vec3(1.2, 0.9, 0.95), scale * Vec3(1.6, 0.9, 0.95),
               scale * Vec3(1.6, 0.5, 0.95), builder.material(Color(0.0), Color(10.0, 8.0, 6.0)));
  builder.mesh().transform = transform;
  return builder.take();
}

TEST(Determinism, SameBytesForAnyThreadsAndSlices) {
  std::vector<Color> direct, indirect;
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    for (const double slice : {0.0, 0.01}) {
      TestBake bake(room_with_box_and_lamp(), coarse(0.02, 0.35), threads);
      ASSERT_EQ(bake.run(slice), BakeStatus::converged);
      const std::vector<Color> d((*bake).direct().begin(), (*bake).direct().end());
      const std::vector<Color> i((*bake).indirect().begin(), (*bake).indirect().end());
      if (direct.empty()) {
        direct = d;
        indirect = i;
        continue;
      }
      ASSERT_EQ(d.size(), direct.size());
      EXPECT_EQ(std::memcmp(d.data(), direct.data(), d.size() * sizeof(Color)), 0) << threads << " " << slice;
      EXPECT_EQ(std::memcmp(i.data(), indirect.data(), i.size() * sizeof(Color)), 0) << threads << " " << slice;
    }
  }
}

double mean_irradiance(Scene scene, const BakeOptions& options) {
  TestBake bake(std::move(scene), options);
  bake.run();
  double sum = 0, area = 0;
  const auto samples = (*bake).surface().samples();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    sum += samples[i].area * luminance(bake.irradiance(i));
    area += samples[i].area;
  }
  return sum / area;
}

TEST(Invariance, ScaleTranslationRotation) {
  const BakeOptions options = coarse(0.02, 0.3);
  const double base = mean_irradiance(room_with_box_and_lamp(), options);
  for (const double scale : {1e-3, 1e3}) {
    BakeOptions scaled = options;
    scaled.spacing.patch_spacing *= scale;
    EXPECT_NEAR(mean_irradiance(room_with_box_and_lamp(scale), scaled) / base, 1, 0.01) << scale;
  }
  const double c = std::cos(0.5), s = std::sin(0.5);
  EXPECT_NEAR(mean_irradiance(room_with_box_and_lamp(1, {1, 0, 0, 1e6, 0, 1, 0, -1e6, 0, 0, 1, 1e6}), options) / base,
              1, 0.01);
  EXPECT_NEAR(mean_irradiance(room_with_box_and_lamp(1, {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0}), options) / base, 1,
              0.01);
}

TEST(Leaks, InsideOfAClosedBoxStaysDark) {
  // A closed box with its faces inwards and out, floating in a lit room: not a bit of light inside.
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.7));
  const std::uint32_t inner = builder.material(Color(0.7));
  builder.box({0, 0, 0}, {2, 1.5, 1}, true, builder.material(Color(0.7), Color(1.0)));
  builder.box({0.6, 0.5, 0.3}, {1.2, 1.0, 0.6}, false, grey);
  builder.box({0.7, 0.6, 0.35}, {1.1, 0.9, 0.55}, true, inner);
  TestBake bake(builder.take(), coarse(0.02));
  bake.run();
  const auto samples = (*bake).surface().samples();
  int inside = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if ((*bake).facets().facets[samples[i].facet].material == inner) {
      ++inside;
      EXPECT_EQ(bake.irradiance(i), Color(0.0));
    }
  }
  EXPECT_GT(inside, 8);
}

TEST(MaxBounces, CountsReflections) {
  // In a furnace each bounce adds rho^k: with k bounces E = pi (1 + rho + ... + rho^k).
  SceneBuilder builder;
  builder.box({0, 0, 0}, {1, 1, 1}, true, builder.material(Color(0.5), Color(1.0)));
  const Scene scene = builder.take();
  for (const std::uint32_t bounces : {1u, 3u}) {
    BakeOptions options = coarse(0.02);
    options.max_bounces = bounces;
    Scene copy = scene;
    TestBake bake(std::move(copy), options);
    EXPECT_EQ(bake.run(), BakeStatus::converged);
    const double exact = k_pi * (1 - std::pow(0.5, bounces + 1)) / 0.5;
    EXPECT_NEAR(bake.irradiance(0).r, exact, 0.005 * exact);
  }
}

TEST(Disable, IndirectLeavesDirectAlone) {
  BakeOptions options = coarse(0.02);
  TestBake whole(room_with_box_and_lamp(), options);
  whole.run();
  options.disable = Disable::indirect;
  TestBake direct(room_with_box_and_lamp(), options);
  EXPECT_EQ(direct.run(), BakeStatus::converged);
  ASSERT_EQ((*direct).direct().size(), (*whole).direct().size());
  for (std::size_t i = 0; i < (*direct).direct().size(); ++i) {
    EXPECT_EQ((*direct).direct()[i], (*whole).direct()[i]);
    EXPECT_EQ((*direct).indirect()[i], Color(0.0));
  }
}

TEST(Standouts, FewBrightPatchesDoNotShootForEver) {
  // Found by radvor-bake's tests: with some hundred patches one always had 2 % of what was left, and shot alone.
  SceneBuilder builder;
  const std::uint32_t white = builder.material(Color(0.95));
  builder.box({0, 0, 0}, {2, 2, 2}, true, white);
  builder.quad({0.5, 0.5, 1.9}, {0.5, 1, 1.9}, {1, 1, 1.9}, {1, 0.5, 1.9}, builder.material(Color(0.0), Color(5.0)));
  BakeOptions options = coarse(0.2, 0.5);
  TestBake bake(builder.take(), options);
  EXPECT_EQ(bake.run(), BakeStatus::converged);
  EXPECT_LT(bake->stats().rays, 300'000u);  // 70,000; over a million where every patch shoots by itself
}

// A lamp over the middle of a square, half a side above it, sends a sixth of its light there: a face of a cube.
TEST(Energy, LampsShareTheRaysThatAccountForThemByPower) {
  SceneBuilder builder;
  builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, builder.material(Color(0.0)));
  Light lamp;
  lamp.type = LightType::point;
  lamp.position = {0, 0, 1};
  for (int i = 0; i < 64; ++i) {  // all but one are next to nothing
    lamp.color = Color(i == 40 ? 1.0 : 1e-9);
    builder.scene.lights.push_back(lamp);
  }
  TestBake bake(builder.take(), coarse(0.02, 0.5));
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  const BakeStats& stats = bake->stats();
  EXPECT_NEAR(stats.emitted_power, 4 * k_pi * 3, 1e-4);
  EXPECT_NEAR(stats.escaped_power / stats.emitted_power, 5.0 / 6, 0.003);  // a fifth of the tolerance would be 0.004
}

// A box: by a lamp that lights all of it every ray brings something, by one that lights a spot few bring all.
TEST(Hemispheres, TakeMoreRaysWhereTheirLightIsLessCertain) {
  const auto rays_a_site = [](const Light& light) {
    SceneBuilder builder;
    const std::uint32_t grey = builder.material(Color(0.5));
    builder.box({0, 0, 0}, {2, 2, 1}, true, grey);
    builder.scene.lights = {light};
    BakeOptions options = coarse(0.02, 0.2);
    TestBake bake(builder.take(), options);
    EXPECT_EQ(bake.run(), BakeStatus::converged);
    return static_cast<double>(bake->stats().rays) / static_cast<double>((*bake).surface().sites().size());
  };
  Light everywhere, spot;
  everywhere.type = LightType::point;
  everywhere.position = {1, 1, 0.5};
  everywhere.color = Color(1.0);
  spot = everywhere;
  spot.type = LightType::spot;
  spot.direction = {0, 0, -1};
  spot.inner_angle = 0.1;
  spot.outer_angle = 0.2;
  EXPECT_GT(rays_a_site(spot), 1.8 * rays_a_site(everywhere));
}

TEST(Disable, IndirectUnderASkyWithRefinement) {
  // Found by a read: probes looked for light that was never shot.
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.6));
  builder.quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, grey);
  builder.box({-0.5, -0.5, 0}, {0.5, 0.5, 1}, false, grey);
  builder.under_sky(Color(1.0));
  BakeOptions options = coarse(0.05, 0.4);
  options.spacing.element_levels = 0;
  options.spacing.refines = true;
  options.disable = Disable::indirect;
  TestBake bake(builder.take(), options);
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  for (std::size_t i = 0; i < (*bake).direct().size(); ++i) {
    EXPECT_EQ((*bake).indirect()[i], Color(0.0));
    EXPECT_LE((*bake).direct()[i].g, k_pi * (1 + 1e-9));
  }
}

TEST(Overflow, LightThatIsNotANumberEnds) {
  // Found by a read: with infinite radiosity and black albedo every comparison was false, and bounces went on for ever.
  SceneBuilder builder;
  builder.box({0, 0, 0}, {1, 1, 1}, true, builder.material(Color(0.0, 0.5, 0.9), Color(3e38)));
  TestBake bake(builder.take(), coarse(0.1, 0.5));
  EXPECT_EQ(bake.run(), BakeStatus::converged);
}

TEST(EmptyScene, ConvergesAtOnce) {
  SceneBuilder builder;
  TestBake bake(std::move(builder.scene), {});
  EXPECT_EQ(bake.run(), BakeStatus::converged);
  EXPECT_EQ((*bake).surface().samples().size(), 0u);
}

}  // namespace
}  // namespace radvor
