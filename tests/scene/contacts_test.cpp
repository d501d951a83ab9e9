// Where surfaces touch and cut each other: scenes whose contacts are known, and properties of random ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "scene/audit.h"
#include "scene/find_contacts.h"
#include "scene/shape.h"
#include "scene/shapes.h"
#include "support/random_numbers.h"
#include "support/test_host.h"

namespace radvor {
namespace {

using test::SceneBuilder;

struct Found {
  explicit Found(const Scene& given, double spacing = 0.01, double least = 0, std::uint32_t threads = 2,
                 double reach = 0)
      : host(threads), scene(given), welded(weld(scene, 0, host)) {
    facets.emplace(find_facets(scene, welded, std::numbers::pi / 6, host));
    vertices_before = welded.positions.size();
    find_contacts(scene, welded, *facets, {spacing, least, reach}, host);
    EXPECT_EQ(test::audit(welded), "");
    EXPECT_EQ(test::audit(welded, *facets), "");
  }

  // The facet whose plane has this normal and that holds the point.
  std::uint32_t facet_at(const Vec3& point, const Vec3& normal) const {
    for (std::uint32_t t = 0; t < welded.triangles.size(); ++t) {
      const Vec3 weights = barycentric(positions_of(welded, welded.triangles[t]), point);
      const Frame& frame = facets->facets[facets->facet_of_triangle[t]].frame;
      if (dot(frame.normal, normal) > 0.99 && std::abs(dot(point - frame.origin, frame.normal)) < 1e-6 &&
          std::min({weights.x, weights.y, weights.z}) > -1e-9) {
        return facets->facet_of_triangle[t];
      }
    }
    ADD_FAILURE() << "no facet there";
    return 0;
  }

  // Ends in space, rounded to thousandths, the lower first: sorted.
  using Line = std::array<int, 6>;
  std::vector<Line> lines_on(std::uint32_t facet) const {
    std::vector<Line> lines;
    for (const ContactEdge& contact : facets->contacts.of_facet(facet)) {
      const Edge& edge = welded.edges[contact.edge];
      std::array<std::array<int, 3>, 2> ends;
      for (std::size_t k = 0; k < 2; ++k) {
        const Vec3 p = welded.positions[k == 0 ? edge.a : edge.b];
        ends[k] = {int(std::lround(p.x * 1000)), int(std::lround(p.y * 1000)), int(std::lround(p.z * 1000))};
      }
      if (ends[1] < ends[0]) {
        std::swap(ends[0], ends[1]);
      }
      lines.push_back({ends[0][0], ends[0][1], ends[0][2], ends[1][0], ends[1][1], ends[1][2]});
    }
    std::ranges::sort(lines);
    return lines;
  }
  // Vertices of a facet's contacts that lie on its outline.
  std::set<std::uint32_t> ends_on_outline(std::uint32_t facet) const {
    std::set<std::uint32_t> outline;
    for (const std::uint32_t t : facets->triangles_of(facet)) {
      for (const EdgeUse& use : welded.uses_of_triangle(t)) {
        outline.insert({welded.edges[use.edge].a, welded.edges[use.edge].b});
      }
    }
    std::set<std::uint32_t> found;
    for (const ContactEdge& contact : facets->contacts.of_facet(facet)) {
      for (const std::uint32_t v : {welded.edges[contact.edge].a, welded.edges[contact.edge].b}) {
        if (outline.contains(v)) {
          found.insert(v);
        }
      }
    }
    return found;
  }
  // Vertices that divide edges of triangles.
  std::size_t divisions() const {
    std::set<std::uint32_t> dividing;
    for (std::uint32_t use = 0; use < welded.first_use.back(); ++use) {
      const Edge& edge = welded.edges[welded.uses_by_triangle[use].edge];
      for (const std::uint32_t v : {edge.a, edge.b}) {
        if (v >= vertices_before) {
          dividing.insert(v);
        }
      }
    }
    return dividing.size();
  }

  test::TestHost host;
  const Scene& scene;
  WeldedScene welded;
  std::optional<Facets> facets;
  std::size_t vertices_before = 0;
};

std::pmr::memory_resource* heap() {
  return std::pmr::get_default_resource();
}

SceneBuilder& floor_of(SceneBuilder& builder, float size) {
  return builder.polygon({{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}});
}

const std::vector<Found::Line> k_footprint = {{3000, 4000, 0, 3000, 6000, 0},
                                              {3000, 4000, 0, 5000, 4000, 0},
                                              {3000, 6000, 0, 5000, 6000, 0},
                                              {5000, 4000, 0, 5000, 6000, 0}};

TEST(Contacts, ABoxOnAFloorLeavesItsFootprint) {
  for (const bool open_below : {false, true}) {
    SceneBuilder builder(heap());
    floor_of(builder, 10);
    builder.mesh();
    if (open_below) {
      builder.polygon({{3, 4, 0}, {5, 4, 0}, {5, 4, 1}, {3, 4, 1}});
      builder.polygon({{5, 4, 0}, {5, 6, 0}, {5, 6, 1}, {5, 4, 1}});
      builder.polygon({{5, 6, 0}, {3, 6, 0}, {3, 6, 1}, {5, 6, 1}});
      builder.polygon({{3, 6, 0}, {3, 4, 0}, {3, 4, 1}, {3, 6, 1}});
    } else {
      builder.box({3, 4, 0}, {5, 6, 1});
    }
    const Found found(builder.scene);
    EXPECT_EQ(found.lines_on(found.facet_at({1, 1, 0}, {0, 0, 1})), k_footprint);
    EXPECT_EQ(found.facets->contacts.edges.size(), 4u);  // the box's own sides meet the floor in their borders
    EXPECT_EQ(found.divisions(), 0u);
  }
}

TEST(Contacts, WhatStaysBehindASurfaceDoesNotMatterToIt) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.polygon({{3, 4, -1}, {5, 4, -1}, {5, 4, 0}, {3, 4, 0}});  // hangs below
  EXPECT_TRUE(Found(builder.scene).facets->contacts.edges.empty());
  Scene both = builder.scene;
  both.materials[0].two_sided = true;
  const Found found(both);
  EXPECT_EQ(found.lines_on(found.facet_at({1, 1, 0}, {0, 0, 1})),
            (std::vector<Found::Line>{{3000, 4000, 0, 5000, 4000, 0}}));
}

TEST(Contacts, OnlyWhatCastsAndOnWhatReceives) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.box({3, 4, -1}, {5, 6, 1});
  Scene ghost = builder.scene;
  ghost.meshes[1].casts = false;
  EXPECT_TRUE(Found(ghost).facets->contacts.of_facet(0).empty());
  Scene blind = builder.scene;
  blind.meshes[1].receives = false;
  const Found found(blind);
  EXPECT_EQ(found.facets->contacts.edges.size(), 4u);  // on the floor; none on the box's sides
}

TEST(Contacts, ABoxThroughAFloorCutsBoth) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.box({3, 4, -1}, {5, 6, 1});
  const Found found(builder.scene);
  EXPECT_EQ(found.lines_on(found.facet_at({1, 1, 0}, {0, 0, 1})), k_footprint);
  for (const auto& [point, normal, line] : {std::tuple(Vec3(4, 4, 0.5), Vec3(0, -1, 0), k_footprint[1]),
                                            std::tuple(Vec3(4, 6, 0.5), Vec3(0, 1, 0), k_footprint[2]),
                                            std::tuple(Vec3(3, 5, 0.5), Vec3(-1, 0, 0), k_footprint[0]),
                                            std::tuple(Vec3(5, 5, 0.5), Vec3(1, 0, 0), k_footprint[3])}) {
    EXPECT_EQ(found.lines_on(found.facet_at(point, normal)), std::vector<Found::Line>{line});
  }
  EXPECT_EQ(found.divisions(), 4u);  // the box's upright edges, where the floor cuts them
}

TEST(Contacts, AWallAcrossAFloorDividesTheFloorsBorder) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.polygon({{0, 0, -1}, {10, 0, -1}, {10, 0, 0}, {0, 0, 0}});  // a front below the floor's edge y = 0
  builder.mesh();
  builder.polygon({{4, -1, -2}, {4, 11, -2}, {4, 11, 3}, {4, -1, 3}}, 2);
  const Found found(builder.scene);
  EXPECT_EQ(found.lines_on(found.facet_at({1, 1, 0}, {0, 0, 1})),
            (std::vector<Found::Line>{{4000, 0, 0, 4000, 10000, 0}}));
  EXPECT_EQ(found.lines_on(found.facet_at({1, 0, -0.5}, {0, -1, 0})),
            (std::vector<Found::Line>{{4000, 0, -1000, 4000, 0, 0}}));
  // The wall has both lines, and they meet.
  EXPECT_EQ(found.lines_on(found.facet_at({4, 5, 2}, {1, 0, 0})),
            (std::vector<Found::Line>{{4000, 0, -1000, 4000, 0, 0}, {4000, 0, 0, 4000, 10000, 0}}));
  EXPECT_EQ(found.divisions(), 3u);  // both sides of the edge between floor and front have the same vertex
}

TEST(Contacts, CoplanarOverlapsHaveEachOthersOutlines) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.polygon({{6, 6, 0}, {14, 6, 0}, {14, 14, 0}, {6, 14, 0}}, 1);
  const Found found(builder.scene);
  EXPECT_EQ(found.lines_on(found.facet_at({1, 1, 0}, {0, 0, 1})),
            (std::vector<Found::Line>{{6000, 6000, 0, 6000, 10000, 0}, {6000, 6000, 0, 10000, 6000, 0}}));
  EXPECT_EQ(found.lines_on(found.facet_at({13, 13, 0}, {0, 0, 1})),
            (std::vector<Found::Line>{{6000, 10000, 0, 10000, 10000, 0}, {10000, 6000, 0, 10000, 10000, 0}}));
  EXPECT_EQ(found.divisions(), 4u);  // two of either's sides
}

TEST(Contacts, WhatGoesOnInThePlaneHasNoEndInside) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.polygon({{2, 3, 0}, {4, 3, 0}, {4, 6, 0}, {2, 6, 0}}, 0);
  builder.polygon({{4, 3, 0}, {6, 3, 0}, {6, 6, 0}, {4, 6, 0}}, 1);  // another material: another facet
  const Found found(builder.scene);
  EXPECT_EQ(found.lines_on(found.facet_at({1, 1, 0}, {0, 0, 1})),
            (std::vector<Found::Line>{{2000, 3000, 0, 2000, 6000, 0},
                                      {2000, 3000, 0, 6000, 3000, 0},
                                      {2000, 6000, 0, 6000, 6000, 0},
                                      {6000, 3000, 0, 6000, 6000, 0}}));
}

// Two slopes that meet in a smooth edge at x = 5.
SceneBuilder& slopes(SceneBuilder& builder) {
  builder.polygon({{0, 0, 0}, {5, 0, 0.25}, {5, 10, 0.25}, {0, 10, 0}});
  return builder.polygon({{5, 0, 0.25}, {10, 0, 0}, {10, 10, 0}, {5, 10, 0.25}});
}

TEST(Contacts, BothSidesOfASmoothEdgeShareItsNewVertex) {
  SceneBuilder builder(heap());
  slopes(builder);
  builder.mesh();
  builder.polygon({{2, 4, -1}, {8, 4, -1}, {8, 4, 2}, {2, 4, 2}}, 2);
  const Found found(builder.scene);
  std::set<std::uint32_t> shared;
  for (const std::uint32_t facet : {found.facet_at({1, 1, 0.05}, {0, 0, 1}), found.facet_at({9, 1, 0.05}, {0, 0, 1})}) {
    ASSERT_EQ(found.facets->contacts.of_facet(facet).size(), 1u);
    for (const std::uint32_t vertex : found.ends_on_outline(facet)) {
      shared.insert(vertex);
      EXPECT_NEAR(glm::distance(found.welded.positions[vertex], Vec3(5, 4, 0.25)), 0, 1e-6);
    }
  }
  EXPECT_EQ(shared.size(), 1u);
  EXPECT_EQ(std::ranges::count(found.facets->edge_kinds, EdgeKind::smooth), 2);
}

TEST(Contacts, ASmoothEdgeWithAWallOnItIsSharp) {
  SceneBuilder builder(heap());
  slopes(builder);
  builder.mesh();
  builder.polygon({{5, 2, -1}, {5, 7, -1}, {5, 7, 2}, {5, 2, 2}}, 2);
  const Found found(builder.scene);
  double sharp = 0;
  for (std::uint32_t e = 0; e < found.welded.edges.size(); ++e) {
    const Vec3 a = found.welded.positions[found.welded.edges[e].a];
    const Vec3 b = found.welded.positions[found.welded.edges[e].b];
    if (a.x == 5 && b.x == 5 && a.z == 0.25 && b.z == 0.25 && found.welded.uses_at_edge(e).size() == 2) {
      const bool under_wall = std::min(a.y, b.y) > 1.9 && std::max(a.y, b.y) < 7.1;
      EXPECT_EQ(found.facets->edge_kinds[e], under_wall ? EdgeKind::sharp : EdgeKind::smooth);
      sharp += under_wall ? glm::distance(a, b) : 0;
    }
  }
  EXPECT_NEAR(sharp, 5, 1e-6);
  EXPECT_TRUE(found.facets->contacts.of_facet(found.facet_at({1, 1, 0.05}, {0, 0, 1})).empty());
}

TEST(Contacts, NeighboursAtASharpAngleDoNotDivideSmoothEdges) {
  // A tube of narrow quads with normals of its own: each triangle is a facet, and lies in its neighbour's plane.
  SceneBuilder builder(heap());
  Mesh& mesh = builder.mesh();
  for (std::uint32_t k = 0; k < 24; ++k) {
    const double angle = 2 * std::numbers::pi * k / 24;
    for (const float z : {0.0f, 2.0f}) {
      mesh.positions.emplace_back(std::cos(angle), std::sin(angle), z);
      mesh.normals.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
    }
    const std::uint32_t a = 2 * k;
    const std::uint32_t b = 2 * ((k + 1) % 24);
    mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    mesh.triangle_materials.insert(mesh.triangle_materials.end(), {0, 0});
  }
  for (const double least : {0.0, 0.04}) {
    const Found found(builder.scene, 0.01, least, 2, 0.1);
    EXPECT_TRUE(found.facets->contacts.edges.empty());
    EXPECT_EQ(found.divisions(), 0u);
    EXPECT_EQ(std::ranges::count(found.facets->edge_kinds, EdgeKind::sharp), 48);
  }
}

TEST(Contacts, ClosedSmoothBodiesAndRoomsHaveNone) {
  SceneBuilder builder(heap());
  builder.cylinder(40, 1.0f, 2.0f);
  builder.mesh();
  builder.box({5, 5, 5}, {7, 8, 9});
  const Found found(builder.scene);
  EXPECT_TRUE(found.facets->contacts.edges.empty());
  EXPECT_EQ(found.divisions(), 0u);
}

TEST(Contacts, WhatIsTooSmallIsLeftOut) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.box({3, 4, 0}, {3.1f, 4.1f, 1});
  EXPECT_EQ(Found(builder.scene, 0.5, 0.2).facets->contacts.edges.size(), 0u);
  EXPECT_EQ(Found(builder.scene, 0.5, 0.1).facets->contacts.edges.size(), 4u);
  EXPECT_EQ(Found(builder.scene, 20, 0).facets->contacts.edges.size(), 0u);  // no facet is as large as the spacing
}

TEST(Contacts, ALampJustUnderACeilingLeavesItsOutlineAndTheGap) {
  SceneBuilder builder(heap());
  builder.polygon({{0, 0, 3}, {0, 10, 3}, {10, 10, 3}, {10, 0, 3}});  // faces down
  builder.mesh();
  builder.box({3, 4, 2.5f}, {5, 6, 2.99f});
  const auto outline = [](int z) {
    std::vector<Found::Line> lines = k_footprint;
    for (Found::Line& line : lines) {
      line[2] = line[5] = z;
    }
    return lines;
  };
  const Found found(builder.scene, 0.1, 0.01, 2, 0.1);
  const std::uint32_t ceiling = found.facet_at({1, 1, 3}, {0, 0, -1});
  EXPECT_EQ(found.lines_on(ceiling), outline(3000));
  for (const ContactEdge& contact : found.facets->contacts.of_facet(ceiling)) {
    EXPECT_NEAR(contact.gap, 0.01, 1e-6);
  }
  EXPECT_EQ(found.facets->contacts.edges.size(), 4u);  // the lamp's top is in the middle of the ceiling's shadow
  EXPECT_TRUE(Found(builder.scene, 0.1, 0.01, 2, 0.005).facets->contacts.edges.empty());
  EXPECT_TRUE(Found(builder.scene, 0.1, 0.01, 2, 0).facets->contacts.edges.empty());
}

TEST(Contacts, AShelfOfGlassAboveAFloorHasOneOutline) {
  // Top and bottom of a thin plate have the same outline: the nearer one's gap counts. What leans away leaves what is
  // near it soon, and the foot of a box is no near surface as well.
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.box({3, 4, 0.02f}, {5, 6, 0.03f});
  builder.mesh();
  builder.box({7, 7, 0}, {8, 8, 1});
  builder.mesh();
  builder.polygon({{1, 8, 0.02f}, {2, 8, 0.02f}, {2, 9, 1.02f}, {1, 9, 1.02f}}, 2);
  const Found found(builder.scene, 0.1, 0.01, 2, 0.1);
  const std::uint32_t floor = found.facet_at({1, 1, 0}, {0, 0, 1});
  std::size_t touching = 0;
  for (const ContactEdge& contact : found.facets->contacts.of_facet(floor)) {
    touching += contact.gap == 0 ? 1 : 0;
    EXPECT_TRUE(contact.gap == 0 || std::abs(contact.gap - 0.02) < 1e-6) << contact.gap;
  }
  EXPECT_EQ(touching, 4u);
  EXPECT_EQ(found.facets->contacts.of_facet(floor).size(), 4u + 4u + 1u);
}

SceneBuilder random_boxes(std::uint32_t seed, int count) {
  SceneBuilder builder(heap());
  test::RandomNumbers random(seed);
  floor_of(builder, 10);
  for (int k = 0; k < count; ++k) {
    builder.mesh();
    glm::vec3 low = random.vector_between(0, 8);
    low.z = k % 3 == 0 ? 0.0f : low.z - 4;
    builder.box(low, low + random.vector_between(0.3f, 3));
    if (k % 2 == 1) {  // turned about a slanted axis
      const double angle = random.between(0.3f, 3);
      const double c = std::cos(angle), s = std::sin(angle);
      builder.scene.meshes.back().transform = {c,    -s, 0,       4 * (1 - c + s), 0.8 * s, 0.8 * c,
                                               -0.6, 1,  0.6 * s, 0.6 * c,         0.8,     -3};
    }
  }
  return builder;
}

// The segments of a facet meet in their ends alone; they lie in the facet.
void expect_planar(const Found& found) {
  for (std::uint32_t f = 0; f < found.facets->facets.size(); ++f) {
    const Frame& frame = found.facets->facets[f].frame;
    const double slack = 1e-5 * 20;
    std::vector<std::pair<Vec2, Vec2>> segments;
    for (const ContactEdge& contact : found.facets->contacts.of_facet(f)) {
      const Edge& edge = found.welded.edges[contact.edge];
      const Vec3 a = found.welded.positions[edge.a];
      const Vec3 b = found.welded.positions[edge.b];
      ASSERT_GT(glm::distance(a, b), 0);
      ASSERT_LT(std::abs(dot(a - frame.origin, frame.normal)), slack);
      ASSERT_LT(std::abs(dot(b - frame.origin, frame.normal)), slack);
      bool inside = false;
      for (const std::uint32_t t : found.facets->triangles_of(f)) {
        const Vec3 w = barycentric(positions_of(found.welded, found.welded.triangles[t]), 0.5 * (a + b));
        inside = inside || std::min({w.x, w.y, w.z}) > -slack;
      }
      ASSERT_TRUE(inside) << "facet " << f;
      segments.emplace_back(frame.to_plane(a), frame.to_plane(b));
    }
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const auto& [a, b] = segments[i];
      for (std::size_t j = 0; j < i; ++j) {
        const auto& [c, d] = segments[j];
        // Proper crossings deeper than the tolerance.
        const auto straddles = [&](const Vec2& from, const Vec2& to, const Vec2& p, const Vec2& q) {
          const double depth_p = cross(to - from, p - from) / glm::distance(from, to);
          const double depth_q = cross(to - from, q - from) / glm::distance(from, to);
          return std::min(depth_p, depth_q) < -slack && std::max(depth_p, depth_q) > slack;
        };
        ASSERT_FALSE(straddles(a, b, c, d) && straddles(c, d, a, b)) << "facet " << f << ", " << j << " and " << i;
      }
    }
  }
}

TEST(Contacts, RandomBoxesThroughBoxesMakePlanarGraphs) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const SceneBuilder builder = random_boxes(seed, 3 + int(seed));
    const Found found(builder.scene);
    EXPECT_GE(found.facets->contacts.edges.size(), 4u);
    expect_planar(found);
  }
}

// The facets at an edge found where it is cut each in its own plane, millionths apart, and the edge got a vertex for
// each.
TEST(Contacts, AnEdgeHasOneVertexForAllItsFacetsWhereItIsCut) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const SceneBuilder builder = random_boxes(seed, 12);
    const Found found(builder.scene);
    for (const Edge& edge : found.welded.edges) {
      EXPECT_GT(glm::distance(found.welded.positions[edge.a], found.welded.positions[edge.b]), 5e-5) << "seed " << seed;
    }
  }
}

TEST(Contacts, HundredsOnOneFloor) {
  const SceneBuilder builder = random_boxes(99, 300);
  const Found found(builder.scene);
  EXPECT_GT(found.facets->contacts.of_facet(found.facet_at({0.01, 0.01, 0}, {0, 0, 1})).size(), 500u);
  expect_planar(found);
}

TEST(Contacts, TheSameForAnyNumberOfThreads) {
  const SceneBuilder builder = random_boxes(5, 40);
  const Found one(builder.scene, 0.01, 0, 1);
  for (const std::uint32_t threads : {2u, 3u}) {
    const Found other(builder.scene, 0.01, 0, threads);
    ASSERT_EQ(one.welded.positions.size(), other.welded.positions.size());
    for (std::size_t k = 0; k < one.welded.positions.size(); ++k) {
      EXPECT_EQ(one.welded.positions[k], other.welded.positions[k]);
    }
    ASSERT_EQ(one.facets->contacts.edges.size(), other.facets->contacts.edges.size());
    for (std::size_t k = 0; k < one.facets->contacts.edges.size(); ++k) {
      const Edge& edge = one.welded.edges[one.facets->contacts.edges[k].edge];
      const Edge& same = other.welded.edges[other.facets->contacts.edges[k].edge];
      EXPECT_EQ(edge.a, same.a);
      EXPECT_EQ(edge.b, same.b);
    }
  }
}

TEST(Contacts, NothingThrowsOnSliversAndDoubles) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    SceneBuilder builder(heap());
    for (int k = 0; k < 60; ++k) {
      const float flat = k % 4 == 0 ? 1e-6f : k % 4 == 1 ? 0.0f : 1.0f;
      glm::vec3 a(uniform(random), uniform(random), flat * uniform(random));
      glm::vec3 b(uniform(random), uniform(random), flat * uniform(random));
      glm::vec3 c = k % 5 == 0 ? a + 0.5f * (b - a) + glm::vec3(0, 1e-5f * uniform(random), 0)
                               : glm::vec3(uniform(random), uniform(random), flat * uniform(random));
      if (k % 7 == 0) {  // on a coarse grid: many coincidences
        a = glm::round(a * 2.0f), b = glm::round(b * 2.0f), c = glm::round(c * 2.0f);
      }
      builder.polygon({a, b, c}, std::uint32_t(k % 3));
    }
    const Found found(builder.scene, 1e-3, trial % 2 == 0 ? 0 : 1e-3);
    expect_planar(found);
  }
}

}  // namespace
}  // namespace radvor
