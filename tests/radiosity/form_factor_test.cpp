// Form factors against closed forms: Howell's catalogue, the CIE 171 tables' exact values, sums over closed rooms.
#include "radiosity/form_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace radvor {
namespace {

constexpr double k_pi = 3.14159265358979323846;

using Polygon = std::vector<Vec3>;

Vec3 normal_of(const Polygon& p) {
  return glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
}

double factor(const Vec3& x, const Vec3& n, const Polygon& p) {
  return polygon_form_factor(x, n, p, normal_of(p));
}

// Six faces of an axis-parallel box, counter-clockwise seen from inside.
std::vector<Polygon> room(const Vec3& low, const Vec3& high) {
  const double x0 = low.x, y0 = low.y, z0 = low.z, x1 = high.x, y1 = high.y, z1 = high.z;
  return {{{x0, y0, z0}, {x1, y0, z0}, {x1, y1, z0}, {x0, y1, z0}},
          {{x0, y0, z1}, {x0, y1, z1}, {x1, y1, z1}, {x1, y0, z1}},
          {{x0, y0, z0}, {x0, y0, z1}, {x1, y0, z1}, {x1, y0, z0}},
          {{x0, y1, z0}, {x1, y1, z0}, {x1, y1, z1}, {x0, y1, z1}},
          {{x0, y0, z0}, {x0, y1, z0}, {x0, y1, z1}, {x0, y0, z1}},
          {{x1, y0, z0}, {x1, y0, z1}, {x1, y1, z1}, {x1, y1, z0}}};
}

TEST(PolygonFormFactor, AreaLightInRoomOfCie171Case53) {
  // CIE 171:2006, 5.3, closed form: a square of 1000 cd/m2 in the ceiling of a 4 x 4 x 3 m room.
  const Polygon light = {{1.5, 1.5, 3}, {1.5, 2.5, 3}, {2.5, 2.5, 3}, {2.5, 1.5, 3}};
  ASSERT_LT(normal_of(light).z, 0);
  const double wall[] = {32.676898, 75.193925, 81.323172, 69.060627, 53.403531, 40.001852};
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(1000 * k_pi * factor({2, 0, 2.75 - 0.5 * i}, {0, 1, 0}, light), wall[i], 1e-5) << i;
  }
  const double floor[] = {61.424099, 79.255157, 95.667276, 105.778242, 105.778242, 95.667276, 79.255157, 61.424099};
  for (int i = 0; i < 8; ++i) {
    EXPECT_NEAR(1000 * k_pi * factor({2, 0.25 + 0.5 * i, 0}, {0, 0, 1}, light), floor[i], 1e-5) << i;
  }
}

TEST(PolygonFormFactor, DiffusePatchesOfCie171Case56) {
  // CIE 171:2006, 5.6, closed form; in percent. The wall's points see the patch cut by their horizon.
  const double size[] = {4, 500};
  const double wall[2][6] = {{45.122604, 35.900505, 27.991624, 21.638511, 16.716315, 12.967372},
                             {49.943493, 49.830481, 49.71747, 49.604463, 49.491461, 49.378466}};
  const double ceiling[2][4] = {{26.795188, 30.938711, 33.975719, 35.566592},
                                {99.988217, 99.988217, 99.988218, 99.988218}};
  for (int s = 0; s < 2; ++s) {
    const double h = size[s] / 2;
    const Polygon patch = {{2 - h, 2 - h, 0}, {2 + h, 2 - h, 0}, {2 + h, 2 + h, 0}, {2 - h, 2 + h, 0}};
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(100 * factor({2, 0, 0.25 + 0.5 * i}, {0, 1, 0}, patch), wall[s][i], 2e-6);
    }
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(100 * factor({2, 0.25 + 0.5 * i, 3}, {0, 0, -1}, patch), ceiling[s][i], 2e-6);
    }
  }
}

TEST(PolygonFormFactor, AreaMeansOfHowellsSquares) {
  // Howell C-11 and C-14: unit squares, opposed at distance 1 and perpendicular with a common edge.
  const Polygon opposed = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const Polygon upright = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  ASSERT_GT(normal_of(upright).x, 0);
  const int count = 400;
  double mean_opposed = 0, mean_upright = 0;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const Vec3 x((i + 0.5) / count, (j + 0.5) / count, 0);
      mean_opposed += factor(x, {0, 0, 1}, opposed) / (count * count);
      mean_upright += factor(x, {0, 0, 1}, upright) / (count * count);
    }
  }
  EXPECT_NEAR(mean_opposed, 0.199824896, 1e-6);
  EXPECT_NEAR(mean_upright, 0.200043776, 1e-5);
}

TEST(PolygonFormFactor, DiskByManySidedPolygon) {
  // A disk of radius r at height h above the receiver, parallel: r^2 / (r^2 + h^2).
  const double r = 0.7, h = 0.4;
  const int sides = 20000;
  Polygon disk;
  for (int i = 0; i < sides; ++i) {
    const double angle = -2 * k_pi * i / sides;
    disk.push_back({r * std::cos(angle), r * std::sin(angle), h});
  }
  EXPECT_NEAR(polygon_form_factor({0, 0, 0}, {0, 0, 1}, disk, {0, 0, -1}), r * r / (r * r + h * h), 1e-7);
}

TEST(PolygonFormFactor, ClosedConvexRoomSumsToOneForAnyNormal) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.001, 0.999);
  const auto faces = room({-1, 2, 5}, {3, 3, 9});
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 x = Vec3(-1, 2, 5) + Vec3(4 * unit(random), unit(random), 4 * unit(random));
    const Vec3 n = glm::normalize(Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5));
    double sum = 0;
    for (const Polygon& face : faces) {
      sum += factor(x, n, face);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(PolygonFormFactor, InTheCornerTheWallsSumToOneHalfAndMore) {
  // On the floor, a hair from a wall that is endless for it: the wall fills half of the hemisphere.
  const Polygon wall = {{0, -1e6, 0}, {0, 1e6, 0}, {0, 1e6, 1e6}, {0, -1e6, 1e6}};
  EXPECT_NEAR(factor({1e-9, 0, 0}, {0, 0, 1}, wall), 0.5, 1e-6);
}

TEST(PolygonFormFactor, NothingFromBehindOrBelow) {
  const Polygon above = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};  // faces down
  const Polygon reversed(above.rbegin(), above.rend());
  EXPECT_GT(factor({0.3, 0.3, 0}, {0, 0, 1}, above), 0.1);
  EXPECT_EQ(factor({0.3, 0.3, 0}, {0, 0, 1}, reversed), 0);
  EXPECT_EQ(factor({0.3, 0.3, 2}, {0, 0, 1}, reversed), 0);
  EXPECT_EQ(factor({0.3, 0.3, 0}, {0, 0, -1}, above), 0);
}

TEST(PolygonFormFactor, ReflexPolygonsAreTheSumOfTheirParts) {
  const Polygon l_shape = {{0, 0, 1}, {0, 2, 1}, {1, 2, 1}, {1, 1, 1}, {2, 1, 1}, {2, 0, 1}};
  const Polygon left = {{0, 0, 1}, {0, 2, 1}, {1, 2, 1}, {1, 0, 1}};
  const Polygon right = {{1, 0, 1}, {1, 1, 1}, {2, 1, 1}, {2, 0, 1}};
  for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0.8, 0, 0.6), Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(-0.6, 0.8, 0)}) {
    const Vec3 x(1.3, 1.4, 0);
    EXPECT_NEAR(polygon_form_factor(x, n, l_shape, {0, 0, -1}), factor(x, n, left) + factor(x, n, right), 1e-14);
  }
}

TEST(KernelFormFactor, ConvergesWithTheFourthPowerForSymmetricPieces) {
  const double half = 0.5;
  const Polygon square = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  const PlanePiece piece = measure_polygon(square, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_NEAR(piece.area, 1, 1e-15);
  EXPECT_NEAR(piece.uu, 1.0 / 12, 1e-15);
  EXPECT_NEAR(piece.uv, 0, 1e-15);
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(0.5, 0.5, 0.70710678118654752)}) {
    const Vec3 n = glm::normalize(-direction + Vec3(0.1, 0.2, 0));
    double previous = 0;
    for (double distance : {4.0, 8.0, 16.0}) {
      const double exact = factor(direction * distance, n, square);
      const double error = std::abs(kernel_form_factor(direction * distance, n, piece) / exact - 1);
      EXPECT_LT(error, 3 * std::pow(distance, -4));
      if (previous > 0) {
        EXPECT_LT(error, previous / 12);
      }
      previous = error;
    }
  }
}

TEST(KernelFormFactor, JoinedPiecesHaveTheMomentsOfTheWhole) {
  const Polygon left = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}};
  const Polygon right = {{1, 0, 0}, {4, 0, 0}, {4, 2, 0}, {1, 2, 0}};
  const Polygon all = {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {0, 2, 0}};
  const Vec3 u(0.6, 0.8, 0), v(-0.8, 0.6, 0), n(0, 0, 1);
  const PlanePiece joined = join(measure_polygon(left, u, v, n), measure_polygon(right, u, v, n));
  const PlanePiece whole = measure_polygon(all, u, v, n);
  EXPECT_NEAR(joined.area, whole.area, 1e-13);
  EXPECT_NEAR(glm::length(joined.centroid - whole.centroid), 0, 1e-13);
  EXPECT_NEAR(joined.uu, whole.uu, 1e-13);
  EXPECT_NEAR(joined.uv, whole.uv, 1e-13);
  EXPECT_NEAR(joined.vv, whole.vv, 1e-13);
}

}  // namespace
}  // namespace radvor
