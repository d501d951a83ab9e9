// The mesh follows the light: where shadows fall, near what is near, and nowhere else.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "radiosity/form_factor.h"
#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

constexpr double k_pi = 3.14159265358979323846;

BakeOptions refining(double tolerance, double patch_spacing) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = tolerance;
  options.spacing.patch_spacing = patch_spacing;
  options.spacing.refines = true;
  return options;
}

// A floor under a small lamp, with a screen between that shades the half x < 0.
Scene half_shaded_floor() {
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0));
  builder.quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, black);
  builder.quad({-2, -2, 1}, {0, -2, 1}, {0, 2, 1}, {-2, 2, 1}, black);
  Light lamp;
  lamp.position = {0, 0, 2};
  lamp.color = Color(1.0);
  builder.scene.lights = {lamp};
  return builder.take();
}

TEST(Refinement, FollowsAShadowEdgeAndNothingElse) {
  TestBake bake(half_shaded_floor(), refining(0.02, 0.25));
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  const Surface& surface = (*bake).surface();
  const double finest = 0.25 / std::exp2(surface.max_level());
  std::size_t on_edge = 0, fine = 0, astray = 0;
  for (const Site& site : surface.sites()) {
    if (site.position.z != 0 || site.level + 1u < surface.max_level()) {
      continue;
    }
    ++fine;
    on_edge += std::abs(site.position.x) < 4 * finest;
    astray += std::abs(site.position.x) > 0.5;
  }
  EXPECT_GT(on_edge, 4 / (4 * finest));  // the edge is 4 long
  EXPECT_EQ(astray, 0u);
  EXPECT_GT(fine, 0u);
}

TEST(Refinement, ShadowEdgeIsWhereItIsToTheMinimumSpacing) {
  TestBake bake(half_shaded_floor(), refining(0.01, 0.25));
  bake.run();
  const Surface& surface = (*bake).surface();
  const double finest = 0.25 / std::exp2(surface.max_level());
  std::uint32_t floor = 0;
  while ((*bake).facets().facets[floor].frame.origin.z != 0) {
    ++floor;
  }
  const Frame& frame = (*bake).facets().facets[floor].frame;
  for (double y = -1.9; y < 1.9; y += 0.0373) {
    for (const double x : {-2.5 * finest, 2.5 * finest}) {
      const FacetPoint at = surface.locate(floor, frame.to_plane({x, y, 0}));
      double light = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        light += at.weights[k] * (*bake).direct()[surface.shares()[at.shares[k]].sample].g;
      }
      const double square = x * x + y * y + 4;
      const double exact = x < 0 ? 0 : 2 / (square * std::sqrt(square));
      EXPECT_NEAR(light, exact, 0.01 * 0.25) << x << " " << y;
    }
  }
}

TEST(Refinement, SmoothLightCostsNothing) {
  // A large sky over an open plain, a sun: the same everywhere.
  SceneBuilder builder;
  builder.quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, builder.material(Color(0.5)));
  Light sun;
  sun.type = LightType::directional;
  sun.direction = glm::normalize(Vec3(1, 2, -2));
  sun.color = Color(1.0);
  Light sky;
  sky.type = LightType::sky;
  sky.color = Color(1.0);
  builder.scene.lights = {sun, sky};
  TestBake bake(builder.take(), refining(0.002, 0.25));
  bake.run();
  for (const Site& site : (*bake).surface().sites()) {
    EXPECT_EQ(site.level, 0);
  }
}

TEST(Refinement, LampJustUnderACeilingIsFoundWithoutAnyShadowEdge) {
  // The ceiling above the lamp sees nothing but its back; indirect light alone tells.
  SceneBuilder builder;
  const std::uint32_t white = builder.material(Color(0.8));
  builder.box({-1, -1, 0}, {1, 1, 2}, true, white);
  builder.quad({-0.2, -0.2, 1.97}, {-0.2, 0.2, 1.97}, {0.2, 0.2, 1.97}, {0.2, -0.2, 1.97},
               builder.material(Color(0.0), Color(10.0)));
  TestBake bake(builder.take(), refining(0.01, 0.15));
  bake.run();
  std::size_t fine = 0, far = 0;
  for (const Site& site : (*bake).surface().sites()) {
    const double reach = std::max(std::abs(site.position.x), std::abs(site.position.y));
    if (site.position.z == 2 && site.level >= 2) {
      fine += reach < 0.4;
      far += reach > 0.5 && reach < 0.8;
    }
  }
  EXPECT_GT(fine, 1.6 / (0.15 / 4));  // one a spacing along the lamp's outline
  EXPECT_LT(far, fine / 4);
}

void expect_same_bytes(const std::function<Scene()>& make, const BakeOptions& options) {
  std::vector<Color> first;
  std::uint64_t rays = 0;
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    for (const double slice : {0.0, 0.002}) {
      TestBake bake(make(), options, threads);
      ASSERT_EQ(bake.run(slice), BakeStatus::converged);
      std::vector<Color> light;
      for (std::size_t i = 0; i < (*bake).direct().size(); ++i) {
        light.push_back((*bake).direct()[i]);
        light.push_back((*bake).indirect()[i]);
      }
      if (first.empty()) {
        first = light;
        rays = bake->stats().rays;
      }
      EXPECT_GT((*bake).surface().sites().size(), 300u);
      EXPECT_TRUE(light == first) << threads << " " << slice;
      EXPECT_EQ(bake->stats().rays, rays) << threads << " " << slice;
    }
  }
}

TEST(Refinement, SameBytesForAnyThreadsAndSlices) {
  const auto room = [] {
    SceneBuilder builder;
    const std::uint32_t grey = builder.material(Color(0.6, 0.5, 0.4));
    builder.box({0, 0, 0}, {2, 1.5, 1}, true, grey);
    builder.box({0.5, 0.4, 0.2}, {1.0, 0.9, 0.5}, false, grey);
    builder.quad({1.2, 0.5, 0.95}, {1.2, 0.9, 0.95}, {1.6, 0.9, 0.95}, {1.6, 0.5, 0.95},
                 builder.material(Color(0.0), Color(10.0, 8.0, 6.0)));
    return builder.take();
  };
  expect_same_bytes(room, refining(0.05, 0.3));
}

// What a lamp alone does not do: a glimpse of the sky, rays by how much of it is seen, a sun's shadows.
TEST(Refinement, SameBytesForAnyThreadsAndSlicesUnderASkyAndSun) {
  const auto yard = [] {
    SceneBuilder builder;
    const std::uint32_t grey = builder.material(Color(0.6, 0.5, 0.4));
    builder.quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, grey);
    builder.box({-0.6, -0.5, 0}, {0.4, 0.5, 1}, false, grey);
    // A shed, open to one side: it sees little of the sky.
    const std::uint32_t boards = builder.material(Color(0.4, 0.3, 0.2), Color(0.0), true);
    builder.quad({0.9, -0.5, 0.8}, {1.7, -0.5, 0.8}, {1.7, 0.5, 0.8}, {0.9, 0.5, 0.8}, boards);
    builder.quad({0.9, -0.5, 0}, {1.7, -0.5, 0}, {1.7, -0.5, 0.8}, {0.9, -0.5, 0.8}, boards);
    builder.quad({1.7, -0.5, 0}, {1.7, 0.5, 0}, {1.7, 0.5, 0.8}, {1.7, -0.5, 0.8}, boards);
    builder.under_sky(Color(0.5, 0.6, 0.8));
    Light sun;
    sun.type = LightType::directional;
    sun.direction = glm::normalize(Vec3(-0.6, 0.3, -0.7));
    sun.color = Color(3.0, 2.8, 2.5);
    sun.angle = 0.01;
    builder.scene.lights.push_back(sun);
    return builder.take();
  };
  expect_same_bytes(yard, refining(0.05, 0.4));
}

TEST(Refinement, FurnaceStaysOne) {
  SceneBuilder builder;
  const std::uint32_t material = builder.material(Color(0.5), Color(1.0));
  builder.box({0, 0, 0}, {2, 1.5, 1}, true, material);
  builder.box({0.7, 0.5, 0.3}, {1.3, 0.9, 0.6}, false, material);
  TestBake bake(builder.take(), refining(0.005, 0.2));
  bake.run();
  for (std::size_t i = 0; i < (*bake).surface().samples().size(); ++i) {
    EXPECT_NEAR((1 + 0.5 * bake.irradiance(i).g / k_pi) * 0.5, 1, 0.005);
  }
}

// A leaf whose shadow lies between all samples of the first meshes, and off the middles of their triangles: it is found
// from the sun.
TEST(Refinement, ASmallShadowIsFoundFromTheSource) {
  for (const double size : {0.3, 0.1}) {
    SceneBuilder builder;
    const std::uint32_t grey = builder.material(Color(0.5));
    builder.quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, grey);
    const Vec3 leaf(0.37, 0.21, 0.5);
    builder.quad(leaf - Vec3(size, size, 0) / 2.0, leaf + Vec3(size, -size, 0) / 2.0, leaf + Vec3(size, size, 0) / 2.0,
                 leaf + Vec3(-size, size, 0) / 2.0, grey);
    Light sun;
    sun.type = LightType::directional;
    sun.direction = {0, 0, -1};
    sun.color = Color(1.0);
    builder.scene.lights = {sun};
    BakeOptions options = refining(0.01, 1.0);
    options.disable = Disable::indirect;
    TestBake bake(builder.take(), options);
    bake.run();
    const auto samples = (*bake).surface().samples();
    std::size_t dark = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Vec3& at = samples[i].point;
      const bool under = std::max(std::abs(at.x - leaf.x), std::abs(at.y - leaf.y)) < size / 2 - 1e-6;
      dark += at.z == 0 && under ? 1 : 0;
    }
    EXPECT_GE(dark, 4u) << size;
  }
}

// A spot's small disk of light on a floor of some twenty thousand samples: so few sites rise that they do so twice.
Scene floor_under_a_spot() {
  SceneBuilder builder;
  const std::uint32_t black = builder.material(Color(0.0));
  builder.quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, black);
  Light spot;
  spot.type = LightType::spot;
  spot.position = {0, 0, 1};
  spot.direction = {0, 0, -1};
  spot.color = Color(1.0);
  spot.outer_angle = 0.03f;
  spot.inner_angle = 0.02f;
  builder.scene.lights = {spot};
  return builder.take();
}

TEST(Slices, FewSitesThatRiseTwiceEndTheSame) {
  for (const std::uint32_t most : {0u, 21'500u}) {
    BakeOptions options = refining(0.1, 0.06);
    options.spacing.max_sites = most;
    TestBake whole(floor_under_a_spot(), options, 1), sliced(floor_under_a_spot(), options, 3);
    ASSERT_EQ(whole.run(), BakeStatus::converged);
    ASSERT_EQ(sliced.run(1e-4), BakeStatus::converged);
    const Surface &surface = (*whole).surface(), &other = (*sliced).surface();
    ASSERT_EQ(surface.sites().size(), other.sites().size());
    ASSERT_EQ(surface.samples().size(), other.samples().size());
    for (std::size_t i = 0; i < surface.samples().size(); ++i) {
      EXPECT_EQ((*whole).direct()[i], (*sliced).direct()[i]);
    }
    std::size_t finest = 0;
    for (std::uint32_t site = 0; site < surface.sites().size(); ++site) {
      EXPECT_EQ(surface.sites()[site].position, other.sites()[site].position);
      finest += surface.level_of(site) == surface.max_level();
    }
    if (most == 0) {
      EXPECT_GT(finest, 20u);
    } else {
      EXPECT_LE(surface.sites().size(), most);
    }
    // Neighbours' levels differ by one at most, however many rise at once.
    for (std::uint32_t facet = 0; facet < (*whole).facets().facets.size(); ++facet) {
      for (const ShareTriangle& triangle : surface.triangles(facet)) {
        const auto level = [&](std::size_t k) {
          return static_cast<int>(surface.level_of(surface.samples()[surface.shares()[triangle[k]].sample].site));
        };
        EXPECT_LE(std::max({level(0), level(1), level(2)}), std::min({level(0), level(1), level(2)}) + 1);
      }
    }
  }
}

}  // namespace
}  // namespace radvor
