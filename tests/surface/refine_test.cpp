// Refinement: nested, balanced, independent of order, and everything stays true.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "base/error.h"
#include "surface/made_surface.h"
#include "surface/refined_scenes.h"

namespace radvor {
namespace {

using test::expect_true;
using test::floor_of_one;
using test::k_scenes;
using test::l_shaped;
using test::MadeSurface;
using test::Make;
using test::options;
using test::positions;
using test::ring;
using test::room;
using test::slit_floor;
using test::smooth_cylinder;
using test::some_sites;

constexpr Lattice k_both[] = {Lattice::hexagonal, Lattice::quadrilateral};

using Point = std::array<double, 3>;

std::vector<std::uint32_t> all_below(const Surface& surface, std::uint32_t level) {
  std::vector<std::uint32_t> sites;
  for (std::uint32_t site = 0; site < surface.sites().size(); ++site) {
    if (surface.level_of(site) < level) {
      sites.push_back(site);
    }
  }
  return sites;
}

TEST(Refine, EverythingRaisedIsTheUniformMeshOfThatLevel) {
  for (const Lattice lattice : k_both) {
    for (const Make make : k_scenes) {
      for (const double spacing : {0.31, 0.9, 2.7}) {
        MadeSurface made(make(), options(spacing, 2, lattice));
        for (std::uint32_t level = 1; level <= 2; ++level) {
          std::vector<std::uint32_t> sites;
          while (!(sites = all_below(made.surface, level)).empty()) {
            made.surface.refine(sites);
          }
          const MadeSurface uniform(make(), options(spacing, 0, lattice, level));
          const auto now = positions(made.surface);
          const auto expected = positions(uniform.surface);
          std::vector<Point> missing, extra;
          std::set_difference(expected.begin(), expected.end(), now.begin(), now.end(), std::back_inserter(missing));
          std::set_difference(now.begin(), now.end(), expected.begin(), expected.end(), std::back_inserter(extra));
          EXPECT_TRUE(missing.empty() && extra.empty())
              << testing::PrintToString(missing) << " missing, " << testing::PrintToString(extra) << " extra, scene "
              << (std::find(std::begin(k_scenes), std::end(k_scenes), make) - k_scenes) << ", spacing " << spacing
              << ", level " << level;
          expect_true(made);
        }
      }
    }
  }
}

// A site's index is not the same in two surfaces: wishes name positions.
struct Wish {
  Point position;
  std::uint32_t level;
};

std::uint32_t site_at(const Surface& surface, const Point& point) {
  for (std::uint32_t site = 0; site < surface.sites().size(); ++site) {
    const Vec3& p = surface.sites()[site].position;
    if (p.x == point[0] && p.y == point[1] && p.z == point[2]) {
      return site;
    }
  }
  return k_none;
}

// Until all wishes are met that can be: a site may come to be through another wish.
void grant(Surface& surface, const std::vector<Wish>& wishes, std::size_t batch) {
  for (bool more = true; more;) {
    more = false;
    std::vector<std::uint32_t> sites;
    for (const Wish& wish : wishes) {
      const std::uint32_t site = site_at(surface, wish.position);
      if (site != k_none && surface.level_of(site) < wish.level) {
        sites.push_back(site);
        more = true;
      }
      if (sites.size() == batch) {
        surface.refine(sites);
        sites.clear();
      }
    }
    surface.refine(sites);
  }
}

std::vector<std::pair<Point, std::uint32_t>> levels(const Surface& surface) {
  std::vector<std::pair<Point, std::uint32_t>> found;
  for (std::uint32_t site = 0; site < surface.sites().size(); ++site) {
    const Vec3& p = surface.sites()[site].position;
    found.push_back({{p.x, p.y, p.z}, surface.level_of(site)});
  }
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Refine, SitesDependOnWhatWasRaisedNotOnTheOrder) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const Make make = k_scenes[static_cast<std::size_t>(trial) % std::size(k_scenes)];
    const Lattice lattice = trial % 4 < 2 ? Lattice::hexagonal : Lattice::quadrilateral;
    const double spacing = std::uniform_real_distribution<double>(0.3, 2.0)(random);
    // Wishes that can be met: what random refinement of one surface came to.
    std::vector<Wish> wishes;
    {
      MadeSurface scout(make(), options(spacing, 4, lattice));
      for (int round = 0; round < 6; ++round) {
        std::vector<std::uint32_t> sites;
        for (int k = 0; k < 3; ++k) {
          // Mostly where it is fine already.
          const auto count = static_cast<std::uint32_t>(scout.surface.sites().size());
          const std::uint32_t site = round == 0 ? static_cast<std::uint32_t>(random()) % count
                                                : count - 1 - static_cast<std::uint32_t>(random()) % (count / 4 + 1);
          sites.push_back(site);
          const Vec3& p = scout.surface.sites()[site].position;
          wishes.push_back({{p.x, p.y, p.z}, std::min(scout.surface.level_of(site) + 1, 4u)});
        }
        scout.surface.refine(sites);
      }
      expect_true(scout);
    }
    std::vector<std::pair<Point, std::uint32_t>> first;
    for (int order = 0; order < 4; ++order) {
      std::shuffle(wishes.begin(), wishes.end(), random);
      MadeSurface made(make(), options(spacing, 4, lattice));
      grant(made.surface, wishes, 1 + static_cast<std::size_t>(random()) % 4);
      const auto now = levels(made.surface);
      if (order == 0) {
        first = now;
        expect_true(made);
        if (make == room || make == l_shaped || make == smooth_cylinder || make == ring) {
          EXPECT_EQ(test::unmatched_edges(made), 0u);
        }
      }
      EXPECT_TRUE(now == first) << "trial " << trial << ": " << now.size() << " and " << first.size() << " sites";
    }
  }
}

TEST(Refine, LightThatIsLinearOnEveryFacetStaysAsItWas) {
  // What the light is at a receiver: linear in space, and another one on each facet's back.
  const auto light = [](const Vec3& p, const Vec3& normal) {
    return glm::dot(p, Vec3(0.3, -0.7, 0.45)) + 0.2 * glm::dot(normal, Vec3(1, 2, 3));
  };
  std::mt19937 random(4);
  for (const Make make : {room, l_shaped, slit_floor, floor_of_one}) {  // sharp edges alone
    for (const Lattice lattice : k_both) {
      MadeSurface made(make(), options(0.8, 3, lattice));
      std::vector<double> lit;  // at the sites themselves: edges are sharp, a sample is one facet's
      const auto at_site = [&](const Sample& sample) {
        return light(made.surface.sites()[sample.site].position, sample.facet_normal);
      };
      for (const Sample& sample : made.surface.samples()) {
        lit.push_back(at_site(sample));
      }
      for (int round = 0; round < 4; ++round) {
        const std::vector<Site> sites(made.surface.sites().begin(), made.surface.sites().end());
        const std::vector<Sample> samples(made.surface.samples().begin(), made.surface.samples().end());
        const auto origins = made.surface.refine(some_sites(made.surface, 5, random));
        ASSERT_EQ(origins.size(), made.surface.samples().size());
        std::vector<double> now;
        std::set<std::uint32_t> kept;
        for (std::size_t k = 0; k < origins.size(); ++k) {
          const Sample& sample = made.surface.samples()[k];
          const SampleOrigin& origin = origins[k];
          EXPECT_EQ(origin.kept, sample.site < sites.size());
          if (origin.kept) {
            const Sample& old = samples[origin.samples[0]];
            EXPECT_EQ(old.site, sample.site);
            EXPECT_EQ(old.facet_normal, sample.facet_normal);
            EXPECT_TRUE(kept.insert(origin.samples[0]).second);
            // On a slit the sides are told apart by where they look from.
            EXPECT_GT(glm::dot(old.point - sites[old.site].position, sample.point - sites[old.site].position), -1e-12);
            EXPECT_EQ(origin.weights, (std::array<float, 3>{1, 0, 0}));
            now.push_back(lit[origin.samples[0]]);
          } else {
            double sum = 0;
            double value = 0;
            for (std::size_t c = 0; c < 3; ++c) {
              EXPECT_GE(origin.weights[c], 0);
              sum += origin.weights[c];
              value += origin.weights[c] * lit[origin.samples[c]];
              EXPECT_EQ(samples[origin.samples[c]].facet, sample.facet);
            }
            EXPECT_NEAR(sum, 1, 1e-6);
            EXPECT_NEAR(value, light(sample.point, sample.facet_normal), 1e-5);
            now.push_back(at_site(sample));
          }
        }
        EXPECT_EQ(kept.size(), samples.size());
        for (std::size_t k = 0; k < sites.size(); ++k) {
          EXPECT_EQ(made.surface.sites()[k].position, sites[k].position);
        }
        lit = now;
      }
      expect_true(made);
    }
  }
}

TEST(Refine, NewSitesAreTheMidpointsOfTheirParents) {
  for (const Lattice lattice : k_both) {
    MadeSurface made(room(), options(0.9, 3, lattice), 2, test::Touching::ignored);
    std::mt19937 random(6);
    std::size_t with_parents = 0;
    for (int round = 0; round < 3; ++round) {
      made.surface.refine(some_sites(made.surface, 20, random));
    }
    for (const Site& site : made.surface.sites()) {
      ASSERT_EQ(site.parents[0] == k_none, site.parents[1] == k_none);
      if (site.parents[0] != k_none) {
        const Site& a = made.surface.sites()[site.parents[0]];
        const Site& b = made.surface.sites()[site.parents[1]];
        EXPECT_LT(glm::distance(0.5 * (a.position + b.position), site.position), 1e-14);
        EXPECT_LE(a.level, site.level);
        EXPECT_LE(b.level, site.level);
        ++with_parents;
      }
    }
    EXPECT_GT(with_parents, made.surface.sites().size() / 3);
  }
}

TEST(Refine, KeepsToTheSmallestSpacingAndTheMostSites) {
  std::mt19937 random(8);
  MadeSurface made(room(), {Lattice::hexagonal, 0.8, 0, 0.15});
  EXPECT_EQ(made.surface.max_level(), 2u);
  const auto before = positions(made.surface);
  made.surface.refine(std::vector<std::uint32_t>{0, 1, 2, 3}, static_cast<std::uint32_t>(before.size()));
  EXPECT_EQ(positions(made.surface), before);
  const std::uint32_t most = static_cast<std::uint32_t>(before.size()) + 57;
  for (int round = 0; round < 50; ++round) {
    made.surface.refine(some_sites(made.surface, 3, random), most);
    ASSERT_LE(made.surface.sites().size(), most);
  }
  EXPECT_GT(made.surface.sites().size(), before.size() + 20);
  expect_true(made);
  for (int round = 0; round < 8; ++round) {
    made.surface.refine(all_below(made.surface, 5));
  }
  EXPECT_TRUE(all_below(made.surface, 2).empty());
  EXPECT_EQ(positions(made.surface), positions(MadeSurface(room(), {Lattice::hexagonal, 0.8, 2, 0}).surface));
  EXPECT_THROW(made.surface.refine(std::vector<std::uint32_t>{1u << 30}), Error);
}

// One triangulation after several raisings is what there is after one for each; until then samples are as they were.
TEST(Refine, RaisingWithoutTrianglesComesToTheSame) {
  for (const Make make : k_scenes) {
    MadeSurface one(make(), options(0.9, 3)), each(make(), options(0.9, 3));
    const std::size_t samples = one.surface.samples().size();
    std::mt19937 random(5), same(5);
    for (int round = 0; round < 5; ++round) {
      one.surface.raise(some_sites(one.surface, 4, random));
      each.surface.refine(some_sites(each.surface, 4, same));
      EXPECT_EQ(one.surface.samples().size(), samples);
    }
    const auto origins = one.surface.refine({});
    EXPECT_EQ(origins.size(), one.surface.samples().size());
    ASSERT_GT(origins.size(), samples);
    expect_true(one);
    ASSERT_EQ(one.surface.sites().size(), each.surface.sites().size());
    for (std::uint32_t site = 0; site < one.surface.sites().size(); ++site) {
      EXPECT_EQ(one.surface.sites()[site].position, each.surface.sites()[site].position);
      EXPECT_EQ(one.surface.level_of(site), each.surface.level_of(site));
    }
    for (std::uint32_t facet = 0; facet < one.facets.facets.size(); ++facet) {
      EXPECT_TRUE(std::ranges::equal(one.surface.triangles(facet), each.surface.triangles(facet)));
    }
    EXPECT_THROW(one.surface.raise(std::vector<std::uint32_t>{1u << 30}), Error);
  }
}

TEST(Refine, SmallTrianglesGetSitesOfTheirOwn) {
  MadeSurface made(smooth_cylinder(), options(40, 8));
  const std::size_t before = made.surface.sites().size();
  std::mt19937 random(2);
  for (int round = 0; round < 12; ++round) {
    made.surface.refine(std::vector<std::uint32_t>{static_cast<std::uint32_t>(random() % before)});
    made.surface.refine(std::vector<std::uint32_t>{0, 7});
    expect_true(made);
    EXPECT_EQ(test::unmatched_edges(made), 0u);
  }
  EXPECT_EQ(made.surface.level_of(7), 8u);
  EXPECT_GT(made.surface.sites().size(), 2 * before);
}

TEST(Refine, PatchesKeepTheirCentres) {
  MadeSurface made(floor_of_one(), options(0.125, 4, Lattice::quadrilateral));
  const std::uint32_t patches = made.surface.patch_count();
  std::mt19937 random(12);
  for (int round = 0; round < 5; ++round) {
    made.surface.refine(some_sites(made.surface, 4, random));
    EXPECT_EQ(made.surface.patch_count(), 0u);
  }
  made.surface.group_patches();
  EXPECT_EQ(made.surface.patch_count(), patches);
  // A patch's sites are those nearer to its centre, its one site of level 0 that lies on the lattice, than to others.
  const auto shares = made.surface.shares();
  std::vector<Vec3> centres(patches, Vec3(1e30));
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    const Site& site = test::site_of(made.surface, s);
    if (site.level == 0 && site.edge == k_none && site.vertex == k_none) {
      EXPECT_EQ(centres[shares[s].patch].x, 1e30);
      centres[shares[s].patch] = site.position;
    }
  }
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    const Vec3& p = test::site_of(made.surface, s).position;
    for (const Vec3& centre : centres) {
      EXPECT_LE(glm::distance(p, centres[shares[s].patch]), glm::distance(p, centre) + 1e-12);
    }
  }
}

TEST(Refine, TheSameBytesForOneTwoAndThreeThreads) {
  std::vector<std::byte> first;
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    std::vector<std::byte> bytes;
    const auto put = [&](const auto& value) {
      const auto* data = reinterpret_cast<const std::byte*>(&value);
      bytes.insert(bytes.end(), data, data + sizeof value);
    };
    MadeSurface made(room(), options(0.4, 4), threads);
    std::mt19937 random(3);
    for (int round = 0; round < 4; ++round) {
      for (const SampleOrigin& origin : made.surface.refine(some_sites(made.surface, 30, random))) {
        put(origin.samples), put(origin.weights), put(origin.kept);
      }
    }
    for (const Site& site : made.surface.sites()) {
      put(site.position), put(site.level), put(site.parents);
    }
    for (const Sample& sample : made.surface.samples()) {
      put(sample.point), put(sample.normal), put(sample.area), put(sample.site), put(sample.first_share);
    }
    made.surface.group_patches();
    put(made.surface.patch_count());
    for (const Share& share : made.surface.shares()) {
      put(share.centroid), put(share.area), put(share.sample), put(share.patch), put(share.vertex);
    }
    for (std::uint32_t facet = 0; facet < made.facets.facets.size(); ++facet) {
      for (const ShareTriangle& triangle : made.surface.triangles(facet)) {
        put(triangle);
      }
    }
    if (first.empty()) {
      first = bytes;
    }
    EXPECT_TRUE(bytes == first) << threads;
  }
}

}  // namespace
}  // namespace radvor
