// What there is in a triangulation, as an engine sees it, against brute force; also from several threads.
#include <map>
#include <thread>

#include "api/triangulation.h"

namespace radvor::test {
namespace {

// Small integers: areas and turns are exact, and much is collinear.
TEST(DelaunayApi, EdgesNeighboursAndHullAreThoseOfTheTriangles) {
  const Engine engine;
  std::mt19937 random(1);
  for (const unsigned side : {1u, 2u, 5u, 30u}) {
    const Delaunay d(engine);
    for (int i = 0; i < 60; ++i) {
      d.insert(pick(random, side), pick(random, side + 1));
      if (i % 5 == 4) {
        (void)radvor_delaunay_remove(d, pick(random, radvor_delaunay_vertex_bound(d)));
      }
    }
    ASSERT_EQ(radvor_delaunay_validate(d), RADVOR_OK);
    std::set<std::array<std::uint32_t, 2>> edges;
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> following;  // around each vertex
    double area = 0;
    for (const auto& t : d.triangles()) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
        edges.insert({std::min(a, b), std::max(a, b)});
        following[a][b] = c;
      }
      area += turn(d.position(t[0]), d.position(t[1]), d.position(t[2]));
    }
    const auto all = d.pairs(radvor_delaunay_edges);
    if (!d.triangles().empty()) {
      EXPECT_EQ(all, edges);
    } else {
      EXPECT_EQ(all.size(), radvor_delaunay_vertex_count(d) - 1);  // a chain
    }
    for (const auto& [vertex, next] : following) {
      const Ids around = d.neighbours(vertex);
      const bool inner = next.size() == around.size();
      ASSERT_TRUE(inner || next.size() + 1 == around.size());
      std::size_t agree = 0;
      for (std::size_t i = 0; i < around.size(); ++i) {
        const auto at = next.find(around[i]);
        agree += at != next.end() && at->second == around[(i + 1) % around.size()];
      }
      EXPECT_EQ(agree, next.size()) << "not counter-clockwise around " << vertex;
    }
    // The hull: counter-clockwise, convex, with all vertices that are on it, around the triangles' area.
    const Ids hull = d.hull();
    double hull_area = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const auto a = d.position(hull[i]), b = d.position(hull[(i + 1) % hull.size()]);
      hull_area += a[0] * b[1] - a[1] * b[0];
      for (std::uint32_t v = 0; v < radvor_delaunay_vertex_bound(d); ++v) {
        std::array<double, 2> p{};
        if (radvor_delaunay_position(d, v, p.data()) != RADVOR_OK) {
          continue;
        }
        EXPECT_GE(turn(a, b, p), 0);
        const bool between = turn(a, b, p) == 0 && (p[0] - a[0]) * (p[0] - b[0]) + (p[1] - a[1]) * (p[1] - b[1]) < 0;
        EXPECT_FALSE(between) << v << " is missing from the hull";
      }
    }
    EXPECT_EQ(hull_area, area);
  }
}

TEST(DelaunayApi, CopyClosesUpTheIds) {
  const Engine engine;
  const Delaunay d(engine);
  const std::vector<double> xy = random_points(50, 2);
  ASSERT_EQ(radvor_delaunay_insert_many(d, xy.data(), 50, nullptr), RADVOR_OK);
  for (std::uint32_t v = 0; v < 50; v += 3) {
    ASSERT_EQ(radvor_delaunay_remove(d, v), RADVOR_OK);
  }
  const std::uint32_t count = radvor_delaunay_vertex_count(d), triangle_count = radvor_delaunay_triangle_count(d);
  ASSERT_EQ(count, 33u);
  std::vector<double> copied(2 * count);
  Ids ids(count), indices(3 * std::size_t{triangle_count});
  ASSERT_EQ(radvor_delaunay_copy(d, copied.data(), ids.data(), count, indices.data(), triangle_count), RADVOR_OK);
  for (std::uint32_t i = 0; i < count; ++i) {
    EXPECT_EQ(copied[2 * i], xy[2 * ids[i]]);
    EXPECT_EQ(copied[2 * i + 1], xy[2 * ids[i] + 1]);
    EXPECT_TRUE(i == 0 || ids[i] > ids[i - 1]);
  }
  const auto triangles = d.triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(ids[indices[3 * t + k]], triangles[t][k]);
    }
  }
  // The next vertices take the ids that are free, then new ones.
  std::set<std::uint32_t> taken;
  for (int i = 0; i < 17; ++i) {
    taken.insert(d.insert(2 + i, i * i));
  }
  EXPECT_EQ(taken.size(), 17u);
  EXPECT_LT(*taken.rbegin(), 50u);
  EXPECT_EQ(d.insert(50, 50), 50u);
}

TEST(DelaunayApi, ManyThreadsMayAskAtOnce) {
  const Engine engine;
  const Delaunay d(engine);
  const auto xy = random_points(2000, 8), queries = random_points(500, 9);
  ASSERT_EQ(radvor_delaunay_insert_many(d, xy.data(), 2000, nullptr), RADVOR_OK);
  d.constrain(3, 4, RADVOR_CONSTRAINT_CONTINUOUS);
  ASSERT_EQ(radvor_delaunay_set_values(d, xy.data(), 0, 2000), RADVOR_OK);
  const auto ask = [&](std::vector<double>& answers) {
    std::uint32_t hint = RADVOR_NONE;
    for (std::size_t i = 0; i < 500; ++i) {
      double value = 0, area = 0;
      std::uint32_t where = 0, sectors = 0;
      (void)radvor_delaunay_interpolate(d, i % 2, queries[2 * i], queries[2 * i + 1], i % 3 ? &hint : nullptr, &value);
      (void)radvor_delaunay_locate(d, queries[2 * i], queries[2 * i + 1], nullptr, &where, nullptr);
      (void)radvor_delaunay_bounded_cell(d, static_cast<std::uint32_t>(i), 0, &sectors, nullptr, nullptr, &area,
                                         nullptr);
      answers.insert(answers.end(), {std::isnan(value) ? -1 : value, double(where), double(sectors), area});
    }
  };
  std::vector<std::vector<double>> answers(5);
  ask(answers[0]);
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < answers.size(); ++i) {
    threads.emplace_back([&, i] { ask(answers[i]); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (std::size_t i = 1; i < answers.size(); ++i) {
    EXPECT_EQ(answers[i], answers[0]);
  }
}

}  // namespace
}  // namespace radvor::test
