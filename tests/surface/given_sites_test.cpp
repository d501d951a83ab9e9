// Sites that the host gives: irregular ones beside the lattice's, with everything that holds for those.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor {
namespace {

using test::heap;
using test::MadeSurface;
using test::SceneBuilder;

Scene floor_with(const std::vector<Vec3>& sites) {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  builder.mesh().sites.assign(sites.begin(), sites.end());
  return builder.take();
}

std::size_t nearest(const Surface& surface, const Vec3& point, double* distance = nullptr) {
  std::size_t best = 0;
  for (std::size_t k = 0; k < surface.sites().size(); ++k) {
    if (glm::distance(surface.sites()[k].position, point) < glm::distance(surface.sites()[best].position, point)) {
      best = k;
    }
  }
  if (distance) {
    *distance = glm::distance(surface.sites()[best].position, point);
  }
  return best;
}

TEST(GivenSites, AreSitesOfLevelZeroWithPatchesOfTheirOwn) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  for (const Lattice lattice : {Lattice::hexagonal, Lattice::quadrilateral}) {
    for (const std::uint32_t levels : {0u, 2u}) {
      const double spacing = 0.2;
      std::vector<Vec3> wanted;
      while (wanted.size() < 30) {
        const Vec3 p(uniform(random), uniform(random), 0);
        if (std::all_of(wanted.begin(), wanted.end(), [&](const Vec3& q) { return glm::distance(p, q) > 0.01; })) {
          wanted.push_back(p);
        }
      }
      const SurfaceOptions options{lattice, spacing, levels, std::ldexp(spacing, -static_cast<int>(levels))};
      const MadeSurface plain(floor_with({}), options);
      const MadeSurface made(floor_with(wanted), options);
      test::audit(made);
      test::audit_cells(made);
      std::vector<std::size_t> found;
      for (const Vec3& p : wanted) {
        double distance = 0;
        found.push_back(nearest(made.surface, p, &distance));
        EXPECT_LT(distance, 1e-9);
        EXPECT_EQ(made.surface.sites()[found.back()].level, 0);
      }
      // Lattice sites keep half their spacing; what is left is as it was.
      const double half = 0.4999 * std::ldexp(spacing, -static_cast<int>(levels));
      std::size_t left_out = 0;
      for (const Site& site : plain.surface.sites()) {
        const bool near = site.edge == k_none && site.vertex == k_none &&
                          std::any_of(wanted.begin(), wanted.end(),
                                      [&](const Vec3& p) { return glm::distance(p, site.position) < half; });
        double distance = 0;
        nearest(made.surface, site.position, &distance);
        EXPECT_EQ(distance > 1e-9, near);
        left_out += near ? 1 : 0;
      }
      EXPECT_GT(left_out, 5u);
      EXPECT_EQ(made.surface.sites().size(), plain.surface.sites().size() + wanted.size() - left_out);
      // Each given site shoots for those that it is the nearest centre of.
      made.surface.group_patches();
      for (const Share& share : made.surface.shares()) {
        const std::size_t site = made.surface.samples()[share.sample].site;
        if (std::find(found.begin(), found.end(), site) == found.end()) {
          continue;
        }
        for (const std::uint32_t other : made.surface.patch(share.patch)) {
          const std::size_t member = made.surface.samples()[made.surface.shares()[other].sample].site;
          EXPECT_TRUE(member == site || std::find(found.begin(), found.end(), member) == found.end());
          EXPECT_LT(glm::distance(made.surface.sites()[member].position, made.surface.sites()[site].position),
                    2 * spacing);
        }
      }
    }
  }
}

TEST(GivenSites, TooNearToBordersOrToOthersAreLeftOut) {
  const std::vector<Vec3> wanted = {{0.5, 0.5, 0}, {0.5, 0.5, 0}, {0.5003, 0.5, 0},
                                    {0.5, 0, 0},   {0, 0, 0},     {0.3, 1e-4, 0}};
  const SurfaceOptions options{Lattice::hexagonal, 0.2, 0, 0.2};
  const MadeSurface made(floor_with(wanted), options);
  test::audit(made);
  std::size_t inside = 0;
  for (const Site& site : made.surface.sites()) {
    inside += glm::distance(site.position, wanted[0]) < 0.01 ? 1 : 0;
    EXPECT_FALSE(site.position.y > 0 && site.position.y < 0.01);
  }
  EXPECT_EQ(inside, 1u);
  EXPECT_EQ(test::unmatched_edges(made), test::unmatched_edges(MadeSurface(floor_with({}), options)));
}

TEST(GivenSites, OnManyFacetsKeepTheBodyClosed) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double spacing : {0.2, 5.0}) {
    SceneBuilder builder(heap());
    test::cylinder(builder, 24, 1.0, 2.0, true);
    Mesh& mesh = builder.mesh();
    for (int k = 0; k < 200; ++k) {
      const std::size_t t = random() % (mesh.indices.size() / 3);
      double u = uniform(random);
      double v = uniform(random);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const Vec3 a(mesh.positions[mesh.indices[3 * t]]);
      mesh.sites.push_back(a + u * (Vec3(mesh.positions[mesh.indices[3 * t + 1]]) - a) +
                           v * (Vec3(mesh.positions[mesh.indices[3 * t + 2]]) - a));
    }
    const std::vector<Vec3> wanted(mesh.sites.begin(), mesh.sites.end());
    MadeSurface made(builder.take(), {Lattice::hexagonal, spacing, 0, spacing / 4});
    test::audit(made);
    test::audit_cells(made);
    EXPECT_EQ(test::unmatched_edges(made), 0u);
    std::size_t there = 0;
    for (const Vec3& p : wanted) {
      double distance = 0;
      nearest(made.surface, p, &distance);
      there += distance < 1e-6 ? 1 : 0;
    }
    EXPECT_GT(there, spacing < 1 ? 150u : 20u);
    // And refined: balanced, closed, the given ones still there.
    for (int round = 0; round < 4; ++round) {
      std::vector<std::uint32_t> sites;
      for (int k = 0; k < 5; ++k) {
        sites.push_back(static_cast<std::uint32_t>(random() % made.surface.sites().size()));
      }
      for (const Vec3& p : {wanted[0], wanted[1]}) {
        sites.push_back(static_cast<std::uint32_t>(nearest(made.surface, p)));
      }
      made.surface.refine(sites);
      test::audit(made);
      test::audit_cells(made);
      EXPECT_EQ(test::unmatched_edges(made), 0u);
      for (std::uint32_t facet = 0; facet < made.facets.facets.size(); ++facet) {
        for (const ShareTriangle& triangle : made.surface.triangles(facet)) {
          for (std::size_t k = 0; k < 3; ++k) {
            const auto level = [&](std::size_t corner) {
              return static_cast<int>(
                  made.surface.level_of(made.surface.samples()[made.surface.shares()[triangle[corner]].sample].site));
            };
            EXPECT_LE(std::abs(level(k) - level((k + 1) % 3)), 1);
          }
        }
      }
    }
  }
}

TEST(GivenSites, EverythingRaisedIsTheUniformMeshAroundThem) {
  const std::vector<Vec3> wanted = {{0.31, 0.47, 0}, {0.72, 0.2, 0}, {0.7, 0.26, 0}, {0.05, 0.9, 0}};
  for (const Lattice lattice : {Lattice::hexagonal, Lattice::quadrilateral}) {
    MadeSurface made(floor_with(wanted), {lattice, 0.2, 0, 0.05});
    for (bool more = true; more;) {
      std::vector<std::uint32_t> sites;
      for (std::uint32_t site = 0; site < made.surface.sites().size(); ++site) {
        if (made.surface.level_of(site) < 2) {
          sites.push_back(site);
        }
      }
      more = !sites.empty();
      made.surface.refine(sites);
    }
    const MadeSurface uniform(floor_with(wanted), {lattice, 0.2, 2, 0.05});
    EXPECT_TRUE(test::positions(made.surface) == test::positions(uniform.surface));
  }
}

}  // namespace
}  // namespace radvor
