// Cells of a lone triangle's corners against brute force: acute, obtuse, needles.
#include "surface/triangle_cells.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace radvor {
namespace {

bool inside(const CornerCell& cell, const Vec2& point, double tolerance) {
  for (std::uint32_t k = 0; k < cell.count; ++k) {
    if (doubled_area(cell.points[k], cell.points[(k + 1) % cell.count], point) < -tolerance) {
      return false;
    }
  }
  return cell.count > 0;
}

double polygon_area(const CornerCell& cell) {
  double doubled = 0;
  for (std::uint32_t k = 1; k + 1 < cell.count; ++k) {
    doubled += doubled_area(cell.points[0], cell.points[k], cell.points[k + 1]);
  }
  return 0.5 * doubled;
}

void check(const std::array<Vec2, 3>& corners, std::mt19937& random) {
  const double area = 0.5 * doubled_area(corners[0], corners[1], corners[2]);
  ASSERT_GT(area, 0);
  const auto cells = triangle_cells(corners);
  EXPECT_NEAR(cells[0].area + cells[1].area + cells[2].area, area, 1e-14 * area);
  for (std::uint32_t k = 0; k < 3; ++k) {
    EXPECT_GT(cells[k].area, 0);
    EXPECT_NEAR(polygon_area(cells[k]), cells[k].area, 1e-12 * area);
    EXPECT_EQ(cells[k].points[0], corners[k]);
    EXPECT_TRUE(inside(cells[k], cells[k].centroid, 0));
  }
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    double u = uniform(random);
    double v = uniform(random);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec2 point = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
    std::uint32_t nearest = 0;
    for (std::uint32_t k = 1; k < 3; ++k) {
      nearest = glm::distance(point, corners[k]) < glm::distance(point, corners[nearest]) ? k : nearest;
    }
    EXPECT_TRUE(inside(cells[nearest], point, 1e-12 * area)) << point.x << " " << point.y;
  }
}

TEST(TriangleCells, BelongToTheNearestCorner) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  check({Vec2(0, 0), Vec2(1, 0), Vec2(0.5, 0.8)}, random);
  check({Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}, random);  // right
  check({Vec2(0, 0), Vec2(10, 0), Vec2(4, 0.5)}, random);
  for (int trial = 0; trial < 500; ++trial) {
    std::array<Vec2, 3> corners;
    for (Vec2& corner : corners) {
      corner = {uniform(random), uniform(random)};
    }
    if (doubled_area(corners[0], corners[1], corners[2]) < 0) {
      std::swap(corners[1], corners[2]);
    }
    check(corners, random);
  }
}

TEST(TriangleCells, AreasOfNeedlesSumToTheTriangle) {
  // Differences of these coordinates are exact, as they are on a facet's snapped plane.
  for (const double width : {0x1p-10, 0x1p-20, 0x1p-30, 0x1p-39}) {
    for (const double foot : {0.0, 0.125, 0.5, 0.9375, 1.0}) {
      const Vec2 along(0.75, 0.4375);
      const Vec2 across(-0.4375 * width, 0.75 * width);
      const std::array<Vec2, 3> corners = {Vec2(0, 0), along, foot * along + across};
      const double area = 0.5 * width * glm::dot(along, along);
      const auto cells = triangle_cells(corners);
      EXPECT_NEAR(cells[0].area + cells[1].area + cells[2].area, area, 1e-12 * area) << width << " " << foot;
      for (const CornerCell& cell : cells) {
        EXPECT_GE(cell.area, 0);
      }
    }
  }
}

TEST(TriangleCells, OfNoAreaAreEmpty) {
  for (const CornerCell& cell : triangle_cells({Vec2(0, 0), Vec2(1, 1), Vec2(2, 2)})) {
    EXPECT_EQ(cell.count, 0u);
    EXPECT_EQ(cell.area, 0);
    EXPECT_NEAR(cell.centroid.x, 1, 1e-15);
  }
}

}  // namespace
}  // namespace radvor
