// Triangulation of faces: the area is kept, every triangle winds as the polygon does, nothing sticks out.
#include "polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace bake {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Polygon = std::vector<glm::dvec3>;

glm::dvec3 vector_area(const Polygon& polygon) {
  glm::dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return sum / 2.0;
}

/// Triangles that all wind as the polygon does, and whose areas sum to the polygon's, neither overlap nor stick out.
void expect_tiles(const Polygon& polygon) {
  Triangles triangles;
  EXPECT_TRUE(triangulate(polygon, triangles));
  const glm::dvec3 whole = vector_area(polygon);
  const glm::dvec3 normal = glm::normalize(whole);
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const double area = glm::dot(glm::cross(polygon[b] - polygon[a], polygon[c] - polygon[a]), normal) / 2;
    EXPECT_GT(area, 0);
    sum += area;
  }
  EXPECT_NEAR(sum, glm::length(whole), 1e-12 * glm::length(whole));
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
}

/// Every starting corner, both windings, three planes, far from the origin too.
void expect_tiles_however_turned(const std::vector<std::array<double, 2>>& outline) {
  for (std::size_t start = 0; start < outline.size(); ++start) {
    for (int plane = 0; plane < 6; ++plane) {
      Polygon polygon;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto& [u, v] = outline[(start + i) % outline.size()];
        glm::dvec3 corner(1000, -700, 300);
        corner[plane % 3] += u;
        corner[(plane + 1) % 3] += v;
        corner[(plane + 2) % 3] += 0.25 * u;  // not along an axis
        polygon.push_back(corner);
      }
      if (plane >= 3) {
        polygon = Polygon(polygon.rbegin(), polygon.rend());
      }
      expect_tiles(polygon);
    }
  }
}

TEST(Polygon, ConvexQuadIsCutAlongTheShorterDiagonal) {
  Triangles triangles;
  EXPECT_TRUE(triangulate(Polygon{{0, 0, 0}, {4, 0, 0}, {5, 1, 0}, {0, 1, 0}}, triangles));
  EXPECT_EQ(triangles, (Triangles{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_TRUE(triangulate(Polygon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {-1, 1, 0}}, triangles));
  EXPECT_EQ(triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, ConcaveQuadIsCutInsideEvenWhereThatDiagonalIsTheLongerOne) {
  const Polygon arrow{{0, 0, 0}, {10, 1, 0}, {1, 0, 0}, {10, -1, 0}};  // the dent is at corner 2
  expect_tiles(Polygon(arrow.rbegin(), arrow.rend()));
  expect_tiles_however_turned({{{0, 0}, {10, -1}, {1, 0}, {10, 1}}});
}

TEST(Polygon, ConcaveQuadThatIsNotPlanar) {
  Triangles triangles;
  EXPECT_TRUE(triangulate(Polygon{{0, 0, 0}, {10, -1, 0.2}, {1, 0, -0.1}, {10, 1, 0.2}}, triangles));
  EXPECT_EQ(triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, EarsOfConcavePolygons) {
  expect_tiles_however_turned({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});                  // L
  expect_tiles_however_turned({{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}});  // U
  expect_tiles_however_turned({{0, 0}, {1, 3}, {2, 0}, {3, 3}, {4, 0}, {4, 4}, {0, 4}});          // saw
  std::vector<std::array<double, 2>> star;
  for (int i = 0; i < 24; ++i) {
    const double radius = i % 2 == 0 ? 3 : 1;
    star.push_back({radius * std::cos(i * std::numbers::pi / 12), radius * std::sin(i * std::numbers::pi / 12)});
  }
  expect_tiles_however_turned(star);
}

TEST(Polygon, CollinearCornersStayCorners) {
  // A square with a vertex in the middle of each side: all eight must be used, or neighbours would have T-junctions.
  const Polygon square{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  expect_tiles(square);
}

TEST(Polygon, BridgeToAHole) {
  // A square frame, its outline joined to its hole by a cut that is walked both ways.
  expect_tiles(
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}});
}

TEST(Polygon, CrossedOrFlatOnesAreReported) {
  Triangles triangles;
  EXPECT_FALSE(triangulate(Polygon{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, triangles));
  EXPECT_FALSE(triangulate(Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, triangles));
  EXPECT_FALSE(triangulate(Polygon{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 1, 0}}, triangles));
  EXPECT_FALSE(triangulate(Polygon{{0, 0, 0}, {1, 0, 0}}, triangles));
}

}  // namespace
}  // namespace bake
