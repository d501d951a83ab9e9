// A surface with all that it refers to, and what every surface must satisfy.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory_resource>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/made_facets.h"
#include "surface/surface.h"

namespace radvor::test {

inline std::pmr::memory_resource* heap() {
  return std::pmr::get_default_resource();
}

enum class Touching { ignored, found, however_small };

/// Facets as a surface of these options needs them.
struct MadeFacetsInTouch : MadeFacets {
  MadeFacetsInTouch(Scene given, const SurfaceOptions& options, std::uint32_t threads, Touching touching)
      : MadeFacets(std::move(given), threads) {
    if (touching != Touching::ignored) {
      // The same however often it is refined.
      ContactLimits limits = ContactLimits::at_spacing(options.patch_spacing / 4);
      limits.least = touching == Touching::however_small ? 0 : limits.least;
      add_contacts(limits);
    }
  }
};

struct MadeSurface : MadeFacetsInTouch {
  MadeSurface(Scene given, const SurfaceOptions& options, std::uint32_t threads = 2,
              Touching touching = Touching::found)
      : MadeFacetsInTouch(std::move(given), options, threads, touching), surface(scene, welded, facets, options, host) {
    surface.group_patches();
  }

  mutable Surface surface;  // patches may be grouped whenever they are asked for
};

inline const Site& site_of(const Surface& surface, std::uint32_t share) {
  return surface.sites()[surface.samples()[surface.shares()[share].sample].site];
}

/// Where all sites are, in ascending order.
inline std::vector<std::array<double, 3>> positions(const Surface& surface) {
  std::vector<std::array<double, 3>> points;
  for (const Site& site : surface.sites()) {
    points.push_back({site.position.x, site.position.y, site.position.z});
  }
  std::sort(points.begin(), points.end());
  return points;
}

/// Edges whose two sides do not match, by the bits of their ends' positions.
inline std::size_t unmatched_edges(const MadeSurface& made) {
  using Point = std::tuple<double, double, double>;
  const auto point = [](const Vec3& p) { return Point(p.x, p.y, p.z); };
  std::map<std::pair<Point, Point>, int> sides;
  for (std::uint32_t facet = 0; facet < made.facets.facets.size(); ++facet) {
    for (const ShareTriangle& triangle : made.surface.triangles(facet)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Point a = point(site_of(made.surface, triangle[k]).position);
        const Point b = point(site_of(made.surface, triangle[(k + 1) % 3]).position);
        ++sides[{a, b}];
        --sides[{b, a}];
      }
    }
  }
  std::size_t count = 0;
  for (const auto& side : sides) {
    count += side.second != 0 ? 1 : 0;
  }
  return count;
}

/// Area of a cell's polygon, about its own normal.
inline double polygon_area(const std::pmr::vector<Vec3>& polygon, const Vec3& normal) {
  Vec3 doubled(0.0);
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    doubled += glm::cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  }
  return 0.5 * glm::dot(doubled, normal);
}

/// What holds for every surface whatever it is made of: links, numbers, areas.
inline void audit(const MadeSurface& made) {
  made.surface.group_patches();
  const Surface& surface = made.surface;
  const auto samples = surface.samples();
  const auto shares = surface.shares();
  std::vector<double> facet_area(made.facets.facets.size(), 0.0);
  std::vector<int> listed(shares.size(), 0);
  for (std::uint32_t index = 0; index < samples.size(); ++index) {
    double area = 0;
    bool has_facet = false;
    std::uint32_t last = 0;
    for (std::uint32_t s = samples[index].first_share; s != k_none; s = shares[s].next_in_sample) {
      ASSERT_LT(s, shares.size());
      ASSERT_TRUE(s == samples[index].first_share || s > last);
      ASSERT_EQ(shares[s].sample, index);
      ++listed[s];
      area += shares[s].area;
      has_facet = has_facet || shares[s].facet == samples[index].facet;
      last = s;
    }
    ASSERT_DOUBLE_EQ(samples[index].area, area);
    ASSERT_TRUE(has_facet);
    ASSERT_NEAR(glm::length(samples[index].normal), 1, 1e-9);
    ASSERT_LT(samples[index].site, surface.sites().size());
  }
  std::size_t fronts = 0;
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    ASSERT_EQ(listed[s], 1);
    ASSERT_LT(shares[s].patch, surface.patch_count());
    ASSERT_GE(shares[s].area, 0);
    const bool two_sided = made.scene.materials[made.facets.facets[shares[s].facet].material].two_sided;
    ASSERT_EQ(shares[s].other_side != k_none, two_sided);
    if (two_sided) {
      ASSERT_EQ(shares[shares[s].other_side].other_side, s);
      ASSERT_NE(shares[shares[s].other_side].back, shares[s].back);
    }
    if (!shares[s].back) {
      facet_area[shares[s].facet] += shares[s].area;
      ++fronts;
    }
  }
  std::vector<int> in_patch(shares.size(), 0);
  for (std::uint32_t p = 0; p < surface.patch_count(); ++p) {
    ASSERT_FALSE(surface.patch(p).empty());
    for (const std::uint32_t s : surface.patch(p)) {
      ASSERT_EQ(shares[s].patch, p);
      ++in_patch[s];
    }
  }
  for (const int times : in_patch) {
    ASSERT_EQ(times, 1);
  }
  std::vector<int> cornered(shares.size(), 0);
  for (std::uint32_t f = 0; f < made.facets.facets.size(); ++f) {
    for (const ShareTriangle& triangle : surface.triangles(f)) {
      for (const std::uint32_t s : triangle) {
        ASSERT_EQ(shares[s].facet, f);
        ASSERT_FALSE(shares[s].back);
        ++cornered[s];
      }
    }
    // The facet's area is that of the polygon that its edges make in its plane; border sites are on the edges up to
    // a few units of the grid that they are rounded to.
    const Frame& frame = made.facets.facets[f].frame;
    double area = 0;
    double length = 0;
    for (const std::uint32_t t : made.facets.triangles_of(f)) {
      for (const EdgeUse& use : made.welded.uses_of_triangle(t)) {
        const Edge& edge = made.welded.edges[use.edge];
        const Vec2 a = frame.to_plane(made.welded.positions[edge.a]);
        const Vec2 b = frame.to_plane(made.welded.positions[edge.b]);
        area += 0.5 * (use.forward ? cross(a, b) : cross(b, a));
        length += glm::distance(a, b);
      }
    }
    const bool receives = made.scene.meshes[made.facets.facets[f].mesh].receives;
    EXPECT_NEAR(facet_area[f], receives ? area : 0.0, 1e-12 * area + 4 * 0x1p-10 * frame.unit * length)
        << "facet " << f;
  }
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    ASSERT_EQ(cornered[s] > 0, !shares[s].back) << "share " << s;
  }
}

/// Every share's polygon has the share's area and centroid.
inline void audit_cells(const MadeSurface& made) {
  const Surface& surface = made.surface;
  std::pmr::vector<Vec3> polygon;
  for (std::uint32_t s = 0; s < surface.shares().size(); ++s) {
    const Share& share = surface.shares()[s];
    const double facet_area = made.facets.facets[share.facet].area;
    const Vec3 normal = made.facets.facets[share.facet].frame.normal * (share.back ? -1.0 : 1.0);
    surface.cell(s, polygon);
    ASSERT_NEAR(polygon_area(polygon, normal), share.area, 1e-12 * facet_area + 1e-9 * share.area) << "share " << s;
  }
}

/// Levels of sites that are joined by an edge differ by at most one.
inline void expect_balanced(const MadeSurface& made) {
  for (std::uint32_t facet = 0; facet < made.facets.facets.size(); ++facet) {
    for (const ShareTriangle& triangle : made.surface.triangles(facet)) {
      std::array<int, 3> levels;
      for (std::size_t k = 0; k < 3; ++k) {
        levels[k] = static_cast<int>(
            made.surface.level_of(made.surface.samples()[made.surface.shares()[triangle[k]].sample].site));
      }
      const auto [least, most] = std::minmax_element(levels.begin(), levels.end());
      EXPECT_LE(*most - *least, 1) << "facet " << facet << " of " << made.facets.facets.size();
    }
  }
}

}  // namespace radvor::test
