// Surfaces that touch and cut each other: sites along the contacts, samples on either side.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "scene/box_tree.h"
#include "scene/shape.h"
#include "surface/first_levels.h"
#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor {
namespace {

using test::heap;
using test::MadeSurface;
using test::SceneBuilder;

Scene floor_with_box() {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  builder.begin_mesh();
  builder.box({1.1, 1.3, 0}, {2.3, 2.9, 1}, false);
  return builder.take();
}

bool under_box(const Vec3& p) {
  return p.x > 1.1f && p.x < 2.3f && p.y > 1.3f && p.y < 2.9f;
}

TEST(ContactSites, EachSampleOfAFootprintIsOnItsOwnSide) {
  const MadeSurface made(floor_with_box(), {Lattice::hexagonal, 0.4, 1, 0});
  test::audit(made);
  test::audit_cells(made);
  double dark = 0;
  std::map<std::uint32_t, std::vector<std::uint32_t>> samples_on_footprint;
  std::pmr::vector<Vec3> polygon;
  for (std::uint32_t s = 0; s < made.surface.shares().size(); ++s) {
    const Share& share = made.surface.shares()[s];
    const Sample& sample = made.surface.samples()[share.sample];
    if (made.facets.facets[share.facet].area < 15) {
      continue;  // not the floor
    }
    const bool inside = under_box(sample.point);
    dark += inside ? share.area : 0;
    // The whole cell is on the side that the light is gathered on.
    made.surface.cell(s, polygon);
    for (const Vec3& p : polygon) {
      const Vec3 nearer = p + 1e-6 * (sample.point - p);
      EXPECT_EQ(under_box(nearer), inside) << "at " << p.x << " " << p.y;
    }
    const Vec3& site = test::site_of(made.surface, s).position;
    const double beside = std::max({1.1 - site.x, site.x - 2.3, 1.3 - site.y, site.y - 2.9});
    if (std::abs(beside) < 1e-6) {
      samples_on_footprint[sample.site].push_back(share.sample);
    }
  }
  EXPECT_NEAR(dark, double(2.3f - 1.1f) * double(2.9f - 1.3f), 1e-6);
  // Sides of 1.2 and 1.6 at spacing 0.2 have five and seven sites inside, from the middle outward.
  EXPECT_EQ(samples_on_footprint.size(), 4u + 2 * 5 + 2 * 7);
  for (const auto& [site, samples] : samples_on_footprint) {
    EXPECT_EQ(samples.size(), 2u) << "site " << site;
    EXPECT_NE(samples.front(), samples.back());
  }
}

TEST(ContactSites, TheEndOfAWallHasOneSample) {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0});
  builder.begin_mesh().receives = false;
  builder.quad({1, 2, -1}, {3, 2, -1}, {3, 2, 1}, {1, 2, 1});
  const MadeSurface made(builder.take(), {Lattice::hexagonal, 0.5, 1, 0});
  test::audit(made);
  std::map<double, int> samples;
  for (const Sample& sample : made.surface.samples()) {
    const Vec3& site = made.surface.sites()[sample.site].position;
    if (site.y == 2 && site.x >= 1 && site.x <= 3) {
      ++samples[site.x];
    }
  }
  ASSERT_EQ(samples.size(), 9u);
  for (const auto& [x, count] : samples) {
    EXPECT_EQ(count, x == 1 || x == 3 ? 1 : 2) << x;
  }
}

TEST(ContactSites, PatchesStayOnOneSideOfAWall) {
  for (const double spacing : {0.2, 0.5, 0.8}) {
    SceneBuilder builder(heap());
    builder.box({0, 0, 0}, {5, 2, 2}, true);
    builder.begin_mesh();
    builder.quad({2.1, -1, -1}, {2.1, 3, -1}, {2.1, 3, 3}, {2.1, -1, 3});
    const MadeSurface made(builder.take(), {Lattice::hexagonal, spacing, 1, 0});
    test::audit(made);
    for (std::uint32_t p = 0; p < made.surface.patch_count(); ++p) {
      bool left = false;
      bool right = false;
      for (const std::uint32_t s : made.surface.patch(p)) {
        if (made.facets.facets[made.surface.shares()[s].facet].mesh == 0) {
          (made.surface.shares()[s].centroid.x < 2.1 ? left : right) = true;
        }
      }
      EXPECT_FALSE(left && right) << "patch " << p << " at spacing " << spacing;
    }
  }
}

TEST(ContactSites, AboutALampUnderACeilingTheSpacingComesDownToTheGap) {
  for (const double gap : {0.1, 0.02}) {
    SceneBuilder builder(heap());
    builder.quad({0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3});
    builder.begin_mesh();
    builder.box({1.1, 1.3, 2.5}, {2.3, 2.9, 3 - gap}, false);
    SurfaceOptions options{Lattice::hexagonal, 0.4, 0, 0.05};
    MadeSurface made(builder.take(), options);
    ASSERT_EQ(made.facets.contacts.edges.size(), 4u);
    EXPECT_NEAR(made.facets.contacts.edges[0].gap, gap, 1e-6);
    const std::size_t before = made.surface.sites().size();
    options.max_sites = static_cast<std::uint32_t>(before + 100);
    resolve_gaps(made.surface, options, heap());
    EXPECT_LE(made.surface.sites().size(), before + 100);
    options.max_sites = 0;
    resolve_gaps(made.surface, options, heap());
    made.surface.refine({});
    EXPECT_TRUE(sites_wider_than_gaps(made.surface, options, heap()).empty());
    test::audit(made);
    test::audit_cells(made);
    // No edge of a triangle at the outline is longer than a hexagon's, where the spacing can be had.
    const double spacing = std::max(gap, 0.05);
    std::size_t at_outline = 0;
    for (const ShareTriangle& triangle : made.surface.triangles(0)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Site& a = test::site_of(made.surface, triangle[k]);
        const Site& b = test::site_of(made.surface, triangle[(k + 1) % 3]);
        if (a.edge != k_none && a.edge >= made.facets.contacts.edges[0].edge) {
          EXPECT_LT(glm::distance(a.position, b.position), 2.01 * spacing);
          ++at_outline;
        }
      }
    }
    EXPECT_GT(at_outline, 5.0 / spacing);
    EXPECT_LT(made.surface.sites().size(), 4.0 * 4.0 / (spacing * spacing));  // and not everywhere
  }
}

TEST(ContactSites, AGapNarrowerThanTheContactsSpacingIsResolvedToThatAlone) {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3});
  builder.begin_mesh();
  builder.box({1.1, 1.3, 2.5}, {2.3, 2.9, 2.99}, false);
  SurfaceOptions options{Lattice::hexagonal, 0.4, 0, 0.01};
  options.contact_spacing = 0.06;
  MadeSurface made(builder.take(), options);
  resolve_gaps(made.surface, options, heap());
  const auto& contacts = made.facets.contacts.edges;
  ASSERT_EQ(contacts.size(), 4u);
  std::size_t on_contacts = 0;
  for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
    const std::uint32_t edge = made.surface.sites()[site].edge;
    if (edge != k_none && edge >= contacts.front().edge) {
      EXPECT_EQ(made.surface.level_of(site), 3u);  // 0.4 / 8 = 0.05
      ++on_contacts;
    }
  }
  EXPECT_NEAR(static_cast<double>(on_contacts), 5.6 / 0.05, 8);
}

TEST(ContactSites, ASmallTriangleIsCutToo) {
  SceneBuilder builder(heap());
  builder.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  builder.begin_mesh().receives = false;
  builder.quad({0.3, -1, -1}, {0.3, 2, -1}, {0.3, 2, 1}, {0.3, -1, 1});
  const MadeSurface made(builder.take(), {Lattice::hexagonal, 1, 0, 0});
  test::audit(made);
  test::audit_cells(made);
  EXPECT_EQ(made.surface.sites().size(), 6u);  // corners, ends of the cut, and the middle of the side beside it
  EXPECT_EQ(made.surface.samples().size(), 8u);
}

// Boxes through boxes, some of them turned, on a floor.
Scene random_boxes(std::uint32_t seed, int count) {
  SceneBuilder builder(heap());
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 8);
  std::uniform_real_distribution<double> size(0.5, 4);
  builder.quad({0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0});
  for (int k = 0; k < count; ++k) {
    Mesh& mesh = builder.begin_mesh();
    const Vec3 low(place(random), place(random), k % 3 == 0 ? 0.0 : place(random) - 4);
    builder.box(low, low + Vec3(size(random), size(random), size(random)), false);
    if (k % 2 == 1) {
      const double c = std::cos(size(random));
      const double s = std::sqrt(1 - c * c);
      mesh.transform = {c, -s, 0, 3, 0.8 * s, 0.8 * c, -0.6, 1, 0.6 * s, 0.6 * c, 0.8, -3};
    }
  }
  return builder.take();
}

// How much of a triangle's trace in the facet's plane lies deeper than `margin` inside one of the facet's pieces.
double trace_inside(const Frame& frame, const std::array<Vec3, 3>& cutter, const std::array<Vec2, 3>& piece,
                    double margin) {
  std::array<double, 3> heights;
  std::ranges::transform(cutter, heights.begin(), [&](const Vec3& p) { return dot(p - frame.origin, frame.normal); });
  if (std::ranges::min(heights) > -margin || std::ranges::max(heights) < margin) {
    return 0;  // lies in the plane or stands on it
  }
  std::array<Vec2, 2> ends;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3 && count < 2; ++k) {
    const double from = heights[k];
    const double to = heights[(k + 1) % 3];
    if ((from > 0) != (to > 0)) {
      const Vec3 p = cutter[k] + from / (from - to) * (cutter[(k + 1) % 3] - cutter[k]);
      ends[count++] = {dot(p - frame.origin, frame.u), dot(p - frame.origin, frame.v)};
    }
  }
  if (count < 2) {
    return 0;
  }
  double from = 0;
  double to = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 side = glm::normalize(piece[(k + 1) % 3] - piece[k]);
    const double a = cross(side, ends[0] - piece[k]) - margin;
    const double b = cross(side, ends[1] - piece[k]) - margin;
    if (a < 0 && b < 0) {
      return 0;
    }
    from = a < 0 ? std::max(from, a / (a - b)) : from;
    to = b < 0 ? std::min(to, a / (a - b)) : to;
  }
  return std::max(0.0, to - from) * glm::distance(ends[0], ends[1]);
}

TEST(ContactSites, NoTriangleOfTheSurfaceIsCutThrough) {
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    const double spacing = seed % 2 == 0 ? 0.7 : 3.0;
    const MadeSurface made(random_boxes(seed, 3 + int(seed)), {Lattice::hexagonal, spacing, 0, 0}, 2,
                           test::Touching::however_small);
    test::audit(made);
    test::audit_cells(made);
    EXPECT_GT(made.surface.constraint_count(), 0u);
    for (std::uint32_t f = 0; f < made.facets.facets.size(); ++f) {
      const Frame& frame = made.facets.facets[f].frame;
      const double margin = 4 * planar_tolerance(1e-6, 20);
      Box box;
      for (const std::uint32_t t : made.facets.triangles_of(f)) {
        for (const Vec3& p : positions_of(made.welded, made.welded.triangles[t])) {
          box.add(p);
        }
      }
      if (length(box.high - box.low) < spacing) {
        continue;  // too small for more than its corners
      }
      for (const ShareTriangle& triangle : made.surface.triangles(f)) {
        std::array<Vec2, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
          corners[k] = frame.to_plane(test::site_of(made.surface, triangle[k]).position);
        }
        for (std::uint32_t t = 0; t < made.welded.triangles.size(); ++t) {
          if (made.facets.facet_of_triangle[t] != f) {
            ASSERT_LT(trace_inside(frame, positions_of(made.welded, made.welded.triangles[t]), corners, margin), 1e-3)
                << "seed " << seed << ", facet " << f << ", triangle " << t;
          }
        }
      }
    }
  }
}

TEST(ContactSites, ClosedBodiesStayWatertight) {
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    const MadeSurface made(random_boxes(seed, 4 + int(seed)), {Lattice::hexagonal, 0.9, 0, 0});
    // The floor alone has a border: of its edges, each is open once, and seen from both ends.
    std::size_t on_floors_border = 0;
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (std::uint32_t f = 0; f < made.facets.facets.size(); ++f) {
      if (made.facets.facets[f].mesh != 0) {
        continue;
      }
      for (const ShareTriangle& triangle : made.surface.triangles(f)) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3& a = test::site_of(made.surface, triangle[k]).position;
          const Vec3& b = test::site_of(made.surface, triangle[(k + 1) % 3]).position;
          const auto along = [&](glm::length_t axis, double at) {
            return std::abs(a[axis] - at) < 1e-9 && std::abs(b[axis] - at) < 1e-9;
          };
          on_floors_border += along(0, 0) || along(0, 10) || along(1, 0) || along(1, 10) ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(test::unmatched_edges(made), 2 * on_floors_border) << "seed " << seed;
  }
}

}  // namespace
}  // namespace radvor
