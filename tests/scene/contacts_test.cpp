// Where surfaces touch and cut each other: scenes whose contacts are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <vector>

#include "scene/found_contacts.h"

namespace radvor {
namespace {

using test::floor_of;
using test::Found;
using test::heap;
using test::SceneBuilder;

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
    EXPECT_EQ(found.facets.contacts.edges.size(), 4u);  // the box's own sides meet the floor in their borders
    EXPECT_EQ(found.divisions(), 0u);
  }
}

TEST(Contacts, WhatStaysBehindASurfaceDoesNotMatterToIt) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.polygon({{3, 4, -1}, {5, 4, -1}, {5, 4, 0}, {3, 4, 0}});  // hangs below
  EXPECT_TRUE(Found(builder.scene).facets.contacts.edges.empty());
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
  EXPECT_TRUE(Found(ghost).facets.contacts.of_facet(0).empty());
  Scene blind = builder.scene;
  blind.meshes[1].receives = false;
  const Found found(blind);
  EXPECT_EQ(found.facets.contacts.edges.size(), 4u);  // on the floor; none on the box's sides
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
    ASSERT_EQ(found.facets.contacts.of_facet(facet).size(), 1u);
    for (const std::uint32_t vertex : found.ends_on_outline(facet)) {
      shared.insert(vertex);
      EXPECT_NEAR(glm::distance(found.welded.positions[vertex], Vec3(5, 4, 0.25)), 0, 1e-6);
    }
  }
  EXPECT_EQ(shared.size(), 1u);
  EXPECT_EQ(std::ranges::count(found.facets.edge_kinds, EdgeKind::smooth), 2);
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
      EXPECT_EQ(found.facets.edge_kinds[e], under_wall ? EdgeKind::sharp : EdgeKind::smooth);
      sharp += under_wall ? glm::distance(a, b) : 0;
    }
  }
  EXPECT_NEAR(sharp, 5, 1e-6);
  EXPECT_TRUE(found.facets.contacts.of_facet(found.facet_at({1, 1, 0.05}, {0, 0, 1})).empty());
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
    EXPECT_TRUE(found.facets.contacts.edges.empty());
    EXPECT_EQ(found.divisions(), 0u);
    EXPECT_EQ(std::ranges::count(found.facets.edge_kinds, EdgeKind::sharp), 48);
  }
}

TEST(Contacts, ClosedSmoothBodiesAndRoomsHaveNone) {
  SceneBuilder builder(heap());
  builder.cylinder(40, 1.0f, 2.0f);
  builder.mesh();
  builder.box({5, 5, 5}, {7, 8, 9});
  const Found found(builder.scene);
  EXPECT_TRUE(found.facets.contacts.edges.empty());
  EXPECT_EQ(found.divisions(), 0u);
}

TEST(Contacts, WhatIsTooSmallIsLeftOut) {
  SceneBuilder builder(heap());
  floor_of(builder, 10);
  builder.mesh();
  builder.box({3, 4, 0}, {3.1f, 4.1f, 1});
  EXPECT_EQ(Found(builder.scene, 0.5, 0.2).facets.contacts.edges.size(), 0u);
  EXPECT_EQ(Found(builder.scene, 0.5, 0.1).facets.contacts.edges.size(), 4u);
  EXPECT_EQ(Found(builder.scene, 20, 0).facets.contacts.edges.size(), 0u);  // no facet is as large as the spacing
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
  for (const ContactEdge& contact : found.facets.contacts.of_facet(ceiling)) {
    EXPECT_NEAR(contact.gap, 0.01, 1e-6);
  }
  EXPECT_EQ(found.facets.contacts.edges.size(), 4u);  // the lamp's top is in the middle of the ceiling's shadow
  EXPECT_TRUE(Found(builder.scene, 0.1, 0.01, 2, 0.005).facets.contacts.edges.empty());
  EXPECT_TRUE(Found(builder.scene, 0.1, 0.01, 2, 0).facets.contacts.edges.empty());
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
  for (const ContactEdge& contact : found.facets.contacts.of_facet(floor)) {
    touching += contact.gap == 0 ? 1 : 0;
    EXPECT_TRUE(contact.gap == 0 || std::abs(contact.gap - 0.02) < 1e-6) << contact.gap;
  }
  EXPECT_EQ(touching, 4u);
  EXPECT_EQ(found.facets.contacts.of_facet(floor).size(), 4u + 4u + 1u);
}

}  // namespace
}  // namespace radvor
