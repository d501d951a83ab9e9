// What counts as near to a circle where ties are aligned.
#include "delaunay/tie_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "delaunay/triangulation.h"

namespace radvor::delaunay {
namespace {

constexpr double k_near = 0x1p-10;

// Corners of the polygon about each triangle.
std::vector<std::uint32_t> sizes(const Triangulation& triangulation) {
  TiePolygon polygon(std::pmr::get_default_resource());
  const std::vector<std::uint8_t> none(triangulation.triangle_bound(), 0);
  std::vector<std::uint32_t> found;
  for (TriangleId t = 0; t < triangulation.triangle_bound(); ++t) {
    if (triangulation.is_triangle(t)) {
      found.push_back(polygon.collect_near(triangulation, t, k_near, none));
    }
  }
  return found;
}

TEST(TiePolygon, RectanglesOfAnyShapeAreTies) {
  for (const double height : {1.0, 0.1, 1e-3, 1e-6}) {
    for (const double off : {0.0, 1e-4, -1e-4}) {
      Triangulation triangulation(std::pmr::get_default_resource());
      const std::vector<Vec2> points = {{0, 0}, {1, 0}, {1, height}, {0, height * (1 + off)}};
      triangulation.insert_many(points, nullptr);
      EXPECT_EQ(sizes(triangulation), (std::vector<std::uint32_t>{4, 4})) << height << " " << off;
    }
  }
}

// By its determinant every point is near the circle of a triangle that has next to no area, and whose circle is small:
// one with two corners beside each other.
TEST(TiePolygon, NeedlesDoNotTakeWhatLiesElsewhere) {
  for (const double beside : {1e-3, 1e-6, 1e-9, 1e-12}) {
    Triangulation triangulation(std::pmr::get_default_resource());
    std::vector<Vec2> points = {{0.51, 0.52}, {0.51 + beside, 0.52}};
    for (int i = 0; i <= 16; ++i) {
      for (int j = 0; j <= 16; ++j) {
        points.emplace_back(i / 16.0, j / 16.0);
      }
    }
    triangulation.insert_many(points, nullptr);
    const std::vector<std::uint32_t> found = sizes(triangulation);
    EXPECT_LE(*std::max_element(found.begin(), found.end()), 6u) << beside;
    EXPECT_GT(std::count(found.begin(), found.end(), 4u), 480) << "squares are ties";
  }
}

}  // namespace
}  // namespace radvor::delaunay
