#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "delaunay/point_sets.h"
#include "delaunay/triangulation.h"
#include "support/counted_memory.h"

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

TEST_P(PointSets, room_made_ahead_and_memory_let_go_change_nothing) {
  const auto points = GetParam().make(200, 19);
  const std::span<const Vec2> all(points);
  test::CountedMemory of_plain, of_trimmed;
  Triangulation plain(&of_plain);
  Triangulation trimmed(&of_trimmed);
  trimmed.reserve(static_cast<std::uint32_t>(points.size()));
  const std::size_t reserved = of_trimmed.blocks_ever;
  std::size_t calls_of_plain = 0;
  for (Triangulation* d : {&plain, &trimmed}) {
    d->insert_many(all.first(100), nullptr);
    if (d == &trimmed) {
      EXPECT_LT(of_trimmed.blocks_ever - reserved, calls_of_plain);
      d->trim();
    } else {
      calls_of_plain = of_plain.blocks_ever;
    }
    for (const Vec2 point : all.subspan(100, 50)) {
      d->insert(point);
    }
    d->remove(3);
    if (d == &trimmed) {
      const std::size_t before = of_trimmed.bytes;
      d->trim();
      EXPECT_LT(of_trimmed.bytes, before);
      EXPECT_TRUE(d->changed().empty());
    }
    d->insert_many(all.subspan(150), nullptr);
    ASSERT_NO_THROW(d->validate());
  }
  EXPECT_EQ(canonical_triangles(trimmed), canonical_triangles(plain));
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

// On a circle of integers (all tied), on a rounded one, and on a star; with a constraint around it and without.
TEST(removal, of_a_hub_with_any_number_of_spokes) {
  const std::vector<Vec2> exact_circle = [] {
    std::vector<Vec2> points;
    for (int x = -1105; x <= 1105; ++x) {
      const int square = 1105 * 1105 - x * x;
      const int y = static_cast<int>(std::lround(std::sqrt(square)));
      if (y * y == square) {
        points.emplace_back(x, y);
        points.emplace_back(x, -y);
      }
    }
    std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return std::atan2(a.y, a.x) < std::atan2(b.y, b.x); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }();
  ASSERT_GT(exact_circle.size(), 40u);
  for (std::size_t count = 3; count <= 40; ++count) {
    for (const char* shape : {"tied", "rounded", "star"}) {
      for (const bool constrained : {false, true}) {
        std::vector<Vec2> points;
        for (std::size_t i = 0; i < count; ++i) {
          const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
          const double radius = *shape == 's' && i % 2 ? 1104 : 1105;
          points.push_back(*shape == 't' ? exact_circle[i * exact_circle.size() / count]
                                         : radius * Vec2(std::cos(angle), std::sin(angle)));
        }
        Triangulation without(std::pmr::new_delete_resource()), with(std::pmr::new_delete_resource());
        without.insert_many(points, nullptr);
        with.insert_many(points, nullptr);
        if (constrained) {
          for (Triangulation* d : {&without, &with}) {
            d->constrain(0, 1, 1);
            d->constrain(1, 2, 2);
          }
        }
        const VertexId hub = with.insert({0.125, 0.25});
        ASSERT_NE(with.find_edge(hub, 0), k_none);
        with.remove(hub);
        ASSERT_NO_THROW(with.validate());
        EXPECT_EQ(testing::canonical_triangles(with), testing::canonical_triangles(without)) << shape << count;
        EXPECT_EQ(with.constraint_count(), without.constraint_count());
      }
    }
  }
}

}  // namespace
}  // namespace radvor::delaunay
