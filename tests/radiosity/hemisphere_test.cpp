// The net over a hemisphere: one point in each box, and an order in which neighbours lie close together.
#include "radiosity/hemisphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace radvor {
namespace {

TEST(Net, HasOnePointInEachBoxUnderEveryScramble) {
  for (const std::uint64_t seed : {0u, 1u, 77u}) {
    const Net net(seed);
    for (std::uint32_t bits = 0; bits <= 10; ++bits) {
      for (std::uint32_t across = 0; across <= bits; ++across) {  // boxes of every shape
        std::vector<int> met(std::size_t{1} << bits, 0);
        for (std::uint32_t index = 0; index < (1u << bits); ++index) {
          const Vec2 point = net.point(index);
          const auto x = static_cast<std::size_t>(std::ldexp(point.x, static_cast<int>(across)));
          const auto y = static_cast<std::size_t>(std::ldexp(point.y, static_cast<int>(bits - across)));
          ++met[(x << (bits - across)) + y];
        }
        EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; }));
      }
    }
  }
}

// Past the table of the first ones, too.
TEST(Net, GoesOnBeyondItsTable) {
  const Net net(3);
  constexpr std::uint32_t k_count = 1u << 13;
  std::vector<int> columns(k_count, 0), rows(k_count, 0), squares(k_count, 0);
  for (std::uint32_t index = 0; index < k_count; ++index) {
    const Vec2 point = net.point(index);
    ++columns[static_cast<std::size_t>(point.x * k_count)];
    ++rows[static_cast<std::size_t>(point.y * k_count)];
    ++squares[static_cast<std::size_t>(point.x * 64) * 128 + static_cast<std::size_t>(point.y * 128)];
  }
  for (const auto& boxes : {columns, rows, squares}) {
    EXPECT_TRUE(std::all_of(boxes.begin(), boxes.end(), [](int times) { return times == 1; }));
  }
}

TEST(SineCosine, AreThoseOfTheLibrary) {
  for (int step = -1000; step <= 1000; ++step) {
    const double angle = step * 0.78539816339744831e-3;
    const SineCosine turn(angle);
    EXPECT_NEAR(turn.sine, std::sin(angle), 1e-11);
    EXPECT_NEAR(turn.cosine, std::cos(angle), 1e-11);
  }
}

// Equal areas of the square are equal areas of the disk; rims meet rims.
TEST(SquareToDisk, KeepsFractionsOfAreaAndSides) {
  constexpr int k_side = 1000;
  std::array<int, 16> sectors{};  // four rings of equal area, four quadrants
  for (int i = 0; i < k_side; ++i) {
    for (int j = 0; j < k_side; ++j) {
      const Vec2 p = square_to_disk((2 * i + 1.0) / k_side - 1, (2 * j + 1.0) / k_side - 1);
      const auto ring = static_cast<std::size_t>(std::min(3.0, 4 * glm::dot(p, p)));
      ++sectors[4 * ring + (p.x > 0 ? 1u : 0u) + (p.y > 0 ? 2u : 0u)];
    }
  }
  for (const int count : sectors) {
    EXPECT_NEAR(count, k_side * k_side / 16, k_side);
  }
  for (const double t : {-1.0, -0.3, 0.0, 0.8}) {
    for (const Vec2& p : {square_to_disk(1, t), square_to_disk(-1, t), square_to_disk(t, 1), square_to_disk(t, -1)}) {
      EXPECT_NEAR(glm::length(p), 1, 1e-11);
    }
  }
  EXPECT_EQ(square_to_disk(0, 0), Vec2(0.0));
}

TEST(NetOrder, TakesEachPointOnceAndNeighboursTogether) {
  const NetOrder order;
  const Net net(5);
  for (const std::uint32_t count : {16u, 32u, 64u, 256u, 1024u, 8192u}) {
    std::vector<int> met(count, 0);
    for (std::uint32_t step = 0; step < count; ++step) {
      ++met[order.index(count, step)];
    }
    EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; })) << count;
    // Four that follow one another share a box of their number's size.
    const std::uint32_t part = std::min(count, 1024u);
    for (std::uint32_t first = 0; first < count; first += 4) {
      Vec2 low(1.0), high(0.0);
      for (std::uint32_t step = first; step < first + 4; ++step) {
        const Vec2 point = net.point(order.index(count, step));
        low = glm::min(low, point);
        high = glm::max(high, point);
      }
      EXPECT_LE((high.x - low.x) * (high.y - low.y), 4.0 / part);
      EXPECT_LE(std::max(high.x - low.x, high.y - low.y), std::sqrt(2 * 4.0 / part));
    }
  }
}

}  // namespace
}  // namespace radvor
