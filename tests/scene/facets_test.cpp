// Facets, edge kinds and shading normals.
#include "scene/facets.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "scene/audit.h"
#include "scene/shapes.h"
#include "support/test_host.h"

namespace radvor {
namespace {

using test::SceneBuilder;

constexpr double k_crease = std::numbers::pi / 6;

struct Result {
  WeldedScene welded;
  Facets facets;

  std::size_t count(EdgeKind kind) const {
    return static_cast<std::size_t>(std::ranges::count(facets.edge_kinds, kind));
  }
  std::size_t flat() const {
    return static_cast<std::size_t>(std::ranges::count_if(facets.facets, [](const Facet& f) { return f.flat; }));
  }
};

struct FindFacets : testing::Test {
  test::TestHost host{1};
  SceneBuilder build{&host.memory};

  Result find(double crease = k_crease) {
    WeldedScene welded = weld(build.scene, 0, host);
    Facets facets = find_facets(build.scene, welded, crease, host);
    EXPECT_EQ(test::audit(welded), "");
    EXPECT_EQ(test::audit(welded, facets), "");
    return {std::move(welded), std::move(facets)};
  }

  // Unit normals for the last mesh, from a function of the position.
  template <class Function>
  void normals(Function&& function) {
    Mesh& mesh = build.scene.meshes.back();
    for (const glm::vec3& p : mesh.positions) {
      mesh.normals.push_back(function(p));
    }
  }
};

TEST_F(FindFacets, ABoxHasSix) {
  build.box({0, 0, 0}, {1, 2, 3});
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 6u);
  EXPECT_EQ(r.flat(), 6u);
  EXPECT_EQ(r.count(EdgeKind::interior), 6u);
  EXPECT_EQ(r.count(EdgeKind::sharp), 12u);
  double area = 0;
  for (const Facet& facet : r.facets.facets) {
    area += facet.area;
    EXPECT_EQ(facet.triangle_count, 2u);
  }
  EXPECT_DOUBLE_EQ(area, 22);
}

TEST_F(FindFacets, FramesOfAxisParallelWallsAreExact) {
  build.box({0.1f, 0.2f, 0.3f}, {1.7f, 2.9f, 3.1f});
  for (const Facet& facet : find().facets.facets) {
    for (const Vec3& axis : {facet.frame.u, facet.frame.v, facet.frame.normal}) {
      EXPECT_EQ(std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z), 1) << "one of the axes of space";
    }
  }
}

TEST_F(FindFacets, SnappingStaysFarUnderThePrecisionOfTheInput) {
  build.polygon({{0.1f, 0.2f, 0.3f}, {7.7f, 3.1f, -2.9f}, {3.3f, 9.1f, 4.2f}});
  const Result r = find();
  for (const Vec3& p : r.welded.positions) {
    EXPECT_LT(length(r.facets.facets[0].frame.to_world(r.facets.facets[0].frame.to_plane(p)) - p), 1e-10);
  }
}

// A floor of a hundred squares, one of them missing and one of another material.
TEST_F(FindFacets, HolesAndMaterials) {
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 10; ++y) {
      if (x == 3 && y == 3) {
        continue;
      }
      const auto a = static_cast<float>(x);
      const auto b = static_cast<float>(y);
      build.polygon({{a, b, 0}, {a + 1, b, 0}, {a + 1, b + 1, 0}, {a, b + 1, 0}}, x == 6 && y == 5);
    }
  }
  const Result r = find();
  ASSERT_EQ(r.facets.facets.size(), 2u);
  EXPECT_EQ(r.facets.facets[0].triangle_count, 2u * 98);
  EXPECT_DOUBLE_EQ(r.facets.facets[0].area, 98);
  EXPECT_EQ(r.count(EdgeKind::sharp), 40u + 4);
  EXPECT_EQ(r.count(EdgeKind::smooth), 4u) << "materials share irradiance";
}

TEST_F(FindFacets, GrowsOverTJunctions) {
  build.polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
  build.polygon({{0, -1, 0}, {1, -1, 0}, {1, 0, 0}, {0, 0, 0}}).polygon({{1, -1, 0}, {2, -1, 0}, {2, 0, 0}, {1, 0, 0}});
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 1u);
  EXPECT_EQ(r.welded.t_junctions, 1u);
}

TEST_F(FindFacets, MeshesEndFacetsNotLight) {
  build.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  build.mesh();
  build.polygon({{1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 2u);
  EXPECT_EQ(r.count(EdgeKind::smooth), 1u);
}

TEST_F(FindFacets, WhatOneSideLacksEndsTheLight) {
  for (const bool two_sided : {false, true}) {
    SceneBuilder one(&host.memory);
    one.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    one.mesh().receives = two_sided;
    one.polygon({{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, two_sided ? 2 : 0);
    const WeldedScene w = weld(one.scene, 0, host);
    const Facets f = find_facets(one.scene, w, k_crease, host);
    EXPECT_EQ(std::ranges::count(f.edge_kinds, EdgeKind::smooth), 0);
  }
}

// The left wall of the Cornell box: its corners are up to 2 % off a plane.
TEST_F(FindFacets, ABentQuadIsTwoFacetsSmoothlyJoined) {
  build.polygon({{-1.01f, 0, 0.99f}, {-0.99f, 0, -1.04f}, {-1.02f, 1.99f, -1.04f}, {-1.02f, 1.99f, 0.99f}});
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 2u);
  EXPECT_EQ(r.count(EdgeKind::smooth), 1u);
}

TEST_F(FindFacets, AWallOnAFloorDividesItsLight) {
  build.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).polygon({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  EXPECT_EQ(find().facets.facets.size(), 1u);
  build.polygon({{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}});
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 3u) << "edges of three triangles end facets";
}

// A floor that goes round the wall: the facet runs the edge both ways.
TEST_F(FindFacets, ASlitIsSharpInsideItsFacet) {
  for (int i = 0; i < 3; ++i) {
    const auto y = static_cast<float>(i);
    build.polygon({{0, y, 0}, {1, y, 0}, {1, y + 1, 0}, {0, y + 1, 0}});
    build.polygon({{1, y, 0}, {2, y, 0}, {2, y + 1, 0}, {1, y + 1, 0}});
  }
  build.polygon({{1, 1, 0}, {1, 2, 0}, {1, 2, 1}, {1, 1, 1}});
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 2u);
  EXPECT_EQ(r.facets.facets[0].triangle_count, 12u);
  int slits = 0;
  for (std::uint32_t e = 0; e < r.welded.edges.size(); ++e) {
    if (r.welded.uses_at_edge(e).size() == 3) {
      ++slits;
      EXPECT_EQ(r.facets.edge_kinds[e], EdgeKind::sharp);
    }
  }
  EXPECT_EQ(slits, 1);
}

// A ribbon in a plane that goes round more than once covers its beginning.
TEST_F(FindFacets, WhatOverlapsItselfFallsToTriangles) {
  const auto spiral = [&](int quads) {
    SceneBuilder one(&host.memory);
    const auto rim = [](int i, double inner) {
      const double angle = std::numbers::pi / 8 * i;
      const double radius = inner + 0.05 * i;  // 16 a turn move it out by 0.8 of its width
      return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
    };
    for (int i = 0; i < quads; ++i) {
      one.polygon({rim(i, 2), rim(i, 3), rim(i + 1, 3), rim(i + 1, 2)});
    }
    const WeldedScene w = weld(one.scene, 0, host);
    const Facets f = find_facets(one.scene, w, k_crease, host);
    EXPECT_EQ(test::audit(w, f), "");
    return f.facets.size();
  };
  EXPECT_EQ(spiral(15), 1u);
  EXPECT_EQ(spiral(20), 40u);
}

TEST_F(FindFacets, AFoldIsNoPlane) {
  build.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).polygon({{1, 0, 0}, {0, 0, 0}, {0, 1.5f, 0}});
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 2u);
  EXPECT_EQ(r.count(EdgeKind::smooth), 0u);
}

TEST_F(FindFacets, ACylinderIsSmoothRoundAndSharpAtItsEnds) {
  build.cylinder(16, 1, 2);
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 18u);
  EXPECT_EQ(r.count(EdgeKind::smooth), 16u);
  EXPECT_EQ(r.count(EdgeKind::sharp), 32u);
  EXPECT_EQ(r.flat(), 2u);
  for (std::uint32_t f = 0; f < 16; ++f) {
    for (const std::uint32_t t : r.facets.triangles_of(f)) {
      for (std::size_t i = 0; i < 3; ++i) {
        Vec3 expected = r.welded.positions[r.welded.triangles[t].vertices[i]];
        expected.z = 0;  // by symmetry; the corner's two triangles of one quad count as one angle
        EXPECT_LT(length(r.facets.corner_normals[t][i] - normalize(expected)), 1e-6);
      }
    }
  }
}

TEST_F(FindFacets, TheCreaseAngleDecidesWithoutNormals) {
  build.cylinder(16, 1, 2);  // 22.5 degrees
  EXPECT_EQ(find(std::numbers::pi / 8 + 1e-5).count(EdgeKind::smooth), 16u);
  EXPECT_EQ(find(std::numbers::pi / 8 - 1e-5).count(EdgeKind::smooth), 0u);
  EXPECT_EQ(find(std::numbers::pi).count(EdgeKind::smooth), 48u);
}

TEST_F(FindFacets, GivenNormalsDecideWhereThereAreAny) {
  build.cylinder(6, 1, 2);  // 60 degrees
  normals([](const glm::vec3& p) { return glm::vec3(p.x, p.y, 0); });
  const Result r = find();
  EXPECT_EQ(r.count(EdgeKind::smooth), 6u + 6 + 12 + 6) << "everywhere, as the caps have the same normals";
  EXPECT_EQ(r.flat(), 0u);
  EXPECT_EQ(r.facets.facets.size(), r.welded.triangles.size());
}

TEST_F(FindFacets, FlatNormalsMakeFacets) {
  build.box({0, 0, 0}, {1, 1, 1});
  Mesh& mesh = build.scene.meshes[0];
  for (const int axis : {2, 2, 1, 1, 0, 0}) {
    glm::vec3 normal(0);
    normal[axis] = 3;  // any length, and half of them to the wrong side
    mesh.normals.insert(mesh.normals.end(), 4, normal);
  }
  const Result r = find();
  EXPECT_EQ(r.facets.facets.size(), 6u);
  EXPECT_EQ(r.flat(), 6u);
}

TEST_F(FindFacets, NormalsThatAreNoDirectionsBecomeTheFacets) {
  build.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  build.scene.meshes[0].normals = {{0, 0, 0}, {nan, 0, 1}, {1e30f, 0, 1e30f}};
  const Result r = find();
  EXPECT_EQ(r.facets.corner_normals[0][0], Vec3(0, 0, 1));
  EXPECT_EQ(r.facets.corner_normals[0][1], Vec3(0, 0, 1));
  EXPECT_LT(length(r.facets.corner_normals[0][2] - std::sqrt(0.5) * Vec3(1, 0, 1)), 1e-12);
}

// Normals stay perpendicular to what they belong to.
TEST_F(FindFacets, NormalsFollowShearAndMirror) {
  build.polygon({{0, 0, 0}, {1, 0, 1}, {0, 1, 0}});
  build.scene.meshes[0].normals.assign(3, {-1, 0, 1});
  for (const double mirror : {1.0, -1.0}) {
    build.scene.meshes[0].transform = {mirror, 0, 3, 1e6, 0, 2, 0, 7, 0, 0.5, 1, 0};
    const Result r = find();
    EXPECT_EQ(r.flat(), 1u) << mirror;
  }
}

TEST_F(FindFacets, ColoursAndUvsPartOrSeam) {
  build.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).polygon({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  Mesh& mesh = build.scene.meshes[0];
  const auto set_uvs = [&](float jump, float stretch) {
    mesh.uvs.clear();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::vec3& p = mesh.positions[i];
      mesh.uvs.emplace_back(p.x + (i >= 4 ? jump + stretch * (p.x - 1) : 0.0f), p.y);
    }
  };
  set_uvs(0, 0);
  EXPECT_EQ(find().count(EdgeKind::seam), 0u);
  set_uvs(1, 0);
  EXPECT_EQ(find().count(EdgeKind::seam), 1u);
  EXPECT_EQ(find().facets.facets.size(), 1u);
  set_uvs(0, 0.1f);
  EXPECT_EQ(find().count(EdgeKind::seam), 1u);
  mesh.uvs.clear();
  mesh.colors.assign(8, glm::vec3(0.5f));
  EXPECT_EQ(find().count(EdgeKind::seam), 0u);
  mesh.colors[5].x = 0.6f;
  EXPECT_EQ(find().count(EdgeKind::seam), 1u) << "at the diagonal";
  mesh.colors[4].x = 0.6f;
  EXPECT_EQ(find().facets.facets.size(), 2u) << "colours jump along the edge";
}

TEST_F(FindFacets, ShadingNormalsInterpolate) {
  build.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  build.scene.meshes[0].normals = {{-1, 0, 2}, {1, 0, 2}, {-1, 0, 2}};
  const Result r = find();
  EXPECT_LT(length(shading_normal(r.facets, r.welded, 0, {0.5, 0.2, 0}) - Vec3(0, 0, 1)), 1e-12);
  EXPECT_LT(length(shading_normal(r.facets, r.welded, 0, {1.5, 0, 0}) - normalize(Vec3(1, 0, 2))), 0.2);
}

// A gently curved, finely divided roof: neighbours are coplanar within rounding, the whole is not.
TEST_F(FindFacets, CurvesThatNeighboursDoNotShowAreCut) {
  build.scene.meshes.clear();
  for (int i = 0; i < 2000; ++i) {
    const auto x = [](int k) { return static_cast<float>(k) * 5e-3f; };
    const auto z = [](int k) { return static_cast<float>(1e-2 * 1e-4 * k * k); };
    build.polygon({{x(i), 0, z(i)}, {x(i + 1), 0, z(i + 1)}, {x(i + 1), 1, z(i + 1)}, {x(i), 1, z(i)}});
  }
  const Result r = find();
  EXPECT_GT(r.facets.facets.size(), 10u);
  for (std::uint32_t f = 0; f < r.facets.facets.size(); ++f) {
    const Frame& frame = r.facets.facets[f].frame;
    for (const std::uint32_t t : r.facets.triangles_of(f)) {
      for (const std::uint32_t v : r.welded.triangles[t].vertices) {
        EXPECT_LT(std::abs(dot(r.welded.positions[v] - frame.origin, frame.normal)), 5e-5);
      }
    }
  }
}

// Facets as sets of triangles, each known by where its corners are.
std::set<std::set<std::array<double, 9>>> as_sets(const WeldedScene& welded, const Facets& facets) {
  std::set<std::set<std::array<double, 9>>> result;
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f) {
    std::set<std::array<double, 9>> places;
    for (const std::uint32_t t : facets.triangles_of(f)) {
      auto v = welded.triangles[t].vertices;
      const auto first = std::ranges::min_element(
          v, [&](std::uint32_t a, std::uint32_t b) { return lies_before(welded.positions[a], welded.positions[b]); });
      std::rotate(v.begin(), first, v.end());
      std::array<double, 9> place;
      for (std::size_t i = 0; i < 9; ++i) {
        place[i] = welded.positions[v[i / 3]][static_cast<glm::length_t>(i % 3)];
      }
      places.insert(place);
    }
    result.insert(places);
  }
  return result;
}

TEST_F(FindFacets, DoNotDependOnTheOrderOfTriangles) {
  build.cylinder(40, 1, 2).box({0, 0, 0.5f}, {3, 3, 0.75f});
  for (int i = 0; i < 60; ++i) {
    const auto x = [](int k) { return static_cast<float>(k) * 5e-3f; };
    const auto z = [](int k) { return static_cast<float>(7 + 1e-2 * 1e-3 * k * k); };
    build.polygon({{x(i), 0, z(i)}, {x(i + 1), 0, z(i + 1)}, {x(i + 1), 1, z(i + 1)}, {x(i), 1, z(i)}});
  }
  const Result first = find();
  const auto expected = as_sets(first.welded, first.facets);
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    test::shuffle(build.scene, seed);
    const Result again = find();
    EXPECT_EQ(as_sets(again.welded, again.facets), expected);
    EXPECT_EQ(again.count(EdgeKind::smooth), first.count(EdgeKind::smooth));
  }
}

TEST_F(FindFacets, AMillionUnitsAwayIsNoDifference) {
  build.cylinder(40, 1, 2).box({0, 0, 0.5f}, {3, 3, 0.75f});
  const Result here = find();
  for (Mesh& mesh : build.scene.meshes) {
    mesh.transform[3] = 1e6;
    mesh.transform[7] = -1e6;
    mesh.transform[11] = 1e6;
  }
  const Result there = find();
  EXPECT_EQ(there.facets.facets.size(), here.facets.facets.size());
  for (const EdgeKind kind : {EdgeKind::interior, EdgeKind::smooth, EdgeKind::sharp}) {
    EXPECT_EQ(there.count(kind), here.count(kind));
  }
}

TEST_F(FindFacets, SizeIsNoDifference) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    SceneBuilder one(&host.memory);
    one.cylinder(40, 1, 2).box({0, 0, 0.5f}, {3, 3, 0.75f});
    one.scene.meshes[0].transform = {0, scale, 0, 0, scale, 0, 0, 0, 0, 0, -scale, 0};
    const WeldedScene w = weld(one.scene, 0, host);
    const Facets f = find_facets(one.scene, w, k_crease, host);
    EXPECT_EQ(f.facets.size(), 48u) << scale;
    EXPECT_EQ(test::audit(w, f), "") << scale;
  }
}

RC_GTEST_PROP(FacetSoup, HoldsTheInvariants, ()) {
  test::TestHost host(1);
  SceneBuilder build(&host.memory);
  const auto coordinate = rc::gen::map(rc::gen::inRange(0, 4), [](int i) { return static_cast<float>(i); });
  const auto point =
      rc::gen::map(rc::gen::container<std::array<float, 3>>(coordinate), [](const std::array<float, 3>& p) {
        return glm::vec3(p[0], p[1], p[2] > 1 ? 0 : p[2] * 0.5f);  // mostly in one plane
      });
  const auto polygons =
      *rc::gen::container<std::vector<std::vector<glm::vec3>>>(rc::gen::container<std::vector<glm::vec3>>(3, point));
  for (const auto& polygon : polygons) {
    if (*rc::gen::inRange(0, 6) == 0) {
      build.mesh();
    }
    build.polygon(polygon, static_cast<std::uint32_t>(*rc::gen::weightedElement<int>({{6, 0}, {1, 1}, {1, 2}})));
  }
  const WeldedScene w = weld(build.scene, 0, host);
  const Facets f = find_facets(build.scene, w, k_crease, host);
  RC_ASSERT(test::audit(w, f) == "");
  const auto expected = as_sets(w, f);
  if (w.duplicate_triangles == 0) {
    test::shuffle(build.scene, 7);
    const WeldedScene w2 = weld(build.scene, 0, host);
    RC_ASSERT(as_sets(w2, find_facets(build.scene, w2, k_crease, host)) == expected);
  }
}

}  // namespace
}  // namespace radvor
