#include "delaunay/point_sets.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace radvor::delaunay::testing {

namespace {

using Points = std::vector<Vec2>;

Points uniform(std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Points points(count);
  for (Vec2& p : points) {
    p = {unit(random), unit(random)};
  }
  return points;
}

Points grid(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  Points points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      points.push_back({i, j});
    }
  }
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

Points small_grid_with_duplicates(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> cell(0, 6);
  Points points(count);
  for (Vec2& p : points) {
    p = {cell(random), cell(random)};
  }
  return points;
}

// Points of x^2 + y^2 = r^2 with integers, and of its circles nearby.
Points exact_circles(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  Points points;
  const int r = 5 * 13 * 17;
  for (int x = -r; x <= r; ++x) {
    const int y2 = r * r - x * x;
    const int y = static_cast<int>(std::lround(std::sqrt(y2)));
    if (y * y == y2) {
      points.push_back({x, y});
      points.push_back({x, -y});
      points.push_back({x / 5 * 1.0, y / 5 * 1.0});
    }
  }
  std::shuffle(points.begin(), points.end(), random);
  points.resize(std::min(points.size(), count));
  points.push_back({0, 0});
  return points;
}

Points rounded_circle(std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> angle(0, 6.283185307179586);
  Points points(count);
  for (Vec2& p : points) {
    const double a = angle(random);
    p = {std::cos(a), std::sin(a)};
  }
  return points;
}

Points collinear(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> along(-1000, 1000);
  Points points(count);
  for (Vec2& p : points) {
    const double t = along(random);
    p = {3 * t + 1, -7 * t};
  }
  return points;
}

Points collinear_then_not(std::size_t count, std::uint32_t seed) {
  Points points = collinear(count * 3 / 4, seed);
  const Points more = grid(count / 4, seed);
  points.insert(points.end(), more.begin(), more.end());
  return points;
}

Points nearly_collinear(std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> along(0, 1);
  Points points(count);
  for (Vec2& p : points) {
    const double t = along(random);
    p = {t, t / 3};
  }
  return points;
}

Points one_ulp(std::size_t count, std::uint32_t seed) {
  Points points = grid(count, seed);
  std::mt19937 random(seed + 1);
  for (Vec2& p : points) {
    for (int axis = 0; axis < 2; ++axis) {
      p[axis] += 16;
      const auto direction = random() % 3;
      p[axis] = direction == 0 ? std::nextafter(p[axis], 0.0) : direction == 1 ? std::nextafter(p[axis], 1e9) : p[axis];
    }
  }
  return points;
}

Points clusters(std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Points points;
  while (points.size() < count) {
    const Vec2 centre = {unit(random), unit(random)};
    const double size = std::pow(10, -5 + 3 * unit(random));
    for (int i = 0; i < 20; ++i) {
      points.push_back(centre + size * Vec2{unit(random), unit(random)});
    }
  }
  return points;
}

Points huge_and_tiny(std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> exponent(-142, 199), sign(0, 4);
  std::uniform_real_distribution<double> mantissa(1, 2);
  Points points(count);
  for (Vec2& p : points) {
    for (int axis = 0; axis < 2; ++axis) {
      const int s = sign(random);
      p[axis] = s == 0 ? 0 : std::ldexp(random() % 2 ? mantissa(random) : 1.0, exponent(random)) * (s % 2 ? 1 : -1);
    }
  }
  return points;
}

}  // namespace

std::vector<PointSet> point_sets() {
  return {{"uniform", uniform},
          {"grid", grid},
          {"small_grid_with_duplicates", small_grid_with_duplicates},
          {"exact_circles", exact_circles},
          {"rounded_circle", rounded_circle},
          {"collinear", collinear},
          {"collinear_then_not", collinear_then_not},
          {"nearly_collinear", nearly_collinear},
          {"one_ulp", one_ulp},
          {"clusters", clusters},
          {"huge_and_tiny", huge_and_tiny}};
}

std::vector<std::array<double, 6>> canonical_triangles(const Triangulation& triangulation) {
  std::vector<std::array<double, 6>> result;
  for (TriangleId t = 0; t < triangulation.triangle_bound(); ++t) {
    if (!triangulation.is_triangle(t)) {
      continue;
    }
    auto v = triangulation.triangle(t);
    std::rotate(v.begin(),
                std::min_element(v.begin(), v.end(),
                                 [&](VertexId a, VertexId b) {
                                   return lexicographically_less(triangulation.position(a), triangulation.position(b));
                                 }),
                v.end());
    std::array<double, 6> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[2 * i] = triangulation.position(v[i]).x;
      corners[2 * i + 1] = triangulation.position(v[i]).y;
    }
    result.push_back(corners);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace radvor::delaunay::testing
