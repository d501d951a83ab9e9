// The most sites there may be: what would lead beyond leaves nothing behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor {
namespace {

using test::MadeSurface;
using test::positions;
using test::room;
using test::unit_floor;

// Where a limit is met and lifted again, what was undone there is asked for as if for the first time.
TEST(SiteLimit, WhatRaisingTookBackComesWhenItIsLifted) {
  constexpr std::uint32_t k_site = 0;
  constexpr std::uint32_t k_levels = 4;
  const SurfaceOptions deep{Lattice::hexagonal, 0.9, 0, std::ldexp(0.9, -static_cast<int>(k_levels))};
  MadeSurface free(room(), deep);
  const auto first = static_cast<std::uint32_t>(free.surface.sites().size());
  for (std::uint32_t round = 0; round < k_levels; ++round) {
    free.surface.refine(std::array{k_site});
  }
  const auto all = static_cast<std::uint32_t>(free.surface.sites().size());
  std::uint32_t met = 0;
  for (std::uint32_t most = first + 1; most < all; most += (all - first) / 20 + 1) {
    MadeSurface made(room(), deep);
    while (made.surface.level_of(k_site) < k_levels) {
      const std::uint32_t before = made.surface.level_of(k_site);
      made.surface.refine(std::array{k_site}, most);
      if (made.surface.level_of(k_site) == before) {
        ++met;
        made.surface.refine(std::array{k_site});
      }
    }
    EXPECT_EQ(positions(made.surface), positions(free.surface)) << most;
    test::audit(made);
    test::audit_cells(made);
    test::expect_balanced(made);
  }
  EXPECT_GT(met, 10u);
}

// One that would lead beyond the limit leaves nothing behind: when there is room it comes as if for the first time.
TEST(SiteLimit, AWishThatItTookBackComesWhenItIsLifted) {
  const SurfaceOptions options{Lattice::hexagonal, 0.125, 0, 0.125 / 16};
  const auto refine_about_a_point = [](const MadeSurface& made) {
    for (std::uint32_t level = 0; level < 4; ++level) {
      std::vector<std::uint32_t> sites;
      for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
        if (made.surface.level_of(site) == level &&
            glm::distance(made.surface.sites()[site].position, Vec3(0.4, 0.45, 0)) <
                std::ldexp(0.125, -static_cast<int>(level))) {
          sites.push_back(site);
        }
      }
      made.surface.refine(sites);
    }
  };
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  int met = 0;
  for (int k = 0; k < 60; ++k) {
    const double x = 0.4 + uniform(random), y = 0.45 + uniform(random);
    const std::array wanted = {WantedSite{0, Vec3(x, y, 0)}};
    const MadeSurface free(unit_floor(), options), limited(unit_floor(), options);
    refine_about_a_point(free);
    refine_about_a_point(limited);
    const auto before = static_cast<std::uint32_t>(free.surface.sites().size());
    free.surface.refine({}, 0, wanted);
    if (free.surface.sites().size() < before + 2) {
      continue;
    }
    ++met;
    limited.surface.refine({}, before + 1, wanted);
    EXPECT_EQ(limited.surface.sites().size(), before);
    limited.surface.refine({}, 0, wanted);
    ASSERT_EQ(limited.surface.sites().size(), free.surface.sites().size());
    for (std::uint32_t site = 0; site < free.surface.sites().size(); ++site) {
      EXPECT_EQ(limited.surface.sites()[site].position, free.surface.sites()[site].position);
      EXPECT_EQ(limited.surface.level_of(site), free.surface.level_of(site));
    }
    test::expect_balanced(limited);
  }
  EXPECT_GT(met, 5);
}

// Nor does it keep others away: the lattice about it is as if it had never been.
TEST(SiteLimit, AWishThatItTookBackKeepsNothingAway) {
  const SurfaceOptions options{Lattice::hexagonal, 0.125, 0, 0.125 / 16};
  const auto raise_near = [](const MadeSurface& made, const Vec3& point, double reach, std::uint32_t levels) {
    for (std::uint32_t level = 0; level < levels; ++level) {
      std::vector<std::uint32_t> sites;
      for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
        if (made.surface.level_of(site) == level && glm::distance(made.surface.sites()[site].position, point) < reach) {
          sites.push_back(site);
        }
      }
      made.surface.refine(sites);
    }
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.3, 0.6);
  int met = 0;
  for (int k = 0; k < 60; ++k) {
    const double x = uniform(random), y = uniform(random);
    const Vec3 point(x, y, 0);
    for (const double beside : {0.02, 0.03, 0.04, 0.05, 0.06}) {
      const MadeSurface limited(unit_floor(), options);
      raise_near(limited, point, 0.02, 4);
      const auto before = static_cast<std::uint32_t>(limited.surface.sites().size());
      const std::array wanted = {WantedSite{0, point + Vec3(beside, 0, 0)}};
      limited.surface.refine({}, before + 1, wanted);
      if (limited.surface.sites().size() != before) {
        continue;  // there was room for all that it asked for
      }
      ++met;
      raise_near(limited, point, 0.1, 4);
      const MadeSurface untouched(unit_floor(), options);
      raise_near(untouched, point, 0.02, 4);
      raise_near(untouched, point, 0.1, 4);
      EXPECT_EQ(positions(limited.surface), positions(untouched.surface)) << k << ' ' << beside;
    }
  }
  EXPECT_GT(met, 5);
}

}  // namespace
}  // namespace radvor
