// What the kernel refuses: coordinates beyond its bounds, and arguments that make no sense, each by its name.
#include <functional>

#include "api/refusal.h"
#include "api/triangulation.h"

namespace radvor::test {
namespace {

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

}  // namespace
}  // namespace radvor::test
