// Triangulations of single facets: cells against triangles, and what happens where a facet's plane fails it.
#include "surface/facet_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <random>

#include "support/made_facets.h"
#include "surface/cut_triangles.h"
#include "surface/solids.h"
#include "surface/triangle_cells.h"

namespace radvor {
namespace {

struct Prepared : test::MadeFacets {
  Prepared(Scene given, double spacing)
      : MadeFacets(std::move(given), 1),
        options{Lattice::hexagonal, spacing, 0, 0},
        borders(scene, welded, facets, options, &host.memory) {}

  FacetInput input(std::uint32_t facet) { return {scene, welded, facets, options, borders, &host.memory, facet}; }

  SurfaceOptions options;
  BorderSites borders;
};

// Of the triangles inside, in the triangulation's own coordinates.
long double triangulated_area(const FacetMesh& mesh) {
  const delaunay::Triangulation& triangulation = mesh.triangulation();
  long double doubled = 0;
  for (delaunay::TriangleId t = 0; t < triangulation.triangle_bound(); ++t) {
    if (triangulation.is_triangle(t) && triangulation.is_inside(t)) {
      const auto v = triangulation.triangle(t);
      doubled += doubled_area(triangulation.position(v[0]), triangulation.position(v[1]), triangulation.position(v[2]));
    }
  }
  return doubled / 2;
}

void expect_cells_fill(Prepared& prepared) {
  for (std::uint32_t facet = 0; facet < prepared.facets.facets.size(); ++facet) {
    FacetDraft draft(&prepared.host.memory);
    const FacetMesh mesh(prepared.input(facet), draft);
    ASSERT_FALSE(mesh.degenerate()) << "facet " << facet;
    mesh.triangulation().validate();
    long double cells = 0;
    for (const FacetShare& share : draft.shares) {
      EXPECT_GE(share.area, 0);
      cells += share.area;
    }
    const long double area = triangulated_area(mesh);
    EXPECT_NEAR(static_cast<double>(cells / area), 1, 1e-12) << "facet " << facet;
  }
}

TEST(FacetMesh, CellsFillConcaveFacetsWithHoles) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 40; ++trial) {
    test::SceneBuilder builder(std::pmr::get_default_resource());
    std::vector<Vec2> outer, inner;
    test::random_rings(random, 3 + static_cast<std::size_t>(trial) % 13, outer, inner);
    builder.prism(outer, inner, 0.7f);
    Prepared prepared(builder.take(), std::uniform_real_distribution<double>(0.02, 0.8)(random));
    expect_cells_fill(prepared);
  }
}

// Rays need no exact arithmetic for nearly all that they hit.
TEST(FacetMesh, QuickLocationFindsNearlyAllUntilTiesAreAligned) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(0, 1);
  test::SceneBuilder builder(std::pmr::get_default_resource());
  std::vector<Vec2> outer, inner;
  test::random_rings(random, 9, outer, inner);
  builder.prism(outer, inner, 0.7f);
  Prepared prepared(builder.take(), 0.05);
  for (std::uint32_t facet = 0; facet < prepared.facets.facets.size(); ++facet) {
    FacetDraft draft(&prepared.host.memory);
    FacetMesh mesh(prepared.input(facet), draft);
    ASSERT_FALSE(mesh.degenerate());
    mesh.prepare_location();
    const QuickLocation& quick = mesh.quick();
    constexpr int k_points = 1000;
    std::array<double, 3> weights;
    const auto some_point = [&] {
      const auto triangles = prepared.facets.triangles_of(facet);
      const auto& corners = prepared.welded.triangles[triangles[random() % triangles.size()]].vertices;
      const double u = uniform(random), v = uniform(random) * (1 - u);
      const auto& at = prepared.welded.positions;
      return prepared.facets.facets[facet].frame.to_plane((1 - u - v) * at[corners[0]] + u * at[corners[1]] +
                                                          v * at[corners[2]]);
    };
    int found = 0;
    for (int k = 0; k < k_points; ++k) {
      const Vec2 point = some_point();
      found += quick.find(point, quick.start(point), weights) != k_none ? 1 : 0;
    }
    EXPECT_GT(found, 0.99 * k_points) << facet;
    mesh.align_ties(std::vector<double>(draft.shares.size(), 1.0), 0, &prepared.host.memory);
    const Vec2 point = some_point();
    EXPECT_EQ(quick.find(point, quick.start(point), weights), k_none);
  }
}

TEST(FacetMesh, CellsFillNeedles) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const double flatness = std::pow(10.0, -(trial % 6));
    test::SceneBuilder builder(std::pmr::get_default_resource());
    const auto point = [&] {
      const double along = uniform(random);
      return Vec3(along, 0.7 * along + flatness * uniform(random), 0.3);
    };
    builder.triangle(point(), point(), point());
    Prepared prepared(builder.take(), 0.1);
    expect_cells_fill(prepared);
  }
}

TEST(FacetMesh, CutTrianglesFitTheSameBorders) {
  // What degenerate facets are made of, on facets that are not: the same borders, the same area, one sample a site.
  test::SceneBuilder builder(std::pmr::get_default_resource());
  test::l_shaped_room(builder);
  Prepared prepared(builder.take(), 0.3);
  for (std::uint32_t facet = 0; facet < prepared.facets.facets.size(); ++facet) {
    FacetDraft draft(&prepared.host.memory);
    std::pmr::vector<ShareTriangle> triangles(&prepared.host.memory);
    cut_triangles(prepared.input(facet), triangles, draft);
    ASSERT_EQ(draft.shares.size(), 3 * triangles.size());
    double area = 0;
    std::size_t outer_sides = 0;
    for (const FacetShare& share : draft.shares) {
      area += share.area;
    }
    EXPECT_NEAR(area, prepared.facets.facets[facet].area, 1e-9);
    for (const ShareTriangle& triangle : triangles) {
      EXPECT_GT(doubled_area(draft.shares[triangle[0]].position, draft.shares[triangle[1]].position,
                             draft.shares[triangle[2]].position),
                1e-9);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = draft.shares[triangle[k]].site;
        const std::uint32_t b = draft.shares[triangle[(k + 1) % 3]].site;
        bool matched = false;
        for (const ShareTriangle& other : triangles) {
          for (std::size_t m = 0; m < 3; ++m) {
            matched = matched || (draft.shares[other[m]].site == b && draft.shares[other[(m + 1) % 3]].site == a);
          }
        }
        outer_sides += matched ? 0 : 1;
      }
    }
    std::size_t border_pieces = 0;
    for (const std::uint32_t t : prepared.facets.triangles_of(facet)) {
      for (const EdgeUse& use : prepared.welded.uses_of_triangle(t)) {
        if (prepared.facets.edge_kinds[use.edge] != EdgeKind::interior) {
          border_pieces += prepared.borders.count_on_edge(use.edge) + 1;
        }
      }
    }
    EXPECT_EQ(outer_sides, border_pieces);
  }
}

}  // namespace
}  // namespace radvor
