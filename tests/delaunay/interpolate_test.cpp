// Values between the vertices: linear functions come back, and nothing leaves the range of the values.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "delaunay/point_sets.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {
namespace {

template <class Function>
void give_values(Triangulation& d, Function&& function) {
  std::vector<double> values;
  for (VertexId v = 0; v < d.vertex_bound(); ++v) {
    values.push_back(function(d.position(v)));
  }
  d.set_values(values, 0);
}

TEST(interpolation, natural_neighbours_reproduce_linear_functions) {
  for (const auto& set : testing::point_sets()) {
    if (std::string(set.name) == "huge_and_tiny" || std::string(set.name).starts_with("collinear") ||
        std::string(set.name) == "nearly_collinear") {
      continue;
    }
    Triangulation d(std::pmr::new_delete_resource());
    d.insert_many(set.make(300, 2), nullptr);
    give_values(d, [](Vec2 p) { return 3 + 2 * p.x - 5 * p.y; });
    std::mt19937_64 random(7);
    int inside = 0;
    for (int i = 0; i < 300; ++i) {
      const auto a = static_cast<VertexId>(random() % d.vertex_bound()),
                 b = static_cast<VertexId>(random() % d.vertex_bound()),
                 c = static_cast<VertexId>(random() % d.vertex_bound());
      const Vec2 p = 0.4 * d.position(a) + 0.35 * d.position(b) + 0.25 * d.position(c);
      const Location at = d.locate(p);
      if (at.where != Where::triangle) {
        continue;
      }
      const auto weights = d.barycentric(triangle_of(at.edge), p);
      if (*std::min_element(weights.begin(), weights.end()) < 1e-3) {
        continue;  // a needle's circumcentres are as ill-conditioned as they look
      }
      ++inside;
      const double expected = 3 + 2 * p.x - 5 * p.y;
      const double scale = 10 + std::fabs(2 * p.x) + std::fabs(5 * p.y);
      EXPECT_NEAR(d.interpolate_linear(p), expected, 1e-11 * scale) << set.name;
      EXPECT_NEAR(d.interpolate_natural(p), expected, 1e-8 * scale) << set.name;
    }
    EXPECT_GT(inside, 20) << set.name;
  }
}

TEST(interpolation, natural_neighbours_of_a_square_and_unset_values) {
  Triangulation d(std::pmr::new_delete_resource());
  for (const Vec2 p : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
    d.insert(p);
  }
  EXPECT_TRUE(std::isnan(d.interpolate_natural({0.5, 0.5})));
  d.set_values(std::array{1.0, 0.0, 0.0, 0.0}, 0);
  EXPECT_DOUBLE_EQ(d.interpolate_natural({0.5, 0.5}), 0.25);
  EXPECT_DOUBLE_EQ(d.interpolate_natural({0.25, 0}), 0.75);
  EXPECT_DOUBLE_EQ(d.interpolate_natural({0, 0}), 1);
  EXPECT_TRUE(std::isnan(d.interpolate_natural({2, 0.5})));
}

// Needles too, whose circumcentres are beyond all doubles: inside of the hull there is a value, and a mean.
TEST(interpolation, stays_between_the_values_of_any_set) {
  for (const auto& set : testing::point_sets()) {
    Triangulation d(std::pmr::new_delete_resource());
    d.insert_many(set.make(200, 5), nullptr);
    std::mt19937_64 random(8);
    give_values(d, [&](Vec2) { return 1 + static_cast<double>(random() % 1000) / 1000; });
    int inside = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto pick = [&] { return d.position(static_cast<VertexId>(random() % d.vertex_bound())); };
      const Vec2 p = i % 2 ? 0.5 * pick() + 0.5 * pick() : 0.4 * pick() + 0.35 * pick() + 0.25 * pick();
      if ((p.x != 0 && std::fabs(p.x) < k_least_coordinate) || (p.y != 0 && std::fabs(p.y) < k_least_coordinate) ||
          d.locate(p).where == Where::outside) {
        continue;
      }
      ++inside;
      for (const double value : {d.interpolate_natural(p), d.interpolate_linear(p)}) {
        ASSERT_GE(value, 1 - 1e-12) << set.name << " at " << p.x << ", " << p.y;
        ASSERT_LE(value, 2 + 1e-12) << set.name << " at " << p.x << ", " << p.y;
      }
    }
    EXPECT_GT(inside, 100) << set.name;
  }
}

}  // namespace
}  // namespace radvor::delaunay
