// Loops over cores: every task once, errors of the lowest index, and silence on the host's console.
#include "base/jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "base/error.h"
#include "support/test_host.h"

namespace radvor {
namespace {

TEST(Jobs, RunEveryTaskOnce) {
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    const test::TestHost host(threads);
    for (const std::uint32_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<std::atomic<int>> runs(count);
      host.jobs.for_each(count, [&](std::uint32_t index) { ++runs[index]; });
      for (const auto& times : runs) {
        EXPECT_EQ(times, 1);
      }
    }
  }
}

TEST(Jobs, RangesTogetherAreEverythingOnce) {
  const test::TestHost host(2);
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 1000u}) {
    std::vector<std::atomic<int>> visits(count);
    host.jobs.for_ranges(count, 8, [&](std::size_t begin, std::size_t end) {
      EXPECT_LT(begin, end);
      EXPECT_LE(end - begin, 8u);
      for (std::size_t k = begin; k < end; ++k) {
        ++visits[k];
      }
    });
    for (const auto& times : visits) {
      EXPECT_EQ(times, 1);
    }
  }
}

TEST(Jobs, InPartsTooEveryTaskRunsOnce) {
  if (test::plain_threads_wanted()) {
    GTEST_SKIP() << "TBB is left out under this sanitizer";
  }
  HostMemory memory(nullptr, nullptr, nullptr);
  for (const std::uint32_t threads : {1u, 2u, 3u, 64u, 200u}) {
    const Jobs jobs(threads, nullptr, nullptr, &memory);
    for (const std::uint32_t count : {0u, 1u, 2u, 65u, 100000u}) {
      std::vector<std::atomic<int>> runs(count);
      jobs.for_each_in_parts(count, [&](std::uint32_t index) { ++runs[index]; });
      for (const auto& times : runs) {
        ASSERT_EQ(times, 1) << threads << " threads, " << count << " tasks";
      }
    }
  }
}

// The first task ends when all others have, its own part's too: some thread that is done with its part does those.
TEST(Jobs, ThreadsThatAreDoneHelpInOtherParts) {
  if (test::plain_threads_wanted() || std::thread::hardware_concurrency() < 2) {
    GTEST_SKIP() << "TBB is left out under this sanitizer, or there is one core";
  }
  using Clock = std::chrono::steady_clock;
  constexpr std::uint32_t k_count = 100;
  HostMemory memory(nullptr, nullptr, nullptr);
  const Jobs jobs(2, nullptr, nullptr, &memory);
  std::atomic<std::uint32_t> done{0};
  bool all = false;
  jobs.for_each_in_parts(k_count, [&](std::uint32_t index) {
    const Clock::time_point latest = Clock::now() + std::chrono::seconds(20);
    while (index == 0 && done < k_count - 1 && Clock::now() < latest) {
      std::this_thread::yield();
    }
    if (index == 0) {
      all = done == k_count - 1;
    }
    ++done;
  });
  EXPECT_TRUE(all);
}

// Of two threads one begins in the middle: the first two tasks that are begun are at the parts' beginnings.
TEST(Jobs, EveryThreadBeginsWithAPartOfItsOwn) {
  if (test::plain_threads_wanted() || std::thread::hardware_concurrency() < 2) {
    GTEST_SKIP() << "TBB is left out under this sanitizer, or there is one core";
  }
  using Clock = std::chrono::steady_clock;
  HostMemory memory(nullptr, nullptr, nullptr);
  const Jobs jobs(2, nullptr, nullptr, &memory);
  std::atomic<std::uint32_t> begun{0}, sum{0};
  jobs.for_each_in_parts(100, [&](std::uint32_t index) {
    if (begun++ < 2) {
      sum += index;
    }
    const Clock::time_point latest = Clock::now() + std::chrono::seconds(20);
    while (begun < 2 && Clock::now() < latest) {  // until both threads are there
      std::this_thread::yield();
    }
  });
  EXPECT_EQ(sum, 50u);
}

TEST(Jobs, ThrowWhatTheLowestIndexThrew) {
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    const test::TestHost host(threads);
    const auto task = [](std::uint32_t index) {
      if (index >= 7) {
        throw Error(ErrorCode::limit, "task %u", index);
      }
    };
    for (const bool in_parts : {false, true}) {
      try {
        in_parts ? host.jobs.for_each_in_parts(100, task) : host.jobs.for_each(100, task);
        FAIL() << "nothing was thrown";
      } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "task 7");
      }
    }
  }
}

TEST(Jobs, MoreThreadsThanCoresAreNoReasonToPrint) {
  if (test::plain_threads_wanted()) {
    GTEST_SKIP() << "TBB is left out under this sanitizer";
  }
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  {
    HostMemory memory(nullptr, nullptr, nullptr);
    const Jobs jobs(64, nullptr, nullptr, &memory);
    std::atomic<std::uint32_t> sum{0};
    jobs.for_each(1000, [&](std::uint32_t index) { sum += index; });
    jobs.in_arena([&] { ++sum; });
    EXPECT_EQ(sum, 999u * 1000u / 2 + 1);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace radvor
