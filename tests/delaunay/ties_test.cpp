#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "delaunay/point_sets.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {
namespace {

using testing::canonical_triangles;

// The square lattice with a value that is a function of the place.
double step(Vec2 p) {
  return p.x + p.y > 6.5 ? 1.0 : 0.25 * std::floor(p.x);
}

void give_values(Triangulation& d, double (*f)(Vec2)) {
  std::vector<double> values;
  for (VertexId v = 0; v < d.vertex_bound(); ++v) {
    values.push_back(d.is_vertex(v) ? f(d.position(v)) : std::nan(""));
  }
  d.set_values(values, 0);
}

TEST(ties, follow_a_step_in_the_values) {
  Triangulation d(std::pmr::new_delete_resource());
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      d.insert({i, j});
    }
  }
  EXPECT_EQ(d.tie_count(), 49u);
  give_values(d, [](Vec2 p) { return p.x + p.y > 6.5 ? 1.0 : 0.0; });
  d.realign();
  d.validate();
  // No diagonal joins the two sides where the other does not.
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j) {
      const VertexId a = static_cast<VertexId>(8 * i + j), b = a + 9, c = a + 8, e = a + 1;
      const double rising = std::fabs(d.value(a) - d.value(b)), falling = std::fabs(d.value(c) - d.value(e));
      const bool is_rising = d.find_edge(a, b) != k_none;
      EXPECT_NE(is_rising, d.find_edge(c, e) != k_none);
      EXPECT_LE(is_rising ? rising : falling, is_rising ? falling : rising);
      if (rising == falling) {
        EXPECT_TRUE(is_rising);  // the fan of the lexicographically least
      }
    }
  }
}

TEST(ties, are_a_function_of_sites_and_values_whatever_the_history) {
  std::mt19937 random(3);
  std::vector<Vec2> points;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      points.push_back({i, j});
    }
  }
  std::vector<std::array<double, 6>> expected;
  for (int round = 0; round < 4; ++round) {
    Triangulation d(std::pmr::new_delete_resource());
    std::shuffle(points.begin(), points.end(), random);
    for (const Vec2 p : points) {
      d.insert(p);
    }
    give_values(d, step);
    d.realign();
    ASSERT_NO_THROW(d.validate());
    // Edits in between, undone again.
    for (int i = 0; i < 20; ++i) {
      const VertexId v = static_cast<VertexId>(random() % points.size());
      const Vec2 at = d.position(v);
      const double value = d.value(v);
      d.remove(v);
      ASSERT_NO_THROW(d.validate());
      ASSERT_EQ(d.insert(at), v);
      ASSERT_NO_THROW(d.validate());
      d.set_values(std::array{value}, v);
      d.realign(std::array{v});
    }
    d.realign();
    ASSERT_NO_THROW(d.validate());
    if (expected.empty()) {
      expected = canonical_triangles(d);
    }
    EXPECT_EQ(canonical_triangles(d), expected);
  }
}

// All triangulations of a convex polygon with the sums of their chords.
double least_cost(const std::vector<double>& v, std::size_t i, std::size_t j) {
  if (j < i + 2) {
    return 0;
  }
  double best = INFINITY;
  for (std::size_t k = i + 1; k < j; ++k) {
    best = std::min(best, least_cost(v, i, k) + least_cost(v, k, j) + (k > i + 1 ? std::fabs(v[i] - v[k]) : 0) +
                              (j > k + 1 ? std::fabs(v[k] - v[j]) : 0));
  }
  return best;
}

TEST(ties, touched_by_many_points_at_once_are_resolved_anew) {  // found by fuzzing
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    Triangulation at_once(std::pmr::new_delete_resource()), one_by_one(std::pmr::new_delete_resource());
    std::vector<double> values;
    for (Triangulation* d : {&at_once, &one_by_one}) {
      for (int i = 0; i < 7; ++i) {
        for (int j = 0; j < 7; ++j) {
          d->insert({2 * i, 2 * j});
        }
      }
    }
    for (int i = 0; i < 49; ++i) {
      values.push_back(static_cast<double>(random() % 5));
    }
    std::vector<Vec2> more;
    for (int i = 0; i < 12; ++i) {  // corners of the lattice, centres of its squares, and between
      more.push_back({static_cast<double>(random() % 14), static_cast<double>(random() % 14)});
    }
    for (Triangulation* d : {&at_once, &one_by_one}) {
      d->set_values(values, 0);
      d->realign();
    }
    at_once.insert_many(more, nullptr);
    ASSERT_NO_THROW(at_once.validate());
    for (const Vec2 point : more) {
      one_by_one.insert(point);
    }
    ASSERT_NO_THROW(one_by_one.validate());
    EXPECT_EQ(canonical_triangles(at_once), canonical_triangles(one_by_one));
  }
}

TEST(ties, of_many_corners_are_cheapest) {
  // The 12 integer points of x^2 + y^2 = 25 in order.
  const std::vector<Vec2> circle = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                    {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
  std::mt19937 random(1);
  for (int round = 0; round < 20; ++round) {
    Triangulation d(std::pmr::new_delete_resource());
    std::vector<double> values;
    for (const Vec2 p : circle) {
      d.insert(p);
      values.push_back(static_cast<double>(random() % 16));
    }
    EXPECT_EQ(d.tie_count(), 1u);
    d.set_values(values, 0);
    d.realign();
    d.validate();
    double cost = 0;
    int chords = 0;
    for (VertexId a = 0; a < 12; ++a) {
      for (VertexId b = a + 2; b < 12 && b - a < 11; ++b) {
        if (d.find_edge(a, b) != k_none) {
          cost += std::fabs(values[a] - values[b]);
          ++chords;
        }
      }
    }
    EXPECT_EQ(chords, 9);
    EXPECT_EQ(cost, least_cost(values, 0, 11));
  }
}

TEST(ties, cut_by_a_constraint_are_resolved_on_either_side) {
  const std::vector<Vec2> circle = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                                    {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
  Triangulation d(std::pmr::new_delete_resource());
  for (const Vec2 p : circle) {
    d.insert(p);
  }
  const auto before = canonical_triangles(d);
  d.constrain(1, 8, constraint::k_continuous);
  d.validate();
  EXPECT_EQ(d.tie_count(), 2u);
  // Each part is the fan of its least corner: 6 = (-5, 0) and 8 = (-3, -4).
  for (const VertexId v : {2u, 3u, 4u}) {
    EXPECT_NE(d.find_edge(6, v), k_none);
  }
  for (const VertexId v : {10u, 11u, 0u}) {
    EXPECT_NE(d.find_edge(8, v), k_none);
  }
  d.set_values(std::vector<double>{0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, 0);
  d.realign();
  d.validate();
  d.unconstrain(1, 8);
  d.validate();
  d.set_values(std::vector<double>(12, std::nan("")), 0);
  d.realign();
  d.validate();
  EXPECT_EQ(canonical_triangles(d), before);
}

}  // namespace
}  // namespace radvor::delaunay
