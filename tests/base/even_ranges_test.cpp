// Ranges of even weight: everything once, none lighter than asked but the last, the heaviest first.
#include "base/even_ranges.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "support/test_host.h"

namespace radvor {
namespace {

TEST(EvenRanges, AreEverythingOnceAndHeavyEnough) {
  std::mt19937 random(1);
  for (const std::size_t count : {0u, 1u, 5u, 1000u}) {
    std::vector<double> weights(count);
    for (double& weight : weights) {
      weight = random() % 10 == 0 ? 100 : static_cast<double>(random() % 5);
    }
    const test::TestHost host(2);
    const EvenRanges ranges(
        count, 50, [&](std::uint32_t k) { return weights[k]; }, std::pmr::get_default_resource());
    std::vector<std::atomic<int>> visits(count), told(ranges.size());
    ranges.for_each(host.jobs, [&](std::uint32_t range, std::uint32_t begin, std::uint32_t end) {
      ++told[range];
      EXPECT_LT(begin, end);
      double sum = 0;
      for (std::uint32_t k = begin; k < end; ++k) {
        EXPECT_LT(sum, 50);  // else the range should have ended
        sum += weights[k];
        ++visits[k];
      }
      EXPECT_TRUE(sum >= 50 || end == count);
    });
    for (const auto& times : visits) {
      EXPECT_EQ(times, 1);
    }
    for (const auto& times : told) {
      EXPECT_EQ(times, 1);
    }
  }
}

TEST(EvenRanges, TheHeaviestRunFirstAndKeepTheirNumbers) {
  const test::TestHost host(1);
  const std::vector<double> weights = {3, 9, 1, 2, 9, 30};
  const EvenRanges ranges(
      6, 3, [&](std::uint32_t k) { return weights[k]; }, std::pmr::get_default_resource());
  std::vector<std::uint32_t> begins, numbers;
  ranges.for_each(host.jobs, [&](std::uint32_t range, std::uint32_t begin, std::uint32_t) {
    begins.push_back(begin);
    numbers.push_back(range);
  });
  EXPECT_EQ(begins, (std::vector<std::uint32_t>{5, 1, 4, 0, 2}));
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{4, 1, 3, 0, 2}));
}

TEST(EvenRanges, InStepsThereArePausesBetweenSome) {
  const test::TestHost host(2);
  const EvenRanges ranges(
      100, 1, [](std::uint32_t k) { return 1.0 + k; }, std::pmr::get_default_resource());
  EXPECT_EQ(ranges.heaviest(), 100);
  for (const bool pauses : {false, true}) {
    std::vector<std::atomic<int>> visits(100);
    const auto visit = [&](std::uint32_t range, std::uint32_t begin, std::uint32_t end) {
      EXPECT_EQ(begin, range);
      EXPECT_EQ(end, range + 1);
      ++visits[range];
    };
    Pace pace(std::pmr::get_default_resource());
    if (pauses) {
      pace.pause_at({}, {});  // long ago
    }
    Steps steps = ranges.for_each(host.jobs, visit, pace);
    int before = 0;
    for (bool is_first = true; steps.go_on(); is_first = false) {
      const int now = std::accumulate(visits.begin(), visits.end(), 0);
      EXPECT_TRUE(now > before && now - before <= 8) << now;
      EXPECT_TRUE(!is_first || visits[99] == 1) << "the heaviest are first";
      before = now;
    }
    EXPECT_EQ(before, pauses ? 100 : 0);
    for (const auto& times : visits) {
      EXPECT_EQ(times, 1);
    }
  }
}

}  // namespace
}  // namespace radvor
