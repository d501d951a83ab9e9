#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

#include "base/error.h"
#include "delaunay/point_sets.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {
namespace {

using testing::canonical_triangles;
using testing::PointSet;

std::set<std::pair<VertexId, VertexId>> constraints_of(const Triangulation& d) {
  std::set<std::pair<VertexId, VertexId>> edges;
  for (TriangleId t = 0; t < d.triangle_bound(); ++t) {
    if (!d.mesh().is_free(t)) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const HalfEdge h = half_edge(t, corner);
        if (d.constraint_flags(h) != 0) {
          edges.insert(std::minmax(d.origin(h), d.target(h)));
        }
      }
    }
  }
  return edges;
}

ErrorCode code_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode{};
}

VertexId pick(std::mt19937& random, std::uint32_t count) {
  return std::uniform_int_distribution<VertexId>(0, count - 1)(random);
}

class Constraints : public ::testing::TestWithParam<PointSet> {};

TEST_P(Constraints, come_and_go_without_a_trace) {
  auto points = GetParam().make(150, 21);
  Triangulation d(std::pmr::new_delete_resource());
  d.insert_many(points, nullptr);
  const auto before = canonical_triangles(d);
  std::mt19937 random(4);
  std::vector<std::pair<VertexId, VertexId>> made;
  for (int i = 0; i < 30; ++i) {
    const VertexId a = pick(random, d.vertex_count()), b = pick(random, d.vertex_count());
    const auto old = canonical_triangles(d);
    const ErrorCode code = code_of([&] { d.constrain(a, b, constraint::k_discontinuous); });
    ASSERT_NO_THROW(d.validate());
    if (code == ErrorCode{}) {
      made.emplace_back(a, b);
    } else {
      ASSERT_TRUE(code == ErrorCode::constraint || a == b);
      ASSERT_EQ(canonical_triangles(d), old);
    }
  }
  ASSERT_FALSE(made.empty());
  // Collinear ones share edges, so free what is left of each.
  for (const auto& [a, b] : constraints_of(d)) {
    d.unconstrain(a, b);
    ASSERT_NO_THROW(d.validate());
  }
  EXPECT_EQ(d.constraint_count(), 0u);
  EXPECT_EQ(canonical_triangles(d), before);
}

TEST_P(Constraints, do_not_depend_on_what_came_first) {
  auto points = GetParam().make(80, 5);
  std::sort(points.begin(), points.end(), lexicographically_less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Triangulation early(std::pmr::new_delete_resource());
  Triangulation late(std::pmr::new_delete_resource());
  std::mt19937 random(8);
  std::vector<std::pair<Vec2, Vec2>> segments;
  for (const Vec2 point : points) {
    late.insert(point);
  }
  for (int i = 0; i < 25; ++i) {
    const VertexId a = pick(random, late.vertex_count()), b = pick(random, late.vertex_count());
    if (code_of([&] { late.constrain(a, b, constraint::k_border); }) == ErrorCode{}) {
      segments.emplace_back(late.position(a), late.position(b));
    }
  }
  // Segments may meet in a vertex on both; it has to be there first.
  for (const Vec2 point : points) {
    for (const auto& [a, b] : segments) {
      if (exact::orientation(a, b, point) == 0) {
        early.insert(point);
      }
    }
  }
  for (const auto& [a, b] : segments) {
    const VertexId from = early.insert(a);
    const VertexId to = early.insert(b);
    early.constrain(from, to, constraint::k_border);
  }
  std::shuffle(points.begin(), points.end(), random);
  for (const Vec2 point : points) {
    early.insert(point);
    ASSERT_NO_THROW(early.validate());
  }
  EXPECT_EQ(canonical_triangles(early), canonical_triangles(late));
  EXPECT_EQ(early.constraint_count(), late.constraint_count());
}

TEST_P(Constraints, may_cross_where_they_are_split) {
  Triangulation d(std::pmr::new_delete_resource());
  d.insert_many(GetParam().make(60, 31), nullptr);
  std::mt19937 random(6);
  for (int i = 0; i < 25; ++i) {
    const VertexId a = pick(random, d.vertex_count()), b = pick(random, d.vertex_count());
    const auto old = canonical_triangles(d);
    const ErrorCode code = code_of([&] { d.constrain(a, b, constraint::k_continuous, Crossing::split); });
    ASSERT_NO_THROW(d.validate());
    if (code != ErrorCode{}) {
      ASSERT_EQ(canonical_triangles(d), old);
    }
  }
}

TEST_P(Constraints, survive_removal_of_their_vertices) {
  Triangulation d(std::pmr::new_delete_resource());
  d.insert_many(GetParam().make(60, 13), nullptr);
  std::mt19937 random(16);
  for (int i = 0; i < 20; ++i) {
    const VertexId a = pick(random, d.vertex_count()), b = pick(random, d.vertex_count());
    (void)code_of([&] { d.constrain(a, b, constraint::k_continuous); });
  }
  while (d.vertex_count() > 0) {
    VertexId v = pick(random, d.vertex_bound());
    while (!d.is_vertex(v)) {
      v = (v + 1) % d.vertex_bound();
    }
    d.remove(v);
    ASSERT_NO_THROW(d.validate());
  }
}

INSTANTIATE_TEST_SUITE_P(constraints, Constraints, ::testing::ValuesIn(testing::point_sets()),
                         [](const auto& set) { return std::string(set.param.name); });

TEST(constraints, take_the_vertices_on_their_way) {
  Triangulation d(std::pmr::new_delete_resource());
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      d.insert({i, j});
    }
  }
  d.constrain(0, 24, constraint::k_border);
  EXPECT_EQ(d.constraint_count(), 4u);
  EXPECT_EQ(d.constraint_flags(6, 12), constraint::k_border);
  d.unconstrain(24, 0);
  EXPECT_EQ(d.constraint_count(), 0u);
  EXPECT_EQ(code_of([&] { d.unconstrain(0, 24); }), ErrorCode::constraint);
}

TEST(split, puts_a_point_beside_the_line_on_either_side_and_on_the_hull) {
  for (const double offset : {-1e-15, 0.0, 1e-15, -0.2, 0.2}) {
    for (const bool on_hull : {false, true}) {
      Triangulation d(std::pmr::new_delete_resource());
      const VertexId a = d.insert({0, 0}), b = d.insert({3, 0});
      d.insert({1, 2});
      if (!on_hull) {
        d.insert({2, -2});
      }
      d.constrain(a, b, constraint::k_border | 0x40);
      const VertexId p = d.split(a, b, {1.3, offset});
      ASSERT_NO_THROW(d.validate());
      EXPECT_EQ(d.constraint_flags(a, p), constraint::k_border | 0x40);
      EXPECT_EQ(d.constraint_flags(p, b), constraint::k_border | 0x40);
      EXPECT_EQ(d.constraint_flags(a, b), 0);
      EXPECT_EQ(d.constraint_count(), 2u);
    }
  }
}

TEST(split, is_refused_where_a_triangle_would_invert) {
  Triangulation d(std::pmr::new_delete_resource());
  const VertexId a = d.insert({0, 0}), b = d.insert({4, 0});
  d.insert({2, 1});
  d.insert({2, -1});
  d.constrain(a, b, constraint::k_border);
  const auto before = canonical_triangles(d);
  for (const Vec2 p : {Vec2(2, 1.5), Vec2(3, 0.6), Vec2(0, 0), Vec2(4, 0), Vec2(2, 1), Vec2(5, 0)}) {
    EXPECT_EQ(code_of([&] { d.split(a, b, p); }), ErrorCode::constraint) << p.x << ' ' << p.y;
    ASSERT_NO_THROW(d.validate());
    EXPECT_EQ(canonical_triangles(d), before);
  }
}

TEST(domain, holes_islands_and_what_is_outside) {
  Triangulation d(std::pmr::new_delete_resource());
  double expected = 0;
  double sign = 1;
  for (const double size : {8.0, 5.0, 2.0}) {
    VertexId ids[4];
    for (int i = 0; i < 4; ++i) {
      ids[i] = d.insert({(i == 1 || i == 2 ? size : -size), (i >= 2 ? size : -size)});
    }
    for (int i = 0; i < 4; ++i) {
      d.constrain(ids[i], ids[(i + 1) % 4], constraint::k_border);
    }
    expected += sign * 4 * size * size;
    sign = -sign;
  }
  d.insert({20, 3});
  d.mark_domain();
  const auto inside_area = [&] {
    double area = 0;
    for (TriangleId t = 0; t < d.triangle_bound(); ++t) {
      if (!d.mesh().is_free(t) && d.is_inside(t)) {
        const auto v = d.triangle(t);
        area += cross(d.position(v[1]) - d.position(v[0]), d.position(v[2]) - d.position(v[0])) / 2;
      }
    }
    return area;
  };
  EXPECT_EQ(inside_area(), expected);
  std::mt19937 random(2);
  std::uniform_int_distribution<int> at(-24, 24);
  for (int i = 0; i < 200; ++i) {
    d.insert({at(random), at(random)});
    ASSERT_NO_THROW(d.validate());
    ASSERT_EQ(inside_area(), expected);
  }
}

TEST(domain, marks_outlive_all_edges) {  // found by fuzzing
  Triangulation d(std::pmr::new_delete_resource());
  d.insert({0, 0});
  d.insert({4, 0});
  d.mark_domain();
  d.remove(1);
  d.insert({2, 4});
  EXPECT_NO_THROW(d.validate());
}

TEST(domain, an_open_border_is_an_error) {
  Triangulation d(std::pmr::new_delete_resource());
  d.insert({0, 0});
  d.insert({4, 0});
  d.insert({2, 4});
  d.constrain(d.insert({1, 1}), d.insert({2, 1}), constraint::k_border);
  EXPECT_EQ(code_of([&] { d.mark_domain(); }), ErrorCode::constraint);
  EXPECT_NO_THROW(d.validate());
}

}  // namespace
}  // namespace radvor::delaunay
