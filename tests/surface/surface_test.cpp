// Surfaces of small scenes with known answers.
#include "surface/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <set>

#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor {
namespace {

using test::heap;
using test::MadeSurface;
using test::SceneBuilder;
using test::unit_floor;

SurfaceOptions spaced(double patch_spacing, std::uint32_t levels, Lattice lattice = Lattice::hexagonal) {
  return {lattice, patch_spacing, levels, 0};
}

TEST(Surface, UnitFloorOfThePaperHasNineByNineSites) {
  const MadeSurface made(unit_floor(), spaced(0.125, 0, Lattice::quadrilateral));
  test::audit(made);
  test::audit_cells(made);
  EXPECT_EQ(made.surface.sites().size(), 81u);
  EXPECT_EQ(made.surface.samples().size(), 81u);
  EXPECT_EQ(made.surface.triangle_count(), 128u);
  EXPECT_EQ(made.surface.patch_count(), 49u);
  for (const Share& share : made.surface.shares()) {
    const Vec3& p = made.surface.sites()[made.surface.samples()[share.sample].site].position;
    const int borders = (p.x == 0 || p.x == 1) + (p.y == 0 || p.y == 1);
    EXPECT_NEAR(share.area, std::ldexp(1.0 / 64, -borders), 1e-15);
    EXPECT_EQ(std::fmod(p.x, 0.125), 0);
    EXPECT_EQ(std::fmod(p.y, 0.125), 0);
  }
}

TEST(Surface, PatchesAreTheElementsNearestToALevelZeroSite) {
  for (const Lattice lattice : {Lattice::hexagonal, Lattice::quadrilateral}) {
    const MadeSurface made(unit_floor(), spaced(0.23, 2, lattice));
    test::audit(made);
    const auto shares = made.surface.shares();
    // The level-0 site of a patch is the one that lies nearest to the mean of the others: find it by the lattice's
    // spacing instead, from a patch in the middle of the floor.
    std::vector<Vec3> centres(made.surface.patch_count());
    std::vector<double> spread(made.surface.patch_count(), 1e30);
    for (std::uint32_t p = 0; p < made.surface.patch_count(); ++p) {
      // A centre is the member whose farthest fellow is nearest.
      for (const std::uint32_t s : made.surface.patch(p)) {
        double farthest = 0;
        for (const std::uint32_t t : made.surface.patch(p)) {
          farthest = std::max(farthest, glm::distance(test::site_of(made.surface, s).position,
                                                      test::site_of(made.surface, t).position));
        }
        if (farthest < spread[p]) {
          spread[p] = farthest;
          centres[p] = test::site_of(made.surface, s).position;
        }
      }
      EXPECT_LT(spread[p], 0.23 * 1.6);
    }
    double area = 0;
    for (const Share& share : shares) {
      area += share.area;
    }
    EXPECT_NEAR(area, 1, 1e-12);
    const double cell = 0.23 * 0.23 * (lattice == Lattice::hexagonal ? 0.866 : 1.0);
    EXPECT_NEAR(static_cast<double>(made.surface.patch_count()), 1 / cell, 0.35 / cell);
  }
}

TEST(Surface, NeighboursShareBorderSites) {
  SceneBuilder builder(heap());
  test::room_with_boxes(builder);
  const MadeSurface made(builder.take(), spaced(0.8, 2), 2, test::Touching::ignored);
  test::audit(made);
  test::audit_cells(made);
  EXPECT_EQ(test::unmatched_edges(made), 0u);
  // Each sharp edge's inner sites have two samples, box corners three.
  std::vector<int> samples_at(made.surface.sites().size(), 0);
  for (const Sample& sample : made.surface.samples()) {
    ++samples_at[sample.site];
  }
  for (std::uint32_t s = 0; s < samples_at.size(); ++s) {
    const Site& site = made.surface.sites()[s];
    if (site.edge == k_none && site.vertex == k_none) {
      EXPECT_EQ(samples_at[s], 1);
    } else {
      EXPECT_EQ(samples_at[s], site.edge != k_none ? 2 : 3);
    }
  }
}

TEST(Surface, IsWatertightWhereTheInputIs) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 60; ++trial) {
    SceneBuilder builder(heap());
    if (trial == 0) {
      test::l_shaped_room(builder);
    } else if (trial < 5) {
      test::cylinder(builder, 5u + 7u * static_cast<std::uint32_t>(trial), 1.0, 2.0, trial % 2 == 0);
    } else {
      std::vector<Vec2> outer, inner;
      test::random_rings(random, 3 + static_cast<std::size_t>(trial) % 13, outer, inner);
      builder.prism(outer, trial % 3 == 0 ? std::vector<Vec2>() : inner, 0.7f);
    }
    const double spacing = std::uniform_real_distribution<double>(0.05, 1.5)(random);
    const MadeSurface made(builder.take(), spaced(spacing, 1, trial % 2 ? Lattice::hexagonal : Lattice::quadrilateral));
    test::audit(made);
    test::audit_cells(made);
    EXPECT_EQ(test::unmatched_edges(made), 0u) << "trial " << trial;
  }
}

TEST(Surface, OnASmoothCylinderEachSideVertexIsOneSampleAndTheCapsAreApart) {
  for (const bool normals : {false, true}) {
    for (const double spacing : {100.0, 0.4}) {
      SceneBuilder builder(heap());
      test::cylinder(builder, 24, 1.0, 1.0, normals);
      const MadeSurface made(builder.take(), spaced(spacing, 0));
      test::audit(made);
      EXPECT_EQ(test::unmatched_edges(made), 0u);
      const auto samples = made.surface.samples();
      std::vector<std::vector<const Sample*>> at(made.surface.sites().size());
      for (const Sample& sample : samples) {
        at[sample.site].push_back(&sample);
      }
      for (std::uint32_t s = 0; s < at.size(); ++s) {
        const Site& site = made.surface.sites()[s];
        const bool rim = site.position.z == 0 || site.position.z == 1;
        const bool on_side = glm::length(Vec2(site.position)) > 0.98;  // facets' middles lie at cos(pi/24)
        ASSERT_EQ(at[s].size(), rim && on_side ? 2u : 1u);
        for (const Sample* sample : at[s]) {
          const bool is_cap = std::abs(sample->normal.z) > 0.5;
          EXPECT_NEAR(is_cap ? std::abs(sample->normal.z) : sample->normal.z, is_cap ? 1 : 0, 1e-6);
          if (!is_cap && site.vertex != k_none) {
            EXPECT_NEAR(glm::dot(sample->normal, glm::normalize(Vec3(site.position.x, site.position.y, 0))), 1, 1e-6);
          }
        }
      }
    }
  }
}

TEST(Surface, TheSameBytesForOneTwoAndThreeThreads) {
  std::vector<std::byte> first;
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    SceneBuilder builder(heap());
    test::room_with_boxes(builder);
    test::cylinder(builder, 40, 0.3, 0.7, true);
    const MadeSurface made(builder.take(), spaced(0.5, 2), threads);
    std::vector<std::byte> bytes;
    const auto put = [&](const auto& value) {
      const auto* data = reinterpret_cast<const std::byte*>(&value);
      bytes.insert(bytes.end(), data, data + sizeof value);
    };
    for (const Site& site : made.surface.sites()) {
      put(site.position);
    }
    for (const Sample& sample : made.surface.samples()) {
      put(sample.point), put(sample.normal), put(sample.area), put(sample.site), put(sample.first_share);
    }
    made.surface.group_patches();
    put(made.surface.patch_count());
    for (const Share& share : made.surface.shares()) {
      put(share.centroid), put(share.albedo), put(share.area), put(share.sample), put(share.patch), put(share.vertex);
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

std::vector<std::array<double, 3>> sorted_sites(const MadeSurface& made, const Vec3& offset) {
  std::vector<std::array<double, 3>> sites;
  for (const Site& site : made.surface.sites()) {
    // Rounded, so that sorting does not depend on the last bits.
    std::array<double, 3> rounded;
    for (glm::length_t k = 0; k < 3; ++k) {
      rounded[static_cast<std::size_t>(k)] = std::nearbyint((site.position[k] - offset[k]) * 1e6) * 1e-6;
    }
    sites.push_back(rounded);
  }
  std::sort(sites.begin(), sites.end());
  return sites;
}

void expect_same_sites(const MadeSurface& a, const MadeSurface& b, const Vec3& offset) {
  const auto one = sorted_sites(a, Vec3(0.0));
  const auto other = sorted_sites(b, offset);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_NEAR(one[k][axis], other[k][axis], 2.1e-6) << k;
    }
  }
  EXPECT_EQ(a.surface.shares().size(), b.surface.shares().size());
  EXPECT_EQ(a.surface.samples().size(), b.surface.samples().size());
  EXPECT_EQ(a.surface.patch_count(), b.surface.patch_count());
}

TEST(Surface, ShuffledTrianglesHaveTheSameSites) {
  const auto make = [](bool shuffled) {
    SceneBuilder builder(heap());
    test::l_shaped_room(builder);
    Scene scene = builder.take();
    if (shuffled) {
      Mesh& mesh = scene.meshes[0];
      std::vector<std::size_t> order(mesh.indices.size() / 3);
      for (std::size_t k = 0; k < order.size(); ++k) {
        order[k] = k;
      }
      std::shuffle(order.begin(), order.end(), std::mt19937(3));
      const auto indices = mesh.indices;
      for (std::size_t k = 0; k < order.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          mesh.indices[3 * k + c] = indices[3 * order[k] + (c + k) % 3];
        }
      }
    }
    return scene;
  };
  const MadeSurface plain(make(false), spaced(0.7, 2));
  const MadeSurface shuffled(make(true), spaced(0.7, 2));
  expect_same_sites(plain, shuffled, Vec3(0.0));
}

TEST(Surface, FarFromTheOriginItIsTheSame) {
  const auto make = [](const Vec3& offset) {
    SceneBuilder builder(heap());
    test::room_with_boxes(builder);
    Scene scene = builder.take();
    for (Mesh& mesh : scene.meshes) {
      mesh.transform = {1, 0, 0, offset.x, 0, 1, 0, offset.y, 0, 0, 1, offset.z};
    }
    return scene;
  };
  const Vec3 offset(1e6, -1e6, 1e6);
  const MadeSurface near(make(Vec3(0.0)), spaced(0.7, 2));
  const MadeSurface far(make(offset), spaced(0.7, 2));
  test::audit(far);
  EXPECT_EQ(test::unmatched_edges(far), 0u);
  expect_same_sites(near, far, offset);
}

TEST(Surface, MeshesThatDoNotReceiveHaveNothing) {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  builder.begin_mesh().receives = false;
  builder.box({0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}, false);
  const MadeSurface made(builder.take(), spaced(0.2, 1));
  test::audit(made);
  for (const Share& share : made.surface.shares()) {
    EXPECT_EQ(made.facets.facets[share.facet].mesh, 0u);
  }
  for (const Site& site : made.surface.sites()) {
    EXPECT_EQ(site.position.z, 0);
  }
  EXPECT_GT(made.surface.shares().size(), 100u);
}

TEST(Surface, TwoSidedFacetsHaveSamplesOnBothSides) {
  SceneBuilder builder(heap());
  const std::uint32_t leaf = builder.add_material({Color(0.25), Color(0.0), true});
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, leaf);
  builder.triangle({5, 0, 0}, {5.05, 0, 0}, {5, 0.05, 0}, leaf);
  const MadeSurface made(builder.take(), spaced(0.3, 1));
  test::audit(made);
  test::audit_cells(made);
  const auto shares = made.surface.shares();
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    const Sample& sample = made.surface.samples()[shares[s].sample];
    EXPECT_EQ(sample.normal.z, shares[s].back ? -1 : 1);
    EXPECT_EQ(sample.facet_normal, sample.normal);
    EXPECT_NE(shares[shares[s].other_side].sample, shares[s].sample);
    EXPECT_NE(shares[shares[s].other_side].patch, shares[s].patch);
    EXPECT_EQ(shares[shares[s].other_side].area, shares[s].area);
  }
}

TEST(Surface, AlbedoIsTheMaterialsTimesTheInterpolatedColourAtMostNinetyNine) {
  SceneBuilder builder(heap());
  const std::uint32_t white = builder.add_material({Color(1.0, 0.8, 0.5), Color(0.0), false});
  builder.quad({0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, white);
  Mesh& mesh = builder.mesh();
  for (const glm::vec3& p : mesh.positions) {
    mesh.colors.emplace_back(0.5f * p.x, 0.5f + 0.25f * p.x, 1.0f - p.y);
  }
  const MadeSurface made(builder.take(), spaced(0.4, 1));
  test::audit(made);
  for (std::uint32_t s = 0; s < made.surface.shares().size(); ++s) {
    const Vec3& p = test::site_of(made.surface, s).position;
    const Color& albedo = made.surface.shares()[s].albedo;
    EXPECT_NEAR(albedo.r, std::min(0.99, 0.5 * p.x), 1e-6);
    EXPECT_NEAR(albedo.g, 0.8 * (0.5 + 0.25 * p.x), 1e-6);
    EXPECT_NEAR(albedo.b, 0.5 * (1 - p.y), 1e-6);
  }
}

TEST(Surface, ReceiverPointsLieInsideTheirCells) {
  SceneBuilder builder(heap());
  test::room_with_boxes(builder);
  const MadeSurface made(builder.take(), spaced(1.1, 2));
  std::pmr::vector<Vec3> polygon;
  for (const Sample& sample : made.surface.samples()) {
    const Vec3& site = made.surface.sites()[sample.site].position;
    made.surface.cell(sample.first_share, polygon);  // sharp edges alone: one share a sample
    ASSERT_GE(polygon.size(), 3u);
    double clearance = 1e30;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 along = glm::normalize(polygon[(k + 1) % polygon.size()] - polygon[k]);
      clearance = std::min(clearance, glm::dot(glm::cross(sample.facet_normal, along), sample.point - polygon[k]));
    }
    EXPECT_GT(clearance, 1e-4);  // cells here are convex
    EXPECT_LT(glm::distance(site, sample.point), 0.05 * 1.1);
    EXPECT_NEAR(glm::dot(sample.facet_normal, sample.point - site), 0, 1e-12);
  }
}

TEST(Surface, AWallWithoutThicknessCutsTheFloorsCells) {
  SceneBuilder builder(heap());
  test::floor_with_wall(builder);
  const MadeSurface made(builder.take(), spaced(0.5, 1));
  test::audit(made);
  test::audit_cells(made);
  ASSERT_EQ(made.facets.facets.size(), 2u);
  const std::uint32_t floor = made.facets.facets[0].area > 2 ? 0 : 1;
  std::pmr::vector<Vec3> polygon;
  std::size_t on_slit = 0;
  for (std::uint32_t s = 0; s < made.surface.shares().size(); ++s) {
    const Share& share = made.surface.shares()[s];
    const Vec3& site = test::site_of(made.surface, s).position;
    if (share.facet != floor || site.x < 1 || site.x > 2 || std::abs(site.y - 1) > 1e-12) {
      continue;
    }
    ++on_slit;
    const Vec3& receiver = made.surface.samples()[share.sample].point;
    const bool tip = site.x == 1 || site.x == 2;
    made.surface.cell(s, polygon);
    int above = 0;
    int below = 0;
    for (const Vec3& p : polygon) {
      above += p.y > 1 + 1e-9 ? 1 : 0;
      below += p.y < 1 - 1e-9 ? 1 : 0;
    }
    if (tip) {
      EXPECT_TRUE(above > 0 && below > 0);
      EXPECT_LT((receiver.x - site.x) * (1.5 - site.x), -5e-4);  // away from the slit
    } else {
      EXPECT_TRUE((above == 0) != (below == 0));
      EXPECT_GT((receiver.y - 1) * (share.centroid.y - 1), 0);
      EXPECT_GT(std::abs(receiver.y - 1), 1e-3);
    }
  }
  EXPECT_EQ(on_slit, 2u + 2u * 3u);  // spacing 0.25 along an edge of 1: three sites inside, on either side
}

}  // namespace
}  // namespace radvor
