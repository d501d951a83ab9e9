// Where surfaces touch and cut each other: properties of random scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "scene/found_contacts.h"
#include "support/random_numbers.h"

namespace radvor {
namespace {

using test::floor_of;
using test::Found;
using test::heap;
using test::SceneBuilder;

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
  for (std::uint32_t f = 0; f < found.facets.facets.size(); ++f) {
    const Frame& frame = found.facets.facets[f].frame;
    const double slack = 1e-5 * 20;
    std::vector<std::pair<Vec2, Vec2>> segments;
    for (const ContactEdge& contact : found.facets.contacts.of_facet(f)) {
      const Edge& edge = found.welded.edges[contact.edge];
      const Vec3 a = found.welded.positions[edge.a];
      const Vec3 b = found.welded.positions[edge.b];
      ASSERT_GT(glm::distance(a, b), 0);
      ASSERT_LT(std::abs(dot(a - frame.origin, frame.normal)), slack);
      ASSERT_LT(std::abs(dot(b - frame.origin, frame.normal)), slack);
      bool inside = false;
      for (const std::uint32_t t : found.facets.triangles_of(f)) {
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

TEST(RandomContacts, RandomBoxesThroughBoxesMakePlanarGraphs) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const SceneBuilder builder = random_boxes(seed, 3 + int(seed));
    const Found found(builder.scene);
    EXPECT_GE(found.facets.contacts.edges.size(), 4u);
    expect_planar(found);
  }
}

// The facets at an edge found where it is cut each in its own plane, millionths apart, and the edge got a vertex for
// each.
TEST(RandomContacts, AnEdgeHasOneVertexForAllItsFacetsWhereItIsCut) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const SceneBuilder builder = random_boxes(seed, 12);
    const Found found(builder.scene);
    for (const Edge& edge : found.welded.edges) {
      EXPECT_GT(glm::distance(found.welded.positions[edge.a], found.welded.positions[edge.b]), 5e-5) << "seed " << seed;
    }
  }
}

TEST(RandomContacts, HundredsOnOneFloor) {
  const SceneBuilder builder = random_boxes(99, 300);
  const Found found(builder.scene);
  EXPECT_GT(found.facets.contacts.of_facet(found.facet_at({0.01, 0.01, 0}, {0, 0, 1})).size(), 500u);
  expect_planar(found);
}

TEST(RandomContacts, TheSameForAnyNumberOfThreads) {
  const SceneBuilder builder = random_boxes(5, 40);
  const Found one(builder.scene, 0.01, 0, 1);
  for (const std::uint32_t threads : {2u, 3u}) {
    const Found other(builder.scene, 0.01, 0, threads);
    ASSERT_EQ(one.welded.positions.size(), other.welded.positions.size());
    for (std::size_t k = 0; k < one.welded.positions.size(); ++k) {
      EXPECT_EQ(one.welded.positions[k], other.welded.positions[k]);
    }
    ASSERT_EQ(one.facets.contacts.edges.size(), other.facets.contacts.edges.size());
    for (std::size_t k = 0; k < one.facets.contacts.edges.size(); ++k) {
      const Edge& edge = one.welded.edges[one.facets.contacts.edges[k].edge];
      const Edge& same = other.welded.edges[other.facets.contacts.edges[k].edge];
      EXPECT_EQ(edge.a, same.a);
      EXPECT_EQ(edge.b, same.b);
    }
  }
}

TEST(RandomContacts, NothingThrowsOnSliversAndDoubles) {
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
