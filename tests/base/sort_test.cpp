// Sorted is sorted, by any number of threads.
#include "base/sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <random>
#include <vector>

#include "base/memory.h"
#include "support/plain_threads.h"

namespace radvor {
namespace {

TEST(SortSideBySide, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(1);
  HostMemory memory(nullptr, nullptr, nullptr);
  for (const std::uint32_t threads : {1u, 2u, 3u, 8u}) {
    const Jobs jobs(threads, test::plain_threads_wanted() ? test::plain_parallel_for<3> : nullptr, nullptr, &memory);
    for (const std::size_t count : {0u, 1u, 8191u, 8192u, 12288u, 50001u}) {
      for (const std::uint32_t range : {3u, 0xffffffffu}) {  // many equal ones, and hardly any
        std::pmr::vector<std::uint32_t> values(count);
        std::generate(values.begin(), values.end(), [&] { return static_cast<std::uint32_t>(random()) % range; });
        std::pmr::vector<std::uint32_t> expected(values);
        std::sort(expected.begin(), expected.end(), std::greater<>());
        sort_side_by_side(values, jobs, std::greater<>());
        EXPECT_EQ(values, expected) << threads << " threads, " << count << " values";
      }
    }
  }
}

}  // namespace
}  // namespace radvor
