// Sums are of everything once, and round the same for any number of threads.
#include "base/sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <random>
#include <vector>

#include "support/test_host.h"

namespace radvor {
namespace {

TEST(SumSideBySide, IsOfEveryIndexOnce) {
  const test::TestHost host(2);
  for (const std::uint64_t count : {0u, 1u, 16384u, 16385u, 100000u}) {
    const auto sum = sum_side_by_side<std::uint64_t>(count, host.jobs, std::pmr::get_default_resource(),
                                                     [](std::uint64_t& part, std::size_t index) { part += index + 1; });
    EXPECT_EQ(sum, count * (count + 1) / 2);
  }
}

TEST(SumSideBySide, RoundsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(1);
  std::vector<double> values(200000);
  for (double& value : values) {
    value = std::exp(std::uniform_real_distribution<double>(-30, 30)(random));
  }
  const auto sum_on = [&](std::uint32_t threads) {
    const test::TestHost host(threads);
    return sum_side_by_side<double>(values.size(), host.jobs, std::pmr::get_default_resource(),
                                    [&](double& part, std::size_t index) { part += values[index]; });
  };
  EXPECT_EQ(sum_on(1), sum_on(2));
  EXPECT_EQ(sum_on(1), sum_on(3));
}

}  // namespace
}  // namespace radvor
