// Cells against brute force: the nearest site that a point sees.
#include "delaunay/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "base/error.h"
#include "delaunay/point_sets.h"

namespace radvor::delaunay {
namespace {

struct Edge {
  VertexId a, b;
};

// A domain: an outline with obtuse, acute and reflex corners, a hole, an open-ended slit, a continuous seam.
struct Scene {
  explicit Scene(std::uint32_t seed, std::size_t inner, bool seam) : d(std::pmr::new_delete_resource()) {
    const std::vector<Vec2> outline = {{0, 0}, {8, -0.5}, {10, 3}, {6, 3.5}, {9.5, 8}, {4, 7}, {1, 9}, {2, 4}};
    const std::vector<Vec2> hole = {{3.5, 2}, {3, 3}, {4, 4}, {5, 2.5}};
    loop(outline, false);
    loop(hole, true);
    add({5, 5}, {6.5, 6.5}, constraint::k_discontinuous);
    add({1, 0.4}, {2.5, 1.3}, constraint::k_discontinuous);
    add({2.5, 1.3}, {2.2, 2.6}, constraint::k_discontinuous);
    if (seam) {
      add({0.5, 1}, {7, 1}, constraint::k_continuous);
    }
    d.mark_domain();
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> x(0, 10), y(-0.5, 9);
    while (inner > 0) {
      const Vec2 p(x(random), y(random));
      const Location at = d.locate(p);
      if (at.where == Where::triangle && d.is_inside(triangle_of(at.edge))) {
        d.insert(p);
        --inner;
      }
    }
    d.validate();
    collect();
  }

  void loop(const std::vector<Vec2>& points, bool) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      add(points[i], points[(i + 1) % points.size()], constraint::k_border);
    }
  }
  void add(Vec2 a, Vec2 b, std::uint8_t flags) {
    const VertexId from = d.insert(a);
    const VertexId to = d.insert(b);
    d.constrain(from, to, flags, Crossing::split);
  }
  void collect() {
    blocking.clear();
    area = 0;
    for (TriangleId t = 0; t < d.triangle_bound(); ++t) {
      if (!d.is_triangle(t)) {
        continue;
      }
      const auto v = d.triangle(t);
      if (d.is_inside(t)) {
        area += cross(d.position(v[1]) - d.position(v[0]), d.position(v[2]) - d.position(v[0])) / 2;
      }
      for (std::uint32_t i = 0; i < 3; ++i) {
        const HalfEdge h = half_edge(t, i);
        if (d.constraint_flags(h) & constraint::k_blocking) {
          blocking.push_back({d.origin(h), d.target(h)});
        }
      }
    }
  }

  bool sees(Vec2 x, VertexId s, const Lattice& lattice) const {
    for (const Edge& edge : blocking) {
      if (edge.a == s || edge.b == s) {
        continue;
      }
      const Vec2 a = d.position(edge.a), b = d.position(edge.b), p = d.position(s);
      if (orientation(a, b, x, lattice) * orientation(a, b, p, lattice) < 0 &&
          orientation(x, p, a, lattice) * orientation(x, p, b, lattice) <= 0) {
        return false;
      }
    }
    // Edges at s itself hide nothing of what is left or right of them; but s must be seen from inside of the domain.
    return true;
  }

  Triangulation d;
  std::vector<Edge> blocking;
  double area = 0;
};

bool contains(std::span<const Vec2> polygon, Vec2 x, double slack) {
  // Star-shaped: the winding number.
  int winding = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double side = cross(b - a, x - a);
    if (a.y <= x.y && b.y > x.y && side > -slack) {
      ++winding;
    } else if (a.y > x.y && b.y <= x.y && side < slack) {
      --winding;
    }
  }
  return winding != 0;
}

void check_scene(const Scene& scene, std::size_t samples, std::uint32_t seed) {
  const Triangulation& d = scene.d;
  CellBuffer buffer(std::pmr::new_delete_resource());
  double sum = 0;
  struct Cell {
    std::vector<std::vector<Vec2>> polygons;
  };
  std::vector<Cell> cells(d.vertex_bound());
  for (VertexId v = 0; v < d.vertex_bound(); ++v) {
    bounded_cell(d, v, buffer);
    for (const Sector& sector : buffer.sectors()) {
      EXPECT_GT(sector.area, 0);
      sum += sector.area;
      const auto polygon = buffer.polygon(sector);
      cells[v].polygons.emplace_back(polygon.begin(), polygon.end());
    }
  }
  EXPECT_NEAR(sum / scene.area, 1, 1e-12);

  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> x(-1, 11), y(-1, 10);
  std::size_t inside = 0, wrong = 0;
  VertexId hint = k_none;
  for (std::size_t i = 0; i < samples; ++i) {
    const Vec2 p(x(random), y(random));
    const Location at = d.locate(p, &hint);
    if (at.where != Where::triangle || !d.is_inside(triangle_of(at.edge))) {
      continue;
    }
    ++inside;
    VertexId nearest = k_none;
    double distance = INFINITY, second = INFINITY;
    Lattice lattice = d.lattice();
    lattice.include(p);
    for (VertexId v = 0; v < d.vertex_bound(); ++v) {
      const Vec2 to = d.position(v) - p;
      const double r = std::sqrt(glm::dot(to, to));
      if (r < second && scene.sees(p, v, lattice)) {
        if (r < distance) {
          second = distance;
          distance = r;
          nearest = v;
        } else {
          second = r;
        }
      }
    }
    if (second - distance < 1e-9) {
      continue;
    }
    for (VertexId v = 0; v < d.vertex_bound(); ++v) {
      bool holds = false;
      for (const auto& polygon : cells[v].polygons) {
        holds = holds || contains(polygon, p, 0);
      }
      if (holds != (v == nearest)) {
        ++wrong;
        if (wrong < 5) {
          ADD_FAILURE() << "point " << p.x << ", " << p.y << ": nearest visible " << nearest << ", but cell " << v
                        << (holds ? " holds it" : " does not hold it");
        }
      }
    }
  }
  EXPECT_GT(inside, samples / 4);
  EXPECT_EQ(wrong, 0u);
}

TEST(bounded_cells, few_sites) {
  check_scene(Scene(1, 0, false), 20000, 2);
}
TEST(bounded_cells, some_sites) {
  check_scene(Scene(2, 30, false), 300000, 3);  // a third of them inside
}
TEST(bounded_cells, many_sites) {
  check_scene(Scene(3, 200, false), 5000, 4);
}
TEST(bounded_cells, across_a_continuous_seam) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    check_scene(Scene(seed, 5 * seed, true), 3000, 5);
  }
}

// They change nothing at all: the same cells to the bit but for ties, whose corners are computed from other triangles.
TEST(bounded_cells, do_not_know_of_continuous_constraints) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0, 10);
  for (std::uint32_t round = 0; round < 20; ++round) {
    Scene with(round, 40, false), without(round, 40, false);
    const auto count = with.d.vertex_bound();
    int seams = 0;
    for (int i = 0; i < 30; ++i) {
      const auto a = static_cast<VertexId>(random() % count), b = static_cast<VertexId>(random() % count);
      try {
        with.d.constrain(a, b, constraint::k_continuous);
        ++seams;
      } catch (const Error&) {
      }
    }
    ASSERT_GT(seams, 3);
    ASSERT_EQ(with.d.vertex_bound(), count);
    CellBuffer one(std::pmr::new_delete_resource()), other(std::pmr::new_delete_resource());
    for (VertexId v = 0; v < count; ++v) {
      bounded_cell(with.d, v, one);
      bounded_cell(without.d, v, other);
      ASSERT_EQ(one.sectors().size(), other.sectors().size());
      for (std::size_t i = 0; i < one.sectors().size(); ++i) {
        const auto p = one.polygon(one.sectors()[i]), q = other.polygon(other.sectors()[i]);
        if (one.sectors()[i].closed) {
          EXPECT_NEAR(one.sectors()[i].area, other.sectors()[i].area, 1e-13);
        } else {
          EXPECT_TRUE(std::equal(p.begin(), p.end(), q.begin(), q.end())) << "cell " << v << " of scene " << round;
        }
      }
    }
  }
}

// Values turn the diagonals of a lattice, seams hold others: neighbours still agree on their corners.
TEST(bounded_cells, of_a_lattice_with_seams_and_values_fill_it) {
  std::mt19937 random(9);
  for (int round = 0; round < 10; ++round) {
    Triangulation d(std::pmr::new_delete_resource());
    std::vector<double> values;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) {
        d.insert({i, j});
        values.push_back(static_cast<double>(random() % 4));
      }
    }
    for (int i = 0; i < 12; ++i) {
      const VertexId a = random() % 64, b = random() % 64;
      try {
        d.constrain(a, b, i % 3 == 0 ? constraint::k_discontinuous : constraint::k_continuous);
      } catch (const Error&) {
      }
    }
    d.set_values(values, 0);
    d.realign();
    CellBuffer buffer(std::pmr::new_delete_resource());
    double sum = 0;
    for (VertexId v = 0; v < d.vertex_bound(); ++v) {
      bounded_cell(d, v, buffer);
      sum += buffer.area();
    }
    EXPECT_NEAR(sum, 49, 1e-12);
  }
}

TEST(bounded_cells, both_sides_of_an_open_end_are_one_sector) {
  Triangulation d(std::pmr::new_delete_resource());
  for (const Vec2 p : {Vec2(0, 0), Vec2(4, 0), Vec2(4, 4), Vec2(0, 4), Vec2(2, 2), Vec2(3, 2.2)}) {
    d.insert(p);
  }
  d.constrain(4, 5, constraint::k_discontinuous);
  CellBuffer buffer(std::pmr::new_delete_resource());
  bounded_cell(d, 4, buffer);
  ASSERT_EQ(buffer.sectors().size(), 1u);
  EXPECT_FALSE(buffer.sectors()[0].closed);
  double sum = 0;
  for (VertexId v = 0; v < 6; ++v) {
    bounded_cell(d, v, buffer);
    sum += buffer.area();
  }
  EXPECT_NEAR(sum, 16, 1e-12);
}

TEST(window_cells, sum_to_the_window_with_and_without_constraints) {
  for (const bool constrained : {false, true}) {
    Triangulation d(std::pmr::new_delete_resource());
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 200; ++i) {
      d.insert({unit(random), unit(random)});
    }
    if (constrained) {
      d.constrain(d.insert({-0.9, -0.9}), d.insert({0.8, 0.95}), constraint::k_discontinuous);
      d.constrain(d.insert({-1.5, 0}), d.insert({-1.5, 1.9}), constraint::k_border);
    }
    const std::vector<Vec2> window = {{-2, -1.5}, {1.5, -2}, {2, 0.5}, {0, 2}};
    CellBuffer buffer(std::pmr::new_delete_resource());
    double sum = 0;
    for (VertexId v = 0; v < d.vertex_bound(); ++v) {
      window_cell(d, v, window, buffer);
      sum += buffer.area();
    }
    double area = 0;
    for (std::size_t i = 0; i < window.size(); ++i) {
      area += cross(window[i], window[(i + 1) % window.size()]) / 2;
    }
    EXPECT_NEAR(sum / area, 1, 1e-12);
  }
}

}  // namespace
}  // namespace radvor::delaunay
