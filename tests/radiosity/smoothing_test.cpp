// Noise goes, what is linear stays, and nothing moves by more than noise explains.
#include "radiosity/smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "plain.h"
#include "radiosity/sample_neighbours.h"

namespace radvor {
namespace {

constexpr double k_far = 0.02;  // nearness of what is 50 away

double ramp(const Vec3& at) {
  return 3 + at.x - 0.5 * at.y;
}

class Smoothing : public testing::Test {
 protected:
  Smoothing() : bake(plain()), host(1), surface((*bake).surface()), neighbours(surface, host.host) {
    for (std::uint32_t i = 0; i < surface.samples().size(); ++i) {
      const double noise = 0.2 * (to_unit(mix(i + 1)) - 0.5);
      linear.push_back(Color(ramp(position(i))));
      noisy.push_back(linear.back() + noise);
    }
  }

  const Vec3& position(std::uint32_t sample) const { return surface.sites()[surface.samples()[sample].site].position; }

  double rms(std::span<const Color> values) const {
    double squares = 0;
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      squares += (values[i].g - linear[i].g) * (values[i].g - linear[i].g);
    }
    return std::sqrt(squares / static_cast<double>(values.size()));
  }

  void smooth(const std::vector<Certainty>& certain, std::vector<Color>& values) {
    Pace pace(&host.host.memory);
    radvor::smooth(surface, neighbours, certain, values, host.host, pace).finish();
  }

  std::vector<Color> smoothed(std::vector<Color> values, const Certainty& certainty) {
    smooth(std::vector<Certainty>(values.size(), certainty), values);
    return values;
  }

  TestBake bake;
  TestHost host;
  const Surface& surface;
  const SampleNeighbours neighbours;
  std::vector<Color> linear, noisy;
};

TEST_F(Smoothing, KeepsWhatIsLinear) {
  EXPECT_GT(linear.size(), 400u);
  EXPECT_LT(rms(smoothed(linear, {0.02, k_far})), 1e-12);
}

TEST_F(Smoothing, TakesTwoThirdsOfTheNoise) {
  EXPECT_LT(rms(smoothed(noisy, {0.02, k_far})), rms(noisy) / 3);
}

TEST_F(Smoothing, LeavesAStepThatNoiseDoesNotExplain) {
  std::vector<Color> before;
  for (const Sample& sample : surface.samples()) {
    before.push_back(Color(sample.point.x < 0 ? 1.0 : 5.0));
  }
  const std::vector<Color> after = smoothed(before, {0.001, k_far});
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(after[i].g, before[i].g, 1e-12);
  }
}

TEST_F(Smoothing, NothingMovesFartherThanNoiseExplains) {
  for (const double noise : {0.001, 0.003}) {
    const std::vector<Color> after = smoothed(noisy, {noise, k_far});
    for (std::size_t i = 0; i < after.size(); ++i) {
      const double larger = std::max(after[i].g, noisy[i].g);
      EXPECT_LE(std::abs(after[i].g - noisy[i].g), 3 * 3.6 * noise * larger);
    }
    EXPECT_NE(after, noisy);
  }
}

TEST_F(Smoothing, LeavesWhatIsSettledOrCertainOrFarFromLinear) {
  EXPECT_EQ(smoothed(noisy, {.noise = 0.02, .nearness = k_far, .settled = true}), noisy);
  EXPECT_EQ(smoothed(noisy, {0, k_far}), noisy);
  const std::vector<Color> near_by = smoothed(noisy, {0.02, 1000});
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    EXPECT_NEAR(near_by[i].g, noisy[i].g, 1e-6);
  }
}

TEST_F(Smoothing, GoesOnBesideOtherSurfacesWhereTheMeshFollowedTheLight) {
  const double kept = rms(smoothed(noisy, {.noise = 0.02, .nearness = 1000}));
  EXPECT_NEAR(kept, rms(noisy), 1e-6);
  EXPECT_LT(rms(smoothed(noisy, {.noise = 0.02, .nearness = 1000, .most_bend = 0.03})), kept / 2);
}

TEST_F(Smoothing, LeavesHuesThatNoiseDoesNotExplain) {
  std::vector<Color> before;
  for (const Sample& sample : surface.samples()) {
    before.push_back(sample.point.x < 0 ? Color(2, 0.5, 0.5) : Color(0, 1.5, 1.5));
  }
  const std::vector<Color> after = smoothed(before, {0.01, k_far});
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_NEAR(after[i].r, before[i].r, 1e-12);
  }
}

// Rays that all missed a lamp make its light 0 without a doubt, and one that met it too much.
TEST_F(Smoothing, WhatRaysMissedNeighboursKnow) {
  std::vector<Color> values;
  std::vector<Certainty> certain;
  for (std::uint32_t i = 0; i < linear.size(); ++i) {
    const bool met = to_unit(mix(i + 1)) < 0.25;
    values.push_back(met ? 4.0 * linear[i] : Color(0.0));
    certain.push_back({met ? 2.0 : 0.0, k_far});
  }
  const std::vector<Color> before = values;
  smooth(certain, values);
  EXPECT_LT(rms(values), rms(before) / 3);
  double sum_after = 0, sum_before = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum_after += values[i].g;
    sum_before += before[i].g;
  }
  EXPECT_NEAR(sum_after / sum_before, 1, 0.05);
}

TEST(SampleNeighbours, AreOfBothEndsAndReachAcrossSmoothEdges) {
  // A roof whose two halves are one smooth surface.
  SceneBuilder builder;
  const std::uint32_t white = builder.material(Color(0.5));
  builder.quad({-1, -1, 0}, {0, -1, 0.1}, {0, 1, 0.1}, {-1, 1, 0}, white);
  builder.quad({0, -1, 0.1}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0.1}, white);
  BakeOptions options;
  options.spacing.patch_spacing = 0.2;
  options.spacing.element_levels = 0;
  TestBake bake(builder.take(), options, 1);
  TestHost host(1);
  const Surface& surface = (*bake).surface();
  const SampleNeighbours neighbours(surface, host.host);
  std::size_t with_both = 0;
  for (std::uint32_t i = 0; i < surface.samples().size(); ++i) {
    bool left = false, right = false;
    const auto around = neighbours.of(i);
    for (const Neighbour& neighbour : around) {
      const auto back = neighbours.of(neighbour.sample);
      const auto known = std::find_if(back.begin(), back.end(), [&](const Neighbour& of) { return of.sample == i; });
      ASSERT_NE(known, back.end());
      EXPECT_EQ(known->triangles, neighbour.triangles);
      EXPECT_TRUE(neighbour.triangles == 1 || neighbour.triangles == 2);
      left = left || surface.sites()[surface.samples()[neighbour.sample].site].position.x < -1e-9;
      right = right || surface.sites()[surface.samples()[neighbour.sample].site].position.x > 1e-9;
    }
    EXPECT_GE(around.size(), 2u);
    EXPECT_TRUE(std::is_sorted(around.begin(), around.end(),
                               [](const Neighbour& a, const Neighbour& b) { return a.sample <= b.sample; }));
    with_both += left && right ? 1 : 0;
  }
  EXPECT_GT(with_both, 8u);
}

}  // namespace
}  // namespace radvor
