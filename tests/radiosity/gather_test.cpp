// Links follow the mesh: refined later or before, the same rays end at the same shares.
#include "radiosity/gather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "surface/made_surface.h"
#include "surface/solids.h"
#include "visibility/brute_force_visibility.h"

namespace radvor {
namespace {

constexpr std::uint64_t k_seed = 7;
constexpr std::uint32_t k_rays = 256;

Scene room_with_floating_box() {
  test::SceneBuilder builder(std::pmr::get_default_resource());
  const std::uint32_t both = builder.add_material({Color(0.5), Color(0.0), true});
  builder.box({0, 0, 0}, {2, 2, 1}, true);
  builder.box({0.7, 0.8, 0.3}, {1.2, 1.3, 0.6}, false);
  builder.quad({0.3, 0.3, 0.4}, {0.6, 0.3, 0.4}, {0.6, 0.6, 0.4}, {0.3, 0.6, 0.4}, both);
  return builder.take();
}

class Links : public testing::Test {
 protected:
  Links()
      : made(room_with_floating_box(), options()),
        occluders(made.welded.triangles.size()),
        gather(made.scene, made.facets, occluders, made.host) {
    std::iota(occluders.begin(), occluders.end(), 0u);
    for (const Triangle& triangle : made.welded.triangles) {
      corners.insert(corners.end(), triangle.vertices.begin(), triangle.vertices.end());
    }
    visibility.emplace(Occluders{made.welded.positions, corners}, std::pmr::get_default_resource());
    for (const Vec3& at : {Vec3(0.31, 0.37, 0), Vec3(1.83, 1.71, 0), Vec3(0.95, 1.05, 0), Vec3(0.45, 0.45, 0)}) {
      receivers.push_back({at, at + Vec3(0, 0, visibility->lift()), Vec3(0, 0, 1)});
    }
  }

  static SurfaceOptions options() {
    SurfaceOptions options;
    options.patch_spacing = 0.5;
    options.min_spacing = 0.05;
    return options;
  }

  void trace(std::uint32_t first_record) {
    ASSERT_EQ(gather.add(static_cast<std::uint32_t>(receivers.size())), first_record);
    Tracer tracer(*visibility);
    for (std::uint32_t r = 0; r < receivers.size(); ++r) {
      gather.trace(first_record + r, receivers[r], k_rays, k_seed + r, made.surface, tracer);
    }
  }

  void refine(const Vec3& around, double reach) {
    const SharesBefore before(made.surface, made.host);
    std::vector<std::uint32_t> raised;
    for (std::uint32_t s = 0; s < made.surface.sites().size(); ++s) {
      if (glm::distance(made.surface.sites()[s].position, around) < reach) {
        raised.push_back(s);
      }
    }
    const auto origins = made.surface.refine(raised, 0);
    std::vector<std::uint32_t> now(before.sites.size(), k_none);
    for (std::uint32_t i = 0; i < origins.size(); ++i) {
      if (origins[i].kept) {
        now[origins[i].samples[0]] = i;
      }
    }
    const ShareChanges changes = follow_shares(before, now, made.surface, made.host);
    gather.follow(changes);
  }

  // What a record gathers of shares that shoot: green and blue numbers of no pattern, red nothing from the first sites.
  Color gathered(std::uint32_t record, std::size_t first_sites) {
    while (!gather.catch_up(made.surface, 2 * k_rays)) {
    }
    std::vector<glm::vec3> radiosity;
    for (std::uint32_t s = 0; s < made.surface.shares().size(); ++s) {
      const bool is_new = made.surface.samples()[made.surface.shares()[s].sample].site >= first_sites;
      radiosity.emplace_back(is_new, to_unit(mix(2 * s)), to_unit(mix(2 * s + 1)));
    }
    return gather.gather(record, radiosity);
  }

  test::MadeSurface made;
  std::pmr::vector<std::uint32_t> occluders, corners;
  std::optional<BruteForceVisibility> visibility;
  Gather gather;
  std::vector<Receiver> receivers;
};

TEST_F(Links, FollowAMeshThatIsRefinedLater) {
  trace(0);
  const auto first = static_cast<std::uint32_t>(receivers.size());
  const std::size_t sites_before = made.surface.sites().size();
  refine({1, 1, 1}, 0.8);
  refine({1, 1, 1}, 0.4);
  refine({0.45, 0.45, 0.4}, 0.3);
  ASSERT_GT(made.surface.sites().size(), sites_before + sites_before / 2);
  trace(first);
  for (std::uint32_t r = 0; r < receivers.size(); ++r) {
    const Color followed = gathered(r, sites_before), fresh = gathered(first + r, sites_before);
    EXPECT_GT(fresh.r, 0.1) << "receiver " << r;
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_DOUBLE_EQ(followed[channel], fresh[channel]) << "receiver " << r;
    }
  }
}

// The floor is refined, which no receiver on it sees: all numbers change, no link does.
TEST_F(Links, StayWhereNothingIsDivided) {
  const auto gathered_by_place = [&](std::uint32_t record) {
    std::vector<glm::vec3> radiosity;
    for (const Share& share : made.surface.shares()) {
      const std::uint64_t site = made.surface.samples()[share.sample].site;
      radiosity.emplace_back(to_unit(mix(site << 20 | std::uint64_t{share.facet} << 1 | (share.back ? 1 : 0))));
    }
    return gather.gather(record, radiosity);
  };
  trace(0);
  const std::size_t shares_before = made.surface.shares().size();
  std::vector<Color> before;
  for (std::uint32_t r = 0; r < receivers.size(); ++r) {
    before.push_back(gathered_by_place(r));
  }
  refine({1, 0.5, 0}, 0.25);
  EXPECT_FALSE(gather.catch_up(made.surface, 2 * k_rays));  // a unit of work at a time
  while (!gather.catch_up(made.surface, 2 * k_rays)) {
  }
  ASSERT_GT(made.surface.shares().size(), shares_before);
  for (std::uint32_t r = 0; r < receivers.size(); ++r) {
    EXPECT_EQ(gathered_by_place(r), before[r]) << "receiver " << r;
  }
}

// Bounces that matter less read fewer of a record's links.
TEST_F(Links, TheFirstOnesAreThoseOfFewerRays) {
  trace(0);
  constexpr std::uint32_t k_fewer = 32;
  const std::uint32_t first = gather.add(static_cast<std::uint32_t>(receivers.size()));
  Tracer tracer(*visibility);
  std::vector<glm::vec3> radiosity;
  for (std::uint32_t s = 0; s < made.surface.shares().size(); ++s) {
    radiosity.emplace_back(to_unit(mix(s)));
  }
  for (std::uint32_t r = 0; r < receivers.size(); ++r) {
    gather.trace(first + r, receivers[r], k_fewer, k_seed + r, made.surface, tracer);
    EXPECT_EQ(gather.gather(r, radiosity, k_fewer), gather.gather(first + r, radiosity)) << "receiver " << r;
    EXPECT_NE(gather.gather(r, radiosity, k_fewer), gather.gather(r, radiosity)) << "receiver " << r;
  }
}

// Where a ray brings 1 or nothing.
TEST_F(Links, SpreadIsThatOfABernoulliTrial) {
  trace(0);
  std::vector<glm::vec3> all(made.surface.shares().size(), glm::vec3(1)), some = all, none(all.size(), glm::vec3(0));
  for (std::uint32_t s = 0; s < some.size(); ++s) {
    some[s] = glm::vec3(to_unit(mix(s)) < 0.2);
  }
  for (std::uint32_t r = 0; r < receivers.size(); ++r) {
    EXPECT_NEAR(gather.spread(r, all), 0, 1e-6);
    EXPECT_EQ(gather.spread(r, none), 0);
    const double part = gather.gather(r, some).g;
    ASSERT_GT(part, 0);
    EXPECT_NEAR(gather.spread(r, some), std::sqrt((1 - part) / part), 1e-9);
  }
}

}  // namespace
}  // namespace radvor
