// The net over a hemisphere: one point in each box, and an order in which neighbours lie close together.
#include "radiosity/hemisphere.h"

#include <gtest/gtest.h>

#include <algorithm>
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
