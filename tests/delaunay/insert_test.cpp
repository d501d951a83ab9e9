#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/error.h"
#include "delaunay/point_sets.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {
namespace {

using testing::canonical_triangles;
using testing::PointSet;

class PointSets : public ::testing::TestWithParam<PointSet> {};

TEST_P(PointSets, one_by_one_is_valid_at_every_step) {
  std::pmr::monotonic_buffer_resource memory;
  Triangulation d(&memory);
  const auto points = GetParam().make(60, 7);
  for (const Vec2 point : points) {
    const VertexId v = d.insert(point);
    EXPECT_EQ(d.position(v), point);
    ASSERT_NO_THROW(d.validate());
    EXPECT_EQ(d.insert(point), v);
  }
}

TEST_P(PointSets, any_order_and_bulk_agree) {
  auto points = GetParam().make(400, 11);
  Triangulation bulk(std::pmr::new_delete_resource());
  std::vector<VertexId> ids(points.size());
  bulk.insert_many(points, ids.data());
  ASSERT_NO_THROW(bulk.validate());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(bulk.position(ids[i]), points[i]);
  }
  const auto expected = canonical_triangles(bulk);
  std::mt19937 random(5);
  for (int round = 0; round < 3; ++round) {
    Triangulation online(std::pmr::new_delete_resource());
    std::shuffle(points.begin(), points.end(), random);
    for (const Vec2 point : points) {
      online.insert(point);
    }
    ASSERT_NO_THROW(online.validate());
    EXPECT_EQ(canonical_triangles(online), expected);
  }
  Triangulation halves(std::pmr::new_delete_resource());
  halves.insert_many(std::span(points).first(points.size() / 2), nullptr);
  halves.insert_many(points, nullptr);
  ASSERT_NO_THROW(halves.validate());
  EXPECT_EQ(canonical_triangles(halves), expected);
}

TEST_P(PointSets, removal_undoes_insertion) {
  const auto points = GetParam().make(120, 3);
  Triangulation d(std::pmr::new_delete_resource());
  std::mt19937 random(9);
  std::vector<VertexId> ids;
  for (const Vec2 point : points) {
    const VertexId v = d.insert(point);
    if (std::find(ids.begin(), ids.end(), v) == ids.end()) {
      ids.push_back(v);
    }
  }
  std::shuffle(ids.begin(), ids.end(), random);
  while (!ids.empty()) {
    const auto before = canonical_triangles(d);
    const VertexId v = ids.back();
    const Vec2 at = d.position(v);
    d.remove(v);
    ASSERT_NO_THROW(d.validate()) << "after removing " << v << ", left " << ids.size();
    ASSERT_FALSE(d.is_vertex(v));
    ASSERT_EQ(d.insert(at), v);
    ASSERT_NO_THROW(d.validate());
    ASSERT_EQ(canonical_triangles(d), before);
    d.remove(v);
    ids.pop_back();
  }
  EXPECT_EQ(d.vertex_count(), 0u);
}

INSTANTIATE_TEST_SUITE_P(insertion, PointSets, ::testing::ValuesIn(testing::point_sets()),
                         [](const auto& set) { return std::string(set.param.name); });

TEST(insertion, ids_count_up_in_input_order_and_duplicates_share_them) {
  Triangulation d(std::pmr::new_delete_resource());
  const std::vector<Vec2> points = {{3, 1}, {0, 0}, {3, 1}, {5, 5}, {0, 0}, {1, 4}, {-0.0, 0.0}};
  std::vector<VertexId> ids(points.size());
  d.insert_many(points, ids.data());
  EXPECT_EQ(ids, (std::vector<VertexId>{0, 1, 0, 2, 1, 3, 1}));
  EXPECT_EQ(d.vertex_count(), 4u);
  EXPECT_NO_THROW(d.validate());
}

TEST(insertion, refuses_what_predicates_cannot_decide) {
  Triangulation d(std::pmr::new_delete_resource());
  const auto code = [&](Vec2 point) {
    try {
      d.insert(point);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode{};
  };
  EXPECT_EQ(code({std::nan(""), 0}), ErrorCode::invalid_geometry);
  EXPECT_EQ(code({0, INFINITY}), ErrorCode::invalid_geometry);
  EXPECT_EQ(code({0, std::nextafter(0x1p200, INFINITY)}), ErrorCode::limit);
  EXPECT_EQ(code({-std::nextafter(0x1p-142, 0.0), 1}), ErrorCode::limit);
  EXPECT_EQ(code({0x1p-142, 0x1p200}), ErrorCode{});
  EXPECT_EQ(d.vertex_count(), 1u);
}

}  // namespace
}  // namespace radvor::delaunay
