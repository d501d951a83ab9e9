// Every task once, whoever takes it; on plain threads, which the thread sanitizer can watch.
#include "base/task_parts.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

namespace radvor {
namespace {

TEST(TaskParts, OneThreadTakesItsOwnInOrderAndThenTheOthersFromTheEnd) {
  TaskParts parts(10, 2);
  std::vector<std::uint32_t> taken;
  parts.work(1, [&](std::uint32_t index) { taken.push_back(index); });
  EXPECT_EQ(taken, (std::vector<std::uint32_t>{5, 6, 7, 8, 9, 4, 3, 2, 1, 0}));
  parts.work(0, [&](std::uint32_t) { FAIL() << "none is left"; });
}

TEST(TaskParts, FewerTasksThanThreadsAreTakenToo) {
  TaskParts parts(1, 3);
  std::uint32_t runs = 0;
  parts.work(0, [&](std::uint32_t index) { runs += index + 1; });
  EXPECT_EQ(runs, 1u);
}

TEST(TaskParts, ManyThreadsTakeEachOnce) {
  for (const std::uint32_t thread_count : {1u, 2u, 7u, 100u}) {
    for (const std::uint32_t tasks : {1u, 99u, 20000u}) {
      TaskParts parts(tasks, thread_count);
      std::vector<int> runs(tasks, 0);  // not atomic: a task that two take is a race
      std::vector<std::thread> threads;
      for (std::uint32_t thread = 0; thread < thread_count; ++thread) {
        threads.emplace_back([&, thread] { parts.work(thread, [&](std::uint32_t index) { ++runs[index]; }); });
      }
      for (std::thread& thread : threads) {
        thread.join();
      }
      EXPECT_EQ(runs, std::vector<int>(tasks, 1)) << thread_count << " threads";
    }
  }
}

}  // namespace
}  // namespace radvor
