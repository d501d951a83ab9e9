// The real scenes: all of them become surfaces; what is made of them, and in what time.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>

#include "scene/audit.h"
#include "scene/obj_scene.h"
#include "surface/made_surface.h"
#include "surface/spacing.h"

namespace radvor {
namespace {

class RealScene : public testing::TestWithParam<const char*> {};

TEST_P(RealScene, BecomesASurface) {
  auto scene = test::real_scene(GetParam(), std::pmr::get_default_resource());
  if (!scene) {
    GTEST_SKIP() << "no " << RADVOR_SHARED_DIR << "/scenes/" << GetParam();
  }
  test::MadeFacets made(std::move(*scene));
  auto& [host, given, welded, facets] = made;
  const SurfaceOptions options = choose_spacing(given, welded, facets, {});
  const std::clock_t contacts_start = std::clock();
  made.add_contacts(ContactLimits::at_spacing(finest_spacing(options)));
  const double contact_seconds = static_cast<double>(std::clock() - contacts_start) / CLOCKS_PER_SEC;
  EXPECT_LT(contact_seconds, 30) << "not in proportion to the size";  // at most 1 s in a release build
  EXPECT_EQ(test::audit(welded), "");
  EXPECT_EQ(test::audit(welded, facets), "");
  const std::uint64_t before = host.memory.live_bytes();
  const auto start = std::chrono::steady_clock::now();
  Surface surface(given, welded, facets, options, host);
  surface.group_patches();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf(
      "%s: %zu triangles, %zu facets, %zu contacts in %.3f s, spacing %.4g / 2^%u: %zu sites, %zu samples, %zu shares, "
      "%u patches, %u "
      "triangles, "
      "%.3f s, %.0f MB, peak %.0f MB\n",
      GetParam(), welded.triangles.size(), facets.facets.size(), facets.contacts.edges.size(), contact_seconds,
      options.patch_spacing, options.element_levels, surface.sites().size(), surface.samples().size(),
      surface.shares().size(), surface.patch_count(), surface.triangle_count(), seconds,
      1e-6 * static_cast<double>(host.memory.live_bytes() - before),
      1e-6 * static_cast<double>(host.memory.peak_bytes()));
  EXPECT_GT(surface.patch_count(), 500u);
  EXPECT_LT(surface.patch_count(), 6000u);
  double area = 0;
  for (const Share& share : surface.shares()) {
    area += share.area;
  }
  double expected = 0;
  for (const Facet& facet : facets.facets) {
    expected += facet.area;
  }
  EXPECT_NEAR(area, expected, 1e-6 * expected);
}

bool is_contact(const WeldedScene& welded, std::uint32_t edge) {
  return welded.uses_by_triangle[welded.uses_at_edge(edge).front()].side == k_no_side;
}

// Edges of the surface's triangles that are met from one side alone, and are no piece of an edge of the input that is
// met from one side alone: what T-vertices and gaps would be.
std::size_t torn_edges(const Surface& surface, const WeldedScene& welded, std::size_t facets) {
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (std::uint32_t facet = 0; facet < facets; ++facet) {
    for (const ShareTriangle& triangle : surface.triangles(facet)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto site = [&](std::size_t corner) {
          return surface.samples()[surface.shares()[triangle[corner]].sample].site;
        };
        const std::uint32_t a = site(k);
        const std::uint32_t b = site((k + 1) % 3);
        sides.push_back({std::min(a, b), std::max(a, b)});
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> edge_between;  // welded vertices
  for (std::uint32_t edge = 0; edge < welded.edges.size(); ++edge) {
    const Edge& ends = welded.edges[edge];
    edge_between[{std::min(ends.a, ends.b), std::max(ends.a, ends.b)}] = edge;
  }
  const auto lies_on = [&](const Site& site, std::uint32_t edge) {
    return site.edge == edge ||
           (site.vertex != k_none && (welded.edges[edge].a == site.vertex || welded.edges[edge].b == site.vertex));
  };
  std::size_t torn = 0;
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t end = first;
    while (end < sides.size() && sides[end] == sides[first]) {
      ++end;
    }
    if (end - first == 1) {
      const Site& a = surface.sites()[sides[first][0]];
      const Site& b = surface.sites()[sides[first][1]];
      std::uint32_t edge = a.edge != k_none ? a.edge : b.edge;
      if (edge == k_none && a.vertex != k_none && b.vertex != k_none) {
        const auto found = edge_between.find({std::min(a.vertex, b.vertex), std::max(a.vertex, b.vertex)});
        edge = found == edge_between.end() ? k_none : found->second;
      }
      torn += edge == k_none || !lies_on(a, edge) || !lies_on(b, edge) || welded.uses_at_edge(edge).size() % 2 == 0 ||
              is_contact(welded, edge);
    }
    first = end;
  }
  return torn;
}

std::vector<double> areas_of_facets(const Surface& surface, std::size_t facets) {
  std::vector<double> areas(facets, 0.0);
  for (const Share& share : surface.shares()) {
    areas[share.facet] += share.back ? 0 : share.area;
  }
  return areas;
}

// As along a shadow's edge: what a plane through the middle crosses is raised to the smallest spacing.
TEST_P(RealScene, IsRefinedAlongAPlane) {
  auto scene = test::real_scene(GetParam(), std::pmr::get_default_resource());
  if (!scene) {
    GTEST_SKIP() << "no " << RADVOR_SHARED_DIR << "/scenes/" << GetParam();
  }
  test::MadeFacets made(std::move(*scene));
  auto& [host, given, welded, facets] = made;
  SpacingRequest request;
  request.refines = true;
  const SurfaceOptions options = choose_spacing(given, welded, facets, request);
  made.add_contacts(ContactLimits::at_spacing(finest_spacing(options)));
  Surface surface(given, welded, facets, options, host);
  const std::size_t before = surface.sites().size();
  const std::vector<double> areas_before = areas_of_facets(surface, facets.facets.size());
  EXPECT_EQ(torn_edges(surface, welded, facets.facets.size()), 0u);
  const Vec3 middle = 0.5 * (welded.low + welded.high);
  const Vec3 across = glm::normalize(Vec3(1, 0.37, 0.21));
  const auto start = std::chrono::steady_clock::now();
  for (std::uint32_t level = 0; level < surface.max_level(); ++level) {
    const double near = std::ldexp(options.patch_spacing, -static_cast<int>(level));
    std::vector<std::uint32_t> sites;
    for (std::uint32_t site = 0; site < surface.sites().size(); ++site) {
      if (surface.level_of(site) == level &&
          std::abs(glm::dot(surface.sites()[site].position - middle, across)) < near) {
        sites.push_back(site);
      }
    }
    const std::size_t samples = surface.samples().size();
    std::vector<std::uint32_t> kept(samples, 0);
    for (const SampleOrigin& origin : surface.refine(sites)) {
      ASSERT_LT(*std::max_element(origin.samples.begin(), origin.samples.end()), samples);
      kept[origin.samples[0]] += origin.kept ? 1 : 0;
    }
    EXPECT_EQ(std::count(kept.begin(), kept.end(), 1u), static_cast<std::ptrdiff_t>(samples));
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::size_t unbalanced = 0;
  for (std::uint32_t facet = 0; facet < facets.facets.size(); ++facet) {
    for (const ShareTriangle& triangle : surface.triangles(facet)) {
      std::array<std::uint32_t, 3> levels;
      for (std::size_t k = 0; k < 3; ++k) {
        levels[k] = surface.level_of(surface.samples()[surface.shares()[triangle[k]].sample].site);
      }
      unbalanced += std::max({levels[0], levels[1], levels[2]}) - std::min({levels[0], levels[1], levels[2]}) > 1;
    }
  }
  std::printf("%s: %zu sites, then %zu in %.3f s\n", GetParam(), before, surface.sites().size(), seconds);
  EXPECT_GT(surface.sites().size(), before);
  EXPECT_EQ(torn_edges(surface, welded, facets.facets.size()), 0u);
  const std::vector<double> areas = areas_of_facets(surface, facets.facets.size());
  for (std::uint32_t facet = 0; facet < facets.facets.size(); ++facet) {
    EXPECT_NEAR(areas[facet], areas_before[facet], 1e-11 * areas_before[facet] + 1e-14) << facet;
  }
  EXPECT_EQ(unbalanced, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, RealScene,
                         testing::Values("cornell", "cornell-defective", "kenney-fps", "gazebo", "navtest", "dungeon",
                                         "lq-e3m4", "living-room", "staircase"));

}  // namespace
}  // namespace radvor
