// The Delaunay kernel as an engine sees it: every function against brute force, every refusal, memory that runs out,
// the caller's floating-point environment, and calls from several threads.
#include <gtest/gtest.h>
#include <radvor.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <thread>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "api/engine.h"
#include "api/refusal.h"

namespace radvor::test {
namespace {

using Ids = std::vector<std::uint32_t>;

class Delaunay {
 public:
  explicit Delaunay(const Engine& engine) { EXPECT_EQ(radvor_delaunay_create(engine.context(), &handle_), RADVOR_OK); }
  ~Delaunay() { radvor_delaunay_destroy(handle_); }
  Delaunay(const Delaunay&) = delete;
  Delaunay& operator=(const Delaunay&) = delete;
  operator radvor_delaunay*() const { return handle_; }

  std::uint32_t insert(double x, double y) const {
    std::uint32_t vertex = RADVOR_NONE;
    EXPECT_EQ(radvor_delaunay_insert(handle_, x, y, &vertex), RADVOR_OK);
    return vertex;
  }
  void constrain(std::uint32_t a, std::uint32_t b, std::uint32_t flags) const {
    EXPECT_EQ(radvor_delaunay_constrain_as(handle_, a, b, flags, RADVOR_CROSSING_REFUSE), RADVOR_OK);
  }
  std::array<double, 2> position(std::uint32_t vertex) const {
    std::array<double, 2> xy{};
    EXPECT_EQ(radvor_delaunay_position(handle_, vertex, xy.data()), RADVOR_OK);
    return xy;
  }

  /// width elements each.
  using List = radvor_result (*)(const radvor_delaunay*, std::uint32_t*, std::uint32_t*);
  Ids list(List function, std::uint32_t width) const {
    std::uint32_t count = 0;
    EXPECT_EQ(function(handle_, nullptr, &count), RADVOR_OK);
    Ids ids(std::size_t{width} * count + 1);
    EXPECT_EQ(function(handle_, ids.data(), &count), RADVOR_OK);
    ids.pop_back();
    return ids;
  }
  Ids hull() const { return list(radvor_delaunay_hull, 1); }
  Ids changes() const { return list(radvor_delaunay_changes, 1); }
  std::set<std::array<std::uint32_t, 2>> pairs(List function) const {
    std::set<std::array<std::uint32_t, 2>> pairs;
    const Ids ids = list(function, 2);
    for (std::size_t i = 0; i < ids.size(); i += 2) {
      EXPECT_LT(ids[i], ids[i + 1]);
      pairs.insert({ids[i], ids[i + 1]});
    }
    EXPECT_EQ(2 * pairs.size(), ids.size()) << "an edge came twice";
    return pairs;
  }
  Ids neighbours(std::uint32_t vertex) const {
    std::uint32_t count = 0;
    EXPECT_EQ(radvor_delaunay_neighbours(handle_, vertex, nullptr, &count), RADVOR_OK);
    Ids ids(count + 1);
    EXPECT_EQ(radvor_delaunay_neighbours(handle_, vertex, ids.data(), &count), RADVOR_OK);
    ids.pop_back();
    return ids;
  }
  std::vector<std::array<std::uint32_t, 3>> triangles() const {
    const std::uint32_t count = radvor_delaunay_triangle_count(handle_);
    Ids indices(3 * std::size_t{count} + 1);
    EXPECT_EQ(radvor_delaunay_triangles(handle_, indices.data(), count), RADVOR_OK);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    }
    return triangles;
  }

  /// Vertices, triangles from their least corner on, constraints with flags, values: all that an edit may change.
  std::vector<double> state() const {
    std::vector<double> state;
    for (std::uint32_t v = 0; v < radvor_delaunay_vertex_bound(handle_); ++v) {
      double xy[2] = {-1e300, 0}, value = -1e300;
      if (radvor_delaunay_position(handle_, v, xy) == RADVOR_OK) {
        EXPECT_EQ(radvor_delaunay_value(handle_, v, &value), RADVOR_OK);
      }
      state.insert(state.end(), {xy[0], xy[1], std::isnan(value) ? 1e300 : value});
    }
    auto all = triangles();
    for (auto& triangle : all) {
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    std::sort(all.begin(), all.end());
    for (const auto& triangle : all) {
      state.insert(state.end(), triangle.begin(), triangle.end());
    }
    for (const auto& [a, b] : pairs(radvor_delaunay_constraints)) {
      std::uint32_t flags = 0;
      EXPECT_EQ(radvor_delaunay_constraint(handle_, a, b, &flags), RADVOR_OK);
      state.insert(state.end(), {double(a), double(b), double(flags)});
    }
    return state;
  }

 private:
  radvor_delaunay* handle_ = nullptr;
};

std::uint32_t pick(std::mt19937& random, std::uint32_t count) {
  return static_cast<std::uint32_t>(random() % count);
}

double turn(std::array<double, 2> a, std::array<double, 2> b, std::array<double, 2> c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

std::vector<double> random_points(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> xy(2 * count);
  for (double& coordinate : xy) {
    coordinate = unit(random);
  }
  return xy;
}

// ---- What is there

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

// ---- What changed

using Star = std::map<std::uint32_t, std::uint32_t>;  // neighbours and the flags of the edges to them

std::map<std::uint32_t, Star> stars(const Delaunay& d) {
  std::map<std::uint32_t, Star> stars;
  for (std::uint32_t v = 0; v < radvor_delaunay_vertex_bound(d); ++v) {
    double xy[2];
    if (radvor_delaunay_position(d, v, xy) == RADVOR_OK) {
      for (const std::uint32_t n : d.neighbours(v)) {
        EXPECT_EQ(radvor_delaunay_constraint(d, v, n, &stars[v][n]), RADVOR_OK);
      }
      stars[v];
    }
  }
  return stars;
}

TEST(DelaunayApi, ChangesNameEveryVertexWhoseStarChanged) {
  const Engine engine;
  const Delaunay d(engine);
  std::mt19937 random(3);
  auto before = stars(d);
  int tight = 0, edits = 0;
  for (int i = 0; i < 600; ++i) {
    const std::uint32_t bound = radvor_delaunay_vertex_bound(d) + 1;
    const std::uint32_t a = pick(random, bound), b = pick(random, bound);
    radvor_result result = RADVOR_OK;
    const unsigned kind = pick(random, 8);
    switch (kind) {
      default:
        result = radvor_delaunay_insert(d, pick(random, 16), pick(random, 16), nullptr);
        break;
      case 4:
        result = radvor_delaunay_remove(d, a);
        break;
      case 5:
        result = radvor_delaunay_constrain_as(d, a, b, 1u << pick(random, 3), pick(random, 2));
        break;
      case 6:
        result = radvor_delaunay_unconstrain(d, a, b);
        break;
      case 7: {
        const double value = pick(random, 3);
        if (a + 1 < bound) {
          ASSERT_EQ(radvor_delaunay_set_values(d, &value, a, 1), RADVOR_OK);
        }
        result = radvor_delaunay_realign(d);
      }
    }
    const auto after = stars(d);
    if (result != RADVOR_OK) {
      ASSERT_EQ(after, before);
      continue;
    }
    std::set<std::uint32_t> changed;
    for (const auto& [v, star] : after) {
      const auto was = before.find(v);
      if (was == before.end() || was->second != star) {
        changed.insert(v);
      }
    }
    const Ids told = d.changes();
    const std::set<std::uint32_t> reported(told.begin(), told.end());
    ASSERT_EQ(reported.size(), told.size()) << "a vertex is told of twice";
    for (const std::uint32_t v : changed) {
      ASSERT_TRUE(reported.count(v)) << "edit " << kind << ": the star of " << v << " changed";
    }
    for (const std::uint32_t v : reported) {
      ASSERT_TRUE(after.count(v)) << v << " is not there";
    }
    tight += reported.size() <= changed.size() + 4;
    ++edits;
    before = after;
  }
  EXPECT_GT(edits, 300);
  EXPECT_GT(tight, edits * 3 / 4) << "reports are much longer than they need to be";
}

// ---- What is refused

TEST(DelaunayApi, CoordinatesUpToTheBoundAndNotBeyond) {
  const Engine engine;
  const Delaunay d(engine);
  d.insert(0x1p200, -0x1p200);
  d.insert(0x1p-142, 0);
  d.insert(-0x1p-142, -0x1p-142);
  d.insert(-0x1p200, 0x1p-142);
  ASSERT_EQ(radvor_delaunay_validate(d), RADVOR_OK);
  d.constrain(0, 2, RADVOR_CONSTRAINT_BORDER);
  const auto before = d.state();
  const double nan = std::nan(""), infinity = HUGE_VAL;
  for (const double bad : {std::nextafter(0x1p200, infinity), std::nextafter(-0x1p200, -infinity), 0x1p1000,
                           std::nextafter(0x1p-142, 0.0), -0x1p-143, 0x1p-1074, nan, infinity, -infinity}) {
    const radvor_result expected = std::isfinite(bad) ? RADVOR_ERROR_LIMIT : RADVOR_ERROR_INVALID_GEOMETRY;
    std::uint32_t vertex = RADVOR_NONE, where = 0;
    double value = 0;
    const double many[] = {1, 2, bad, 3, 4, 5};
    EXPECT_EQ(radvor_delaunay_insert(d, bad, 1, nullptr), expected) << bad;
    EXPECT_EQ(radvor_delaunay_insert(d, 1, bad, nullptr), expected) << bad;
    EXPECT_EQ(radvor_delaunay_insert_near(d, 1, bad, &vertex), expected) << bad;
    EXPECT_EQ(radvor_delaunay_insert_many(d, many, 3, nullptr), expected) << bad;
    EXPECT_EQ(radvor_delaunay_split(d, 0, 2, bad, bad, nullptr), expected) << bad;
    EXPECT_EQ(radvor_delaunay_locate(d, bad, 1, nullptr, &where, nullptr), expected) << bad;
    EXPECT_EQ(radvor_delaunay_interpolate(d, RADVOR_NATURAL_NEIGHBOUR, 1, bad, nullptr, &value), expected) << bad;
    EXPECT_EQ(d.state(), before);
  }
  EXPECT_EQ(radvor_delaunay_validate(d), RADVOR_OK);
}

TEST(DelaunayApi, WrongArgumentsAreNamed) {
  const Engine engine;
  const Delaunay d(engine);
  for (const double x : {0.0, 4.0}) {
    d.insert(x, 0);
    d.insert(x, 4);
  }
  d.insert(2, 1);
  ASSERT_EQ(radvor_delaunay_remove(d, 4), RADVOR_OK);
  d.constrain(0, 3, RADVOR_CONSTRAINT_BORDER);
  const auto before = d.state();
  const double xy[] = {1, 1, HUGE_VAL, 0}, two[] = {1, 2}, clockwise[] = {0, 0, 0, 1, 1, 0};
  std::uint32_t id = 0, count = 0, flags = 0;
  double at[2];
  Ids room(8);
  struct Wrong {
    radvor_result result;
    const char* function;
    const char* words;
    std::function<radvor_result()> call;
  };
  const radvor_result argument = RADVOR_ERROR_INVALID_ARGUMENT;
  const Wrong table[] = {
      {argument, "radvor_delaunay_remove", "4", [&] { return radvor_delaunay_remove(d, 4); }},
      {argument, "radvor_delaunay_remove", "5", [&] { return radvor_delaunay_remove(d, 5); }},
      {argument, "radvor_delaunay_constrain", "4", [&] { return radvor_delaunay_constrain(d, 0, 4); }},
      {argument, "radvor_delaunay_constrain", "itself", [&] { return radvor_delaunay_constrain(d, 1, 1); }},
      {RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_constrain", "1 to 2",
       [&] { return radvor_delaunay_constrain(d, 1, 2); }},
      {argument, "radvor_delaunay_constrain_as", "flags is 0x0",
       [&] { return radvor_delaunay_constrain_as(d, 0, 1, 0, 0); }},
      {argument, "radvor_delaunay_constrain_as", "flags is 0x10",
       [&] { return radvor_delaunay_constrain_as(d, 0, 1, 0x10, 0); }},
      {argument, "radvor_delaunay_constrain_as", "flags", [&] { return radvor_delaunay_constrain_as(d, 0, 1, 9, 0); }},
      {argument, "radvor_delaunay_constrain_as", "crossing is 2",
       [&] { return radvor_delaunay_constrain_as(d, 0, 1, 1, 2); }},
      {RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_unconstrain", "0 to 1",
       [&] { return radvor_delaunay_unconstrain(d, 0, 1); }},
      {RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_split", "0 to 1",
       [&] { return radvor_delaunay_split(d, 0, 1, 0, 2, nullptr); }},
      {RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_split", "(-1, 6)",
       [&] { return radvor_delaunay_split(d, 0, 3, -1, 6, nullptr); }},
      {RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_mark_domain", "close", [&] { return radvor_delaunay_mark_domain(d); }},
      {RADVOR_ERROR_INVALID_GEOMETRY, "radvor_delaunay_insert_many", "inf",
       [&] { return radvor_delaunay_insert_many(d, xy, 2, nullptr); }},
      {argument, "radvor_delaunay_insert_many", "xy",
       [&] { return radvor_delaunay_insert_many(d, nullptr, 2, nullptr); }},
      {argument, "radvor_delaunay_insert_near", "hint", [&] { return radvor_delaunay_insert_near(d, 1, 1, nullptr); }},
      {argument, "radvor_delaunay_set_values", "4", [&] { return radvor_delaunay_set_values(d, two, 4, 2); }},
      {argument, "radvor_delaunay_set_values", "infinite", [&] { return radvor_delaunay_set_values(d, xy + 2, 0, 1); }},
      {argument, "radvor_delaunay_realign_near", "7",
       [&] {
         id = 7;
         return radvor_delaunay_realign_near(d, &id, 1);
       }},
      {argument, "radvor_delaunay_position", "4", [&] { return radvor_delaunay_position(d, 4, at); }},
      {argument, "radvor_delaunay_value", "value", [&] { return radvor_delaunay_value(d, 0, nullptr); }},
      {argument, "radvor_delaunay_constraint", "9", [&] { return radvor_delaunay_constraint(d, 0, 9, &flags); }},
      {argument, "radvor_delaunay_locate", "where",
       [&] { return radvor_delaunay_locate(d, 1, 1, nullptr, nullptr, nullptr); }},
      {argument, "radvor_delaunay_interpolate", "method is 2",
       [&] { return radvor_delaunay_interpolate(d, 2, 1, 1, nullptr, at); }},
      {argument, "radvor_delaunay_triangles", "room for 1 of 2",
       [&] { return radvor_delaunay_triangles(d, room.data(), 1); }},
      {argument, "radvor_delaunay_hull", "4 elements, and room for 3",
       [&] {
         count = 3;
         const radvor_result result = radvor_delaunay_hull(d, room.data(), &count);
         EXPECT_EQ(count, 4u);
         return result;
       }},
      {argument, "radvor_delaunay_edges", "room for 2 of 5",
       [&] {
         count = 2;
         const radvor_result result = radvor_delaunay_edges(d, room.data(), &count);
         EXPECT_EQ(count, 5u);
         return result;
       }},
      {argument, "radvor_delaunay_cell", "window of 2",
       [&] { return radvor_delaunay_cell(d, 0, clockwise, 2, nullptr, nullptr, nullptr, nullptr); }},
      {argument, "radvor_delaunay_cell", "turns right",
       [&] { return radvor_delaunay_cell(d, 0, clockwise, 3, nullptr, nullptr, nullptr, nullptr); }},
      {argument, "radvor_delaunay_bounded_cell", "none is 2",
       [&] { return radvor_delaunay_bounded_cell(d, 0, 2, nullptr, nullptr, nullptr, at, nullptr); }},
  };
  for (const Wrong& wrong : table) {
    expect_refusal(engine, wrong.result, wrong.function, wrong.words, wrong.call);
    EXPECT_EQ(d.state(), before) << wrong.function;
  }
  EXPECT_EQ(radvor_delaunay_insert(nullptr, 0, 0, nullptr), RADVOR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(radvor_delaunay_validate(nullptr), RADVOR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(radvor_delaunay_vertex_count(nullptr), 0u);
  radvor_delaunay_destroy(nullptr);
}

// ---- Memory

// Every kind of edit, refused from its first block on, from its second, and so on until it works: it is as before.
TEST(DelaunayApi, MemoryRefusedAtAnyBlock) {
  using Edit = std::function<radvor_result(radvor_delaunay*)>;
  const auto many = random_points(300, 4);
  const std::vector<std::pair<const char*, Edit>> edits = {
      {"insert", [](radvor_delaunay* d) { return radvor_delaunay_insert(d, 1.5, 2.25, nullptr); }},
      {"insert many", [&](radvor_delaunay* d) { return radvor_delaunay_insert_many(d, many.data(), 300, nullptr); }},
      {"remove", [](radvor_delaunay* d) { return radvor_delaunay_remove(d, 0); }},
      {"remove inside", [](radvor_delaunay* d) { return radvor_delaunay_remove(d, 14); }},
      {"constrain", [](radvor_delaunay* d) { return radvor_delaunay_constrain(d, 14, 33); }},
      {"cross", [](radvor_delaunay* d) { return radvor_delaunay_constrain_as(d, 2, 33, 4, RADVOR_CROSSING_SPLIT); }},
      {"unconstrain", [](radvor_delaunay* d) { return radvor_delaunay_unconstrain(d, 6, 11); }},
      {"split", [](radvor_delaunay* d) { return radvor_delaunay_split(d, 7, 8, 1 + 0x1p-50, 1.75, nullptr); }},
      {"realign", [](radvor_delaunay* d) { return radvor_delaunay_realign(d); }},
      {"mark", [](radvor_delaunay* d) { return radvor_delaunay_mark_domain(d); }},
      {"values", [](radvor_delaunay* d) {
         const double values[] = {1, 2, 3};
         return radvor_delaunay_set_values(d, values, 3, 3);
       }}};
  int refused = 0;
  for (const bool steered : {false, true}) {
    for (const auto& [name, edit] : edits) {
      bool done = false;
      for (std::uint64_t n = 1; !done; ++n) {
        ASSERT_LT(n, 200u);
        Engine engine;
        const Delaunay d(engine);
        for (int i = 0; i < 36; ++i) {
          d.insert(i / 6, i % 6);
        }
        if (steered) {
          std::vector<double> values;
          for (int i = 0; i < 36; ++i) {
            values.push_back(i * i % 7);
          }
          ASSERT_EQ(radvor_delaunay_set_values(d, values.data(), 0, 36), RADVOR_OK);
        }
        d.constrain(6, 11, RADVOR_CONSTRAINT_CONTINUOUS);
        const auto before = d.state();
        engine.refuse_from(n);
        const radvor_result result = edit(d);
        engine.refuse_from(0);
        ASSERT_EQ(radvor_delaunay_validate(d), RADVOR_OK) << name << " at block " << n << ": " << engine.error();
        done = result == RADVOR_OK;
        if (!done) {
          ++refused;
          ASSERT_EQ(result, RADVOR_ERROR_OUT_OF_MEMORY) << name << " at block " << n << ": " << engine.error();
          ASSERT_EQ(d.state(), before) << name << " at block " << n;
          ASSERT_EQ(edit(d), RADVOR_OK) << name << " once there is memory: " << engine.error();
        }
      }
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(DelaunayApi, AMillionPointsTakeLessThan110BytesEach) {
  struct Memory {
    std::size_t live = 0, peak = 0;
  } memory;
  radvor_context_desc desc{};
  desc.struct_size = sizeof desc;
  desc.thread_count = 1;
  desc.user = &memory;
  desc.acquire = [](void* user, std::size_t bytes, std::size_t alignment) {
    auto& counted = *static_cast<Memory*>(user);
    counted.live += bytes;
    counted.peak = std::max(counted.peak, counted.live);
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  };
  desc.release = [](void* user, void* block, std::size_t bytes, std::size_t) {
    static_cast<Memory*>(user)->live -= bytes;
    std::free(block);
  };
  radvor_context* context = nullptr;
  ASSERT_EQ(radvor_context_create(&desc, &context), RADVOR_OK);
  const std::size_t before = memory.live;
  memory.peak = before;
  radvor_delaunay* d = nullptr;
  ASSERT_EQ(radvor_delaunay_create(context, &d), RADVOR_OK);
  const auto xy = random_points(1000000, 5);
  ASSERT_EQ(radvor_delaunay_insert_many(d, xy.data(), 1000000, nullptr), RADVOR_OK);
  EXPECT_LE(static_cast<double>(memory.peak - before) / 1e6, 110);
  radvor_delaunay_destroy(d);
  EXPECT_EQ(memory.live, before);
  radvor_context_destroy(context);
}

// A scene has thousands of facets with a handful of sites.
TEST(DelaunayApi, ASmallTriangulationTakesFewBlocks) {
  const Engine engine;
  const auto xy = random_points(12, 6);
  const std::uint64_t before = engine.blocks_acquired();
  const Delaunay d(engine);
  ASSERT_EQ(radvor_delaunay_insert_many(d, xy.data(), 12, nullptr), RADVOR_OK);
  EXPECT_LE(engine.blocks_acquired() - before, 10u);
}

// ---- The caller's floating-point environment

// A bit of everything that the environment could change; all numbers that came out.
std::vector<double> everything(const std::function<void()>& before_each) {
  const Engine engine;
  const Delaunay d(engine);
  std::vector<double> seen;
  const auto call = [&](auto&& function) {
    before_each();
    const radvor_result result = function();
    std::fesetround(FE_TONEAREST);
#if defined(__SSE2__)
    _mm_setcsr(0x1f80);
#endif
    seen.push_back(result);
  };
  // What is computed here is computed under our own environment.
  const auto random = random_points(200, 7);
  std::vector<double> circle, small, tiny;
  for (int i = 0; i < 100; ++i) {
    circle.push_back(std::cos(0.1 * i) / 3 + 0.3);
    circle.push_back(std::sin(0.1 * i) / 3 + 0.3);
  }
  for (const double x : random) {
    small.push_back(x * 0x1p-130);
    tiny.push_back(0x1p-142 * (1 + x));
  }
  std::uint32_t id = RADVOR_NONE;
  call([&] { return radvor_delaunay_insert_many(d, circle.data(), 100, nullptr); });
  for (std::size_t i = 0; i < 60; ++i) {
    call([&] { return radvor_delaunay_insert(d, random[2 * i], random[2 * i + 1], &id); });
    call([&] { return radvor_delaunay_insert_near(d, small[2 * i], random[2 * i + 1], &id); });
    call([&] { return radvor_delaunay_insert(d, tiny[2 * i], tiny[2 * i + 1], &id); });
  }
  for (std::uint32_t v = 0; v < 100; v += 9) {
    call([&] { return radvor_delaunay_remove(d, v); });
    call([&] { return radvor_delaunay_constrain_as(d, v + 1, v + 50, 2, RADVOR_CROSSING_SPLIT); });
    const auto a = d.position(v + 1), b = d.position(v + 2);
    const double x = (a[0] + b[0]) / 2, y = (a[1] + b[1]) / 2;
    call([&] { return radvor_delaunay_constrain_as(d, v + 1, v + 2, 1, RADVOR_CROSSING_SPLIT); });
    call([&] { return radvor_delaunay_split(d, v + 1, v + 2, x, y, &id); });
  }
  std::vector<double> values(radvor_delaunay_vertex_bound(d), 0.5);
  call([&] { return radvor_delaunay_set_values(d, values.data(), 0, static_cast<std::uint32_t>(values.size())); });
  call([&] { return radvor_delaunay_realign(d); });
  for (std::size_t i = 60; i < 100; ++i) {
    double value = 0, area = 0, centroid[2] = {0, 0};
    std::uint32_t where = 0;
    call([&] { return radvor_delaunay_locate(d, random[2 * i], random[2 * i + 1], nullptr, &where, nullptr); });
    call([&] { return radvor_delaunay_interpolate(d, i % 2, random[2 * i], random[2 * i + 1], nullptr, &value); });
    call([&] {
      return radvor_delaunay_cell(d, static_cast<std::uint32_t>(i), nullptr, 0, nullptr, nullptr, &area, centroid);
    });
    seen.insert(seen.end(), {double(where), std::isnan(value) ? -1 : value, area, centroid[0], centroid[1]});
    call([&] {
      return radvor_delaunay_bounded_cell(d, static_cast<std::uint32_t>(i), 0, &where, nullptr, nullptr, &area,
                                          centroid);
    });
    seen.insert(seen.end(), {double(where), area, centroid[0], centroid[1]});
  }
  call([&] { return radvor_delaunay_validate(d); });
  EXPECT_EQ(seen.back(), RADVOR_OK) << engine.error();
  const auto state = d.state();
  seen.insert(seen.end(), state.begin(), state.end());
  return seen;
}

TEST(DelaunayApi, RoundingAndDenormalModesOfTheCallerDoNotMatter) {
  const auto expected = everything([] {});
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    EXPECT_EQ(everything([rounding] { std::fesetround(rounding); }), expected) << "rounding " << rounding;
  }
#if defined(__SSE2__)
  EXPECT_EQ(everything([] { _mm_setcsr(_mm_getcsr() | 0x8040); }), expected) << "denormals flushed";
#endif
}

// ---- Threads

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
