// What rays take is told from some calls, whatever the tasks that they are in.
#include "radiosity/tracer.h"

#include <gtest/gtest.h>

#include <memory_resource>

#include "visibility/brute_force_visibility.h"

namespace radvor {
namespace {

TEST(Tracer, EveryCallCountsAlikeInTasksOfAnySize) {
  const BruteForceVisibility nothing({}, std::pmr::get_default_resource());
  for (const std::uint64_t calls : {1u, 8u, 64u, 65u, 1000u}) {
    TransportCounters all;
    for (int task = 0; task < 10; ++task) {
      Tracer tracer(nothing);
      for (std::uint64_t call = 0; call < calls; ++call) {
        tracer.first_hit(Vec3(0.0), Vec3(1.0));
      }
      all += tracer.counters;
    }
    EXPECT_EQ(all.rays, 10 * calls);
    EXPECT_EQ(all.calls, 10 * calls);
    EXPECT_EQ(all.timed_calls, 10 * ((calls + 63) / 64));
    EXPECT_GT(all.timed_seconds, 0);
    EXPECT_DOUBLE_EQ(all.ray_seconds(),
                     all.timed_seconds * static_cast<double>(calls) / static_cast<double>((calls + 63) / 64));
  }
  EXPECT_EQ(TransportCounters{}.ray_seconds(), 0);
}

}  // namespace
}  // namespace radvor
