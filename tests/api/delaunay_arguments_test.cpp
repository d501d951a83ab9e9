// radvor_delaunay_*: every kind of mistake is refused with the right code and words, and changes nothing.
#include <gtest/gtest.h>
#include <radvor.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "api/engine.h"
#include "api/refusal.h"

namespace radvor::test {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinity = std::numeric_limits<double>::infinity();

// A square of 4 with a vertex in its middle, a border all around, one diagonal's half a wall, and a gap in the ids.
class DelaunayArguments : public testing::Test {
 protected:
  DelaunayArguments() {
    EXPECT_EQ(radvor_delaunay_create(engine.context(), &d), RADVOR_OK);
    const double xy[] = {0, 0, 4, 0, 4, 4, 0, 4, 2, 2, 1, 3};
    EXPECT_EQ(radvor_delaunay_insert_many(d, xy, 6, nullptr), RADVOR_OK);
    EXPECT_EQ(radvor_delaunay_remove(d, 5), RADVOR_OK);
    for (std::uint32_t v = 0; v < 4; ++v) {
      EXPECT_EQ(radvor_delaunay_constrain_as(d, v, (v + 1) % 4, RADVOR_CONSTRAINT_BORDER, RADVOR_CROSSING_REFUSE),
                RADVOR_OK);
      const double value = v;
      EXPECT_EQ(radvor_delaunay_set_values(d, &value, v, 1), RADVOR_OK);
    }
    EXPECT_EQ(radvor_delaunay_constrain(d, 0, 4), RADVOR_OK);
    EXPECT_EQ(radvor_delaunay_mark_domain(d), RADVOR_OK);
  }
  ~DelaunayArguments() override { radvor_delaunay_destroy(d); }

  /// All that can be asked of the triangulation itself; radvor_delaunay_changes is about the last edit, also one that
  /// failed.
  struct State {
    std::vector<std::uint32_t> triangles, constraints;
    std::vector<double> positions, values;
    std::uint32_t bound, ties;
    bool operator==(const State&) const = default;
  };

  State state() const {
    State s{};
    const std::uint32_t triangles = radvor_delaunay_triangle_count(d);
    s.triangles.resize(std::size_t{3} * triangles);
    EXPECT_EQ(radvor_delaunay_triangles(d, s.triangles.data(), triangles), RADVOR_OK);
    std::uint32_t count = radvor_delaunay_constraint_count(d);
    s.constraints.resize(std::size_t{2} * count);
    EXPECT_EQ(radvor_delaunay_constraints(d, s.constraints.data(), &count), RADVOR_OK);
    s.positions.resize(std::size_t{2} * radvor_delaunay_vertex_count(d));
    EXPECT_EQ(radvor_delaunay_copy(d, s.positions.data(), nullptr, radvor_delaunay_vertex_count(d), nullptr, 0),
              RADVOR_OK);
    for (std::uint32_t v = 0; v < 4; ++v) {
      double value = 0;
      EXPECT_EQ(radvor_delaunay_value(d, v, &value), RADVOR_OK);
      s.values.push_back(value);
    }
    s.bound = radvor_delaunay_vertex_bound(d);
    EXPECT_EQ(radvor_delaunay_tie_count(d, &s.ties), RADVOR_OK);
    EXPECT_EQ(radvor_delaunay_validate(d), RADVOR_OK) << engine.error();
    return s;
  }

  void refused(radvor_result expected, const char* function, const char* words,
               const std::function<radvor_result()>& call) const {
    const State before = state();
    expect_refusal(engine, expected, function, words, call);
    EXPECT_TRUE(state() == before) << function << " changed something: " << words;
  }

  Engine engine;
  radvor_delaunay* d = nullptr;
};

constexpr radvor_result k_argument = RADVOR_ERROR_INVALID_ARGUMENT;

TEST_F(DelaunayArguments, NullHandlesAreRefusedOrEmpty) {
  std::uint32_t n = 7, flags = 7;
  double xy[2] = {0, 0}, value = 0;
  radvor_delaunay* made = d;
  EXPECT_EQ(radvor_delaunay_create(nullptr, &made), k_argument);
  EXPECT_EQ(made, nullptr);
  EXPECT_EQ(radvor_delaunay_create(engine.context(), nullptr), k_argument);
  radvor_delaunay_destroy(nullptr);
  EXPECT_EQ(radvor_delaunay_insert(nullptr, 0, 0, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_insert_near(nullptr, 0, 0, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_insert_many(nullptr, xy, 1, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_remove(nullptr, 0), k_argument);
  EXPECT_EQ(radvor_delaunay_constrain(nullptr, 0, 1), k_argument);
  EXPECT_EQ(radvor_delaunay_constrain_as(nullptr, 0, 1, 1, 0), k_argument);
  EXPECT_EQ(radvor_delaunay_unconstrain(nullptr, 0, 1), k_argument);
  EXPECT_EQ(radvor_delaunay_split(nullptr, 0, 1, 2, 0, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_constraint(nullptr, 0, 1, &flags), k_argument);
  EXPECT_EQ(radvor_delaunay_mark_domain(nullptr), k_argument);
  EXPECT_EQ(radvor_delaunay_unmark_domain(nullptr), k_argument);
  EXPECT_EQ(radvor_delaunay_set_values(nullptr, &value, 0, 1), k_argument);
  EXPECT_EQ(radvor_delaunay_realign(nullptr), k_argument);
  EXPECT_EQ(radvor_delaunay_realign_near(nullptr, &n, 1), k_argument);
  EXPECT_EQ(radvor_delaunay_position(nullptr, 0, xy), k_argument);
  EXPECT_EQ(radvor_delaunay_value(nullptr, 0, &value), k_argument);
  EXPECT_EQ(radvor_delaunay_locate(nullptr, 0, 0, nullptr, &n, nullptr), k_argument);
  EXPECT_EQ(radvor_delaunay_interpolate(nullptr, 0, 0, 0, nullptr, &value), k_argument);
  EXPECT_EQ(radvor_delaunay_tie_count(nullptr, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_triangles(nullptr, &n, 0), k_argument);
  EXPECT_EQ(radvor_delaunay_inside(nullptr, nullptr, 0), k_argument);
  EXPECT_EQ(radvor_delaunay_copy(nullptr, nullptr, nullptr, 0, nullptr, 0), k_argument);
  EXPECT_EQ(radvor_delaunay_neighbours(nullptr, 0, nullptr, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_hull(nullptr, nullptr, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_constraints(nullptr, nullptr, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_changes(nullptr, nullptr, &n), k_argument);
  EXPECT_EQ(radvor_delaunay_cell(nullptr, 0, nullptr, 0, nullptr, nullptr, &value, nullptr), k_argument);
  EXPECT_EQ(radvor_delaunay_bounded_cell(nullptr, 0, 0, &n, nullptr, nullptr, nullptr, nullptr), k_argument);
  EXPECT_EQ(radvor_delaunay_validate(nullptr), k_argument);
  EXPECT_EQ(n, 7u);
  EXPECT_EQ(flags, 7u);
  EXPECT_EQ(radvor_delaunay_vertex_count(nullptr), 0u);
  EXPECT_EQ(radvor_delaunay_vertex_bound(nullptr), 0u);
  EXPECT_EQ(radvor_delaunay_triangle_count(nullptr), 0u);
  EXPECT_EQ(radvor_delaunay_constraint_count(nullptr), 0u);
}

TEST_F(DelaunayArguments, CoordinatesThatAreNoNumbersOrBeyondTheRange) {
  std::uint32_t v = 99;
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "radvor_delaunay_insert", "(nan, 1) is not finite",
          [&] { return radvor_delaunay_insert(d, k_nan, 1, &v); });
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "radvor_delaunay_insert_near", "(1, -inf) is not finite",
          [&] { return radvor_delaunay_insert_near(d, 1, -k_infinity, &v); });
  refused(RADVOR_ERROR_LIMIT, "radvor_delaunay_insert", "(1e+300, 0)",
          [&] { return radvor_delaunay_insert(d, 1e300, 0, &v); });
  refused(RADVOR_ERROR_LIMIT, "radvor_delaunay_insert", "(1, 1e-60)",
          [&] { return radvor_delaunay_insert(d, 1, 1e-60, &v); });
  const double xy[] = {1, 1, 3, k_nan};
  std::uint32_t ids[] = {99, 99};
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "radvor_delaunay_insert_many", "(3, nan) is not finite",
          [&] { return radvor_delaunay_insert_many(d, xy, 2, ids); });
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "radvor_delaunay_split", "(2, nan) is not finite",
          [&] { return radvor_delaunay_split(d, 0, 1, 2, k_nan, &v); });
  std::uint32_t where = 99;
  double value = 99;
  for (const auto& call : std::vector<std::function<radvor_result()>>{
           [&] { return radvor_delaunay_locate(d, k_nan, 0, nullptr, &where, nullptr); },
           [&] { return radvor_delaunay_interpolate(d, RADVOR_BARYCENTRIC, 0, k_infinity, nullptr, &value); },
           [&] { return radvor_delaunay_interpolate(d, RADVOR_NATURAL_NEIGHBOUR, k_nan, 0, nullptr, &value); }}) {
    EXPECT_EQ(call(), RADVOR_ERROR_INVALID_GEOMETRY) << engine.error();
  }
  EXPECT_EQ(v, 99u);
  EXPECT_EQ(ids[0], 99u);
  EXPECT_EQ(where, 99u);
  EXPECT_EQ(value, 99);
}

TEST_F(DelaunayArguments, UnknownVertices) {
  std::uint32_t n = 8;
  double xy[2], value = 0;
  for (const std::uint32_t v : {5u, 6u, RADVOR_NONE}) {  // removed, beyond, none
    const std::string words = "there is no vertex " + std::to_string(v);
    const auto unknown = [&](const char* function, const std::function<radvor_result()>& call) {
      refused(k_argument, function, words.c_str(), call);
    };
    unknown("radvor_delaunay_remove", [&] { return radvor_delaunay_remove(d, v); });
    unknown("radvor_delaunay_constrain", [&] { return radvor_delaunay_constrain(d, v, 0); });
    unknown("radvor_delaunay_constrain_as", [&] { return radvor_delaunay_constrain_as(d, 0, v, 1, 1); });
    unknown("radvor_delaunay_unconstrain", [&] { return radvor_delaunay_unconstrain(d, 0, v); });
    unknown("radvor_delaunay_split", [&] { return radvor_delaunay_split(d, v, 0, 1, 0, &n); });
    unknown("radvor_delaunay_constraint", [&] { return radvor_delaunay_constraint(d, 0, v, &n); });
    unknown("radvor_delaunay_realign_near", [&] { return radvor_delaunay_realign_near(d, &v, 1); });
    unknown("radvor_delaunay_position", [&] { return radvor_delaunay_position(d, v, xy); });
    unknown("radvor_delaunay_value", [&] { return radvor_delaunay_value(d, v, &value); });
    unknown("radvor_delaunay_neighbours", [&] { return radvor_delaunay_neighbours(d, v, nullptr, &n); });
    unknown("radvor_delaunay_cell",
            [&] { return radvor_delaunay_cell(d, v, nullptr, 0, nullptr, nullptr, &value, nullptr); });
    unknown("radvor_delaunay_bounded_cell",
            [&] { return radvor_delaunay_bounded_cell(d, v, 0, &n, nullptr, nullptr, nullptr, nullptr); });
  }
  EXPECT_EQ(n, 8u);
}

TEST_F(DelaunayArguments, ConstraintsThatCannotBe) {
  std::uint32_t v = 99;
  refused(k_argument, "radvor_delaunay_constrain", "from vertex 2 to itself",
          [&] { return radvor_delaunay_constrain(d, 2, 2); });
  refused(k_argument, "radvor_delaunay_constrain_as", "flags is 0x0, without",
          [&] { return radvor_delaunay_constrain_as(d, 0, 2, 0, 0); });
  refused(k_argument, "radvor_delaunay_constrain_as", "flags is 0x80, without",
          [&] { return radvor_delaunay_constrain_as(d, 0, 2, 0x80, 0); });
  refused(k_argument, "radvor_delaunay_constrain_as", "flags is 0x109, of which 0x108 is unknown",
          [&] { return radvor_delaunay_constrain_as(d, 0, 2, 0x109, 0); });
  refused(k_argument, "radvor_delaunay_constrain_as", "crossing is 2",
          [&] { return radvor_delaunay_constrain_as(d, 0, 2, 1, 2); });
  refused(RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_unconstrain", "no constraint from vertex 1 to 4",
          [&] { return radvor_delaunay_unconstrain(d, 1, 4); });
  refused(RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_split", "no constraint from vertex 1 to 4",
          [&] { return radvor_delaunay_split(d, 1, 4, 3, 1, &v); });
  refused(RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_split", "cannot split",
          [&] { return radvor_delaunay_split(d, 0, 1, 2, 3, &v); });
  EXPECT_EQ(radvor_delaunay_insert(d, 6, 1, &v), RADVOR_OK);
  refused(RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_constrain", "would cross that from 1 to 2",
          [&] { return radvor_delaunay_constrain(d, 4, v); });
  EXPECT_EQ(radvor_delaunay_constrain_as(d, 1, v, RADVOR_CONSTRAINT_BORDER, 0), RADVOR_OK);
  refused(RADVOR_ERROR_CONSTRAINT, "radvor_delaunay_mark_domain", "the border does not close",
          [&] { return radvor_delaunay_mark_domain(d); });
}

TEST_F(DelaunayArguments, NullArraysAndPlacesAreNamed) {
  std::uint32_t n = 8;
  refused(k_argument, "radvor_delaunay_insert_near", "hint is NULL",
          [&] { return radvor_delaunay_insert_near(d, 1, 1, nullptr); });
  refused(k_argument, "radvor_delaunay_insert_many", "xy is NULL",
          [&] { return radvor_delaunay_insert_many(d, nullptr, 1, &n); });
  refused(k_argument, "radvor_delaunay_constraint", "flags is NULL",
          [&] { return radvor_delaunay_constraint(d, 0, 1, nullptr); });
  refused(k_argument, "radvor_delaunay_set_values", "values is NULL",
          [&] { return radvor_delaunay_set_values(d, nullptr, 0, 1); });
  refused(k_argument, "radvor_delaunay_realign_near", "vertices is NULL",
          [&] { return radvor_delaunay_realign_near(d, nullptr, 1); });
  refused(k_argument, "radvor_delaunay_position", "xy is NULL",
          [&] { return radvor_delaunay_position(d, 0, nullptr); });
  refused(k_argument, "radvor_delaunay_value", "value is NULL", [&] { return radvor_delaunay_value(d, 0, nullptr); });
  refused(k_argument, "radvor_delaunay_locate", "where is NULL",
          [&] { return radvor_delaunay_locate(d, 1, 1, &n, nullptr, nullptr); });
  refused(k_argument, "radvor_delaunay_interpolate", "value is NULL",
          [&] { return radvor_delaunay_interpolate(d, 0, 1, 1, &n, nullptr); });
  refused(k_argument, "radvor_delaunay_tie_count", "count is NULL",
          [&] { return radvor_delaunay_tie_count(d, nullptr); });
  refused(k_argument, "radvor_delaunay_triangles", "indices is NULL",
          [&] { return radvor_delaunay_triangles(d, nullptr, 100); });
  refused(k_argument, "radvor_delaunay_inside", "inside is NULL",
          [&] { return radvor_delaunay_inside(d, nullptr, 100); });
  refused(k_argument, "radvor_delaunay_neighbours", "count is NULL",
          [&] { return radvor_delaunay_neighbours(d, 4, &n, nullptr); });
  refused(k_argument, "radvor_delaunay_hull", "count is NULL", [&] { return radvor_delaunay_hull(d, &n, nullptr); });
  refused(k_argument, "radvor_delaunay_constraints", "count is NULL",
          [&] { return radvor_delaunay_constraints(d, &n, nullptr); });
  refused(k_argument, "radvor_delaunay_changes", "count is NULL",
          [&] { return radvor_delaunay_changes(d, &n, nullptr); });
  double polygon[2];
  refused(k_argument, "radvor_delaunay_cell", "polygon_size is NULL",
          [&] { return radvor_delaunay_cell(d, 4, nullptr, 0, polygon, nullptr, nullptr, nullptr); });
}

TEST_F(DelaunayArguments, NumbersOutOfRange) {
  double value = k_infinity;
  refused(k_argument, "radvor_delaunay_set_values", "vertex 1 is infinite",
          [&] { return radvor_delaunay_set_values(d, &value, 1, 1); });
  const std::vector<double> values(8, 1.0);
  refused(k_argument, "radvor_delaunay_set_values", "values for vertices 0 ... 7 of 6",
          [&] { return radvor_delaunay_set_values(d, values.data(), 0, 8); });
  refused(k_argument, "radvor_delaunay_interpolate", "method is 2",
          [&] { return radvor_delaunay_interpolate(d, 2, 1, 1, nullptr, &value); });
  const double line[] = {0, 0, 1, 0}, right[] = {0, 0, 0, 1, 1, 0}, wild[] = {0, 0, 1, 0, k_nan, 1};
  refused(k_argument, "radvor_delaunay_cell", "a window of 2 points",
          [&] { return radvor_delaunay_cell(d, 4, line, 2, nullptr, nullptr, &value, nullptr); });
  refused(k_argument, "radvor_delaunay_cell", "turns right",
          [&] { return radvor_delaunay_cell(d, 4, right, 3, nullptr, nullptr, &value, nullptr); });
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "radvor_delaunay_cell", "window point 2 is not finite",
          [&] { return radvor_delaunay_cell(d, 4, wild, 3, nullptr, nullptr, &value, nullptr); });
  refused(k_argument, "radvor_delaunay_bounded_cell", "vertex 4 has 1 sectors, none is 1",
          [&] { return radvor_delaunay_bounded_cell(d, 4, 1, nullptr, nullptr, nullptr, &value, nullptr); });
}

// The number is told, and nothing is written beyond the room there is.
TEST_F(DelaunayArguments, TooLittleRoom) {
  std::uint32_t out[16], n = 1;
  const auto fresh = [&] {
    std::fill(std::begin(out), std::end(out), 77u);
    n = 1;
  };
  const auto untouched_from = [&](std::size_t first) {
    for (std::size_t i = first; i < std::size(out); ++i) {
      EXPECT_EQ(out[i], 77u) << i;
    }
  };
  fresh();
  refused(k_argument, "radvor_delaunay_neighbours", "there are 4 elements, and room for 1",
          [&] { return radvor_delaunay_neighbours(d, 4, out, &n); });
  EXPECT_EQ(n, 4u);
  untouched_from(1);
  fresh();
  refused(k_argument, "radvor_delaunay_hull", "there are 4 elements, and room for 1",
          [&] { return radvor_delaunay_hull(d, out, &n); });
  EXPECT_EQ(n, 4u);
  untouched_from(1);
  fresh();
  refused(k_argument, "radvor_delaunay_constraints", "pairs has room for 1 of 5",
          [&] { return radvor_delaunay_constraints(d, out, &n); });
  EXPECT_EQ(n, 5u);
  untouched_from(0);
  fresh();
  refused(k_argument, "radvor_delaunay_triangles", "indices has room for 3 of 4",
          [&] { return radvor_delaunay_triangles(d, out, 3); });
  std::uint8_t inside[4] = {7, 7, 7, 7};
  refused(k_argument, "radvor_delaunay_inside", "inside has room for 3 of 4",
          [&] { return radvor_delaunay_inside(d, inside, 3); });
  EXPECT_EQ(inside[0], 7);
  refused(k_argument, "radvor_delaunay_copy", "xy has room for 4 of 5",
          [&] { return radvor_delaunay_copy(d, nullptr, out, 4, nullptr, 0); });
  refused(k_argument, "radvor_delaunay_copy", "indices has room for 3 of 4",
          [&] { return radvor_delaunay_copy(d, nullptr, nullptr, 0, out, 3); });
  untouched_from(0);
  double polygon[16] = {};
  polygon[2] = 77;
  refused(k_argument, "radvor_delaunay_cell", "polygon has room for 1 of 4",
          [&] { return radvor_delaunay_cell(d, 4, nullptr, 0, polygon, &(n = 1), nullptr, nullptr); });
  EXPECT_EQ(n, 4u);
  EXPECT_EQ(polygon[2], 77);
}

TEST_F(DelaunayArguments, NothingIsAskedAndNothingIsDone) {
  const State before = state();
  EXPECT_EQ(radvor_delaunay_insert_many(d, nullptr, 0, nullptr), RADVOR_OK);
  EXPECT_EQ(radvor_delaunay_set_values(d, nullptr, 0, 0), RADVOR_OK);
  EXPECT_EQ(radvor_delaunay_set_values(d, nullptr, 1000, 0), RADVOR_OK);
  EXPECT_EQ(radvor_delaunay_realign_near(d, nullptr, 0), RADVOR_OK);
  EXPECT_TRUE(state() == before);
  radvor_delaunay* empty = nullptr;
  ASSERT_EQ(radvor_delaunay_create(engine.context(), &empty), RADVOR_OK);
  std::uint32_t n = 5, where = 99;
  double value = 0;
  EXPECT_EQ(radvor_delaunay_hull(empty, &n, &n), RADVOR_OK);
  EXPECT_EQ(n, 0u);
  EXPECT_EQ(radvor_delaunay_triangles(empty, nullptr, 0), RADVOR_OK);
  EXPECT_EQ(radvor_delaunay_inside(empty, nullptr, 0), RADVOR_OK);
  EXPECT_EQ(radvor_delaunay_locate(empty, 0, 0, nullptr, &where, nullptr), RADVOR_OK);
  EXPECT_EQ(where, static_cast<std::uint32_t>(RADVOR_OUTSIDE));
  EXPECT_EQ(radvor_delaunay_interpolate(empty, RADVOR_NATURAL_NEIGHBOUR, 0, 0, nullptr, &value), RADVOR_OK);
  EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(radvor_delaunay_realign(empty), RADVOR_OK);
  EXPECT_EQ(radvor_delaunay_mark_domain(empty), RADVOR_OK);
  EXPECT_EQ(radvor_delaunay_validate(empty), RADVOR_OK);
  radvor_delaunay_destroy(empty);
}

}  // namespace
}  // namespace radvor::test
