// Loops over cores: every task once, errors of the lowest index, and silence on the host's console.
#include "base/jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
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

TEST(Jobs, ThrowWhatTheLowestIndexThrew) {
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    const test::TestHost host(threads);
    try {
      host.jobs.for_each(100, [](std::uint32_t index) {
        if (index >= 7) {
          throw Error(ErrorCode::limit, "task %u", index);
        }
      });
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), "task 7");
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
