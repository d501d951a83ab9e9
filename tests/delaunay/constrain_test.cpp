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

TEST(split, is_refused_where_a_vertex_would_change_sides) {
  Triangulation d(std::pmr::new_delete_resource());
  const VertexId a = d.insert({0, 0}), b = d.insert({4, 0});
  d.insert({2, 1});
  d.insert({2, -1});
  d.constrain(a, b, constraint::k_border);
  const auto before = canonical_triangles(d);
  for (const Vec2 p : {Vec2(2, 1.5), Vec2(3, 1.5), Vec2(0, 0), Vec2(4, 0), Vec2(2, 1), Vec2(5, 0)}) {
    EXPECT_EQ(code_of([&] { d.split(a, b, p); }), ErrorCode::constraint) << p.x << ' ' << p.y;
    ASSERT_NO_THROW(d.validate());
    EXPECT_EQ(canonical_triangles(d), before);
  }
  // Beside the next vertex it may lie beyond the triangle, here beyond the hull.
  const VertexId p = d.split(a, b, {3, 0.6});
  ASSERT_NO_THROW(d.validate());
  EXPECT_NE(d.constraint_flags(a, p), 0);
  EXPECT_NE(d.constraint_flags(p, b), 0);
}

// By the definition: is the triangle a b p, border included, free of other vertices and constraints?
bool may_split(const Triangulation& d, VertexId a, VertexId b, Vec2 p) {
  const Vec2 at_a = d.position(a), at_b = d.position(b);
  const int turn = exact::orientation(at_a, at_b, p);
  const auto between = [](Vec2 from, Vec2 point, Vec2 to) {  // on the closed segment
    return exact::orientation(from, to, point) == 0 &&
           !lexicographically_less(point, std::min(from, to, lexicographically_less)) &&
           !lexicographically_less(std::max(from, to, lexicographically_less), point);
  };
  for (VertexId v = 0; v < d.vertex_bound(); ++v) {
    const Vec2 at = d.position(v);
    if (at == p) {
      return false;
    }
    if (v != a && v != b &&
        (turn == 0 ? between(at_a, at, at_b)
                   : exact::orientation(at_a, at_b, at) * turn >= 0 && exact::orientation(at_b, p, at) * turn >= 0 &&
                         exact::orientation(p, at_a, at) * turn >= 0)) {
      return false;
    }
  }
  if (turn == 0) {
    return between(at_a, p, at_b);
  }
  for (const auto& [u, v] : constraints_of(d)) {
    const Vec2 at_u = d.position(u), at_v = d.position(v);
    if (between(at_u, p, at_v)) {
      return false;
    }
    for (const Vec2 end : {at_a, at_b}) {
      if (exact::orientation(end, p, at_u) * exact::orientation(end, p, at_v) < 0 &&
          exact::orientation(at_u, at_v, end) * exact::orientation(at_u, at_v, p) < 0) {
        return false;
      }
    }
  }
  return true;
}

// Chains of constraints along lines whose points rounding moved, refined by their rounded midpoints (mostly) or by
// points far beside: accepted exactly where the definition says, and the result is that of starting over.
TEST(split, walks_through_slivers_beside_a_bent_chain) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(-1, 1);
  int accepted = 0, refused = 0, beyond = 0;
  for (int round = 0; round < 60; ++round) {
    Triangulation d(std::pmr::new_delete_resource());
    const Vec2 from(unit(random), unit(random)), to(unit(random), unit(random));
    std::vector<VertexId> chain;
    const std::size_t pieces = 1 + static_cast<std::size_t>(round) % 7;
    for (std::size_t i = 0; i <= pieces; ++i) {
      chain.push_back(d.insert(from + (to - from) * (static_cast<double>(i) / static_cast<double>(pieces))));
    }
    for (int i = 0; i < round % 20; ++i) {
      d.insert({unit(random), unit(random)});
    }
    std::vector<std::pair<VertexId, VertexId>> edges;
    for (std::size_t i = 0; i < pieces; ++i) {
      d.constrain(chain[i], chain[i + 1], constraint::k_border);
      if (d.constraint_flags(chain[i], chain[i + 1]) != 0) {
        edges.emplace_back(chain[i], chain[i + 1]);
      }
    }
    for (int i = 0; i < 40 && !edges.empty(); ++i) {
      const std::size_t k = random() % edges.size();
      const VertexId a = edges[k].first, b = edges[k].second;
      Vec2 p = (d.position(a) + d.position(b)) * 0.5;
      if (i % 4 == 0) {
        const Vec2 along = d.position(b) - d.position(a);
        p += Vec2(-along.y, along.x) * std::ldexp(unit(random), i % 8 == 0 ? 2 : -static_cast<int>(random() % 54));
      }
      const HalfEdge h = d.find_edge(a, b);
      const HalfEdge beside = exact::orientation(d.position(a), d.position(b), p) > 0 ? h : d.twin(h);
      const Location at = d.locate(p);
      const bool walks =
          at.where == Where::outside ? !d.is_ghost(triangle_of(beside)) : triangle_of(at.edge) != triangle_of(beside);
      const auto old = canonical_triangles(d);
      const bool may = may_split(d, a, b, p);
      VertexId made = k_none;
      const ErrorCode code = code_of([&, a = a, b = b] { made = d.split(a, b, p); });
      ASSERT_EQ(code == ErrorCode{}, may) << "round " << round << " split " << i;
      ASSERT_NO_THROW(d.validate()) << "round " << round << " split " << i;
      if (code != ErrorCode{}) {
        ASSERT_EQ(canonical_triangles(d), old);
        ++refused;
        continue;
      }
      ++accepted;
      beyond += walks;
      edges[k] = {a, made};
      edges.emplace_back(made, b);
    }
    ASSERT_EQ(d.constraint_count(), edges.size());
    Triangulation again(std::pmr::new_delete_resource());
    again.insert_many(d.positions(), nullptr);
    for (const auto& [a, b] : edges) {
      again.constrain(a, b, constraint::k_border);
    }
    ASSERT_EQ(canonical_triangles(d), canonical_triangles(again)) << "round " << round;
  }
  EXPECT_GT(accepted, 500);
  EXPECT_GT(refused, 50);
  EXPECT_GT(beyond, 50);
}

// The domain's area changes by the sliver alone.
TEST(split, moves_the_sliver_to_the_other_side_of_a_marked_border) {
  for (const double height : {0.25, -0.25}) {
    Triangulation d(std::pmr::new_delete_resource());
    VertexId ids[4];
    for (int i = 0; i < 4; ++i) {
      ids[i] = d.insert({(i == 1 || i == 2 ? 4 : 0), (i >= 2 ? 4 : 0)});
    }
    d.insert({-1, -0.125});
    d.insert({5, -0.125});
    for (int i = 0; i < 4; ++i) {
      d.constrain(ids[i], ids[(i + 1) % 4], constraint::k_border);
    }
    d.mark_domain();
    d.split(ids[0], ids[1], {2, height});
    ASSERT_NO_THROW(d.validate());
    double area = 0;
    for (TriangleId t = 0; t < d.triangle_bound(); ++t) {
      if (!d.mesh().is_free(t) && d.is_inside(t)) {
        const auto v = d.triangle(t);
        area += cross(d.position(v[1]) - d.position(v[0]), d.position(v[2]) - d.position(v[0])) / 2;
      }
    }
    EXPECT_EQ(area, 16 - 2 * height);
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
