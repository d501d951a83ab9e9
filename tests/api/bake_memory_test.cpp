// Memory refused at one block after another while baking and reading: an error each time, nothing lost, nothing
// changed.
#include <gtest/gtest.h>
#include <radvor.h>

#include <functional>
#include <vector>

#include "api/engine.h"
#include "api/light_of.h"
#include "api/room.h"

namespace radvor::test {
namespace {

// The first blocks one by one, then at growing distances: a bake asks for thousands.
std::uint64_t after(std::uint64_t n) {
  return n < 64 ? n + 1 : n + n / 12;
}

class BakeMemory : public testing::Test {
 protected:
  BakeMemory() { scene_.add(room_.desc()); }

  /// Calls until it works, with memory refused from a later block each time.
  void retry(const char* what, int at_least, const std::function<radvor_result()>& call) {
    int refusals = 0;
    for (std::uint64_t n = 1;; n = after(n)) {
      const std::size_t blocks = engine_.live_blocks();
      engine_.refuse_from(n);
      const radvor_result result = call();
      engine_.refuse_from(0);
      if (result == RADVOR_OK) {
        break;
      }
      ++refusals;
      ASSERT_EQ(result, RADVOR_ERROR_OUT_OF_MEMORY) << what << " at block " << n << ": " << engine_.error();
      ASSERT_EQ(engine_.live_blocks(), blocks) << what << " at block " << n;
    }
    EXPECT_GE(refusals, at_least) << what;
  }

  Engine engine_;
  SceneOf scene_{engine_};
  FloorAndLamp room_;
};

TEST_F(BakeMemory, RefusedAtAnyBlockOfABake) {
  const radvor_bake_options options = coarse();
  radvor_solution* solution = nullptr;
  retry("radvor_bake", 20, [&] {
    const radvor_result result = radvor_bake(scene_, &options, &solution);
    EXPECT_EQ(solution == nullptr, result != RADVOR_OK);
    return result;
  });
  const LightOf light = read_light(solution, 8);
  radvor_solution_destroy(solution);
  ASSERT_EQ(radvor_bake(scene_, &options, &solution), RADVOR_OK);
  EXPECT_TRUE(read_light(solution, 8) == light);
  radvor_solution_destroy(solution);
}

TEST_F(BakeMemory, RefusedWhileAdvancingLeavesWhatCanOnlyBeDestroyed) {
  const radvor_bake_options options = coarse();
  std::vector<float> rgb(24);
  int refusals = 0;
  for (std::uint64_t n = 1;; n = after(n)) {
    const std::size_t blocks = engine_.live_blocks();
    radvor_solution* solution = nullptr;
    ASSERT_EQ(radvor_solution_create(scene_, &options, &solution), RADVOR_OK) << engine_.error();
    engine_.refuse_from(n);
    const radvor_result result = radvor_solution_advance(solution, 0, nullptr);
    engine_.refuse_from(0);
    if (result != RADVOR_OK) {
      ++refusals;
      ASSERT_EQ(result, RADVOR_ERROR_OUT_OF_MEMORY) << n << ": " << engine_.error();
      EXPECT_EQ(radvor_solution_advance(solution, 0, nullptr), RADVOR_ERROR_OUT_OF_MEMORY);
      EXPECT_EQ(radvor_solution_vertices(solution, 0, RADVOR_IRRADIANCE, RADVOR_VERTEX_SAMPLE, rgb.data(), 0, 8),
                RADVOR_ERROR_OUT_OF_MEMORY);
      radvor_stats stats{};
      stats.struct_size = sizeof stats;
      EXPECT_EQ(radvor_solution_stats(solution, &stats), RADVOR_ERROR_OUT_OF_MEMORY);
    }
    radvor_solution_destroy(solution);
    ASSERT_EQ(engine_.live_blocks(), blocks) << n;
    if (result == RADVOR_OK) {
      break;
    }
  }
  EXPECT_GT(refusals, 20);
}

// What is shown between slices is not worth a bake: without memory for it, the light that is certain is shown.
TEST_F(BakeMemory, RefusedInASliceBreaksTheSolutionOrNothing) {
  const radvor_bake_options options = refined();
  int broken = 0, whole = 0;
  const auto refuse = [&](int before, std::uint64_t n) {
    const std::size_t blocks = engine_.live_blocks();
    radvor_solution* solution = nullptr;
    EXPECT_EQ(radvor_solution_create(scene_, &options, &solution), RADVOR_OK) << engine_.error();
    radvor_result result = RADVOR_TIME_SPENT;
    for (int slice = 0; slice < before && result == RADVOR_TIME_SPENT; ++slice) {
      result = radvor_solution_advance(solution, 1e-9, nullptr);
    }
    const bool there = result == RADVOR_TIME_SPENT;
    if (there) {
      engine_.refuse_from(n);
      result = radvor_solution_advance(solution, 1e-9, nullptr);
      engine_.refuse_from(0);
      const bool breaks = result == RADVOR_ERROR_OUT_OF_MEMORY;
      EXPECT_TRUE(breaks || result == RADVOR_TIME_SPENT || result == RADVOR_OK);
      EXPECT_EQ(radvor_solution_advance(solution, 0, nullptr), breaks ? RADVOR_ERROR_OUT_OF_MEMORY : RADVOR_OK);
      broken += breaks ? 1 : 0;
      whole += breaks ? 0 : 1;
    }
    radvor_solution_destroy(solution);
    EXPECT_EQ(engine_.live_blocks(), blocks) << n << " after " << before << " slices";
    return there;
  };
  for (std::uint64_t n = 1; n <= 20; ++n) {
    for (int before = 0; before < 8; ++before) {
      refuse(before, n);
    }
  }
  for (const std::uint64_t n : {1u, 2u, 5u, 10u}) {
    int before = 8;
    for (; refuse(before, n); ++before) {
    }
    EXPECT_GT(before, 60);
  }
  EXPECT_GT(broken, 50);
  EXPECT_GT(whole, 50);
}

TEST_F(BakeMemory, RefusedAtAnyBlockOfReading) {
  const radvor_bake_options options = coarse();
  radvor_solution *solution = nullptr, *untroubled = nullptr;
  ASSERT_EQ(radvor_bake(scene_, &options, &solution), RADVOR_OK) << engine_.error();
  ASSERT_EQ(radvor_bake(scene_, &options, &untroubled), RADVOR_OK) << engine_.error();
  std::vector<float> rgb(24);
  const double position[] = {0.5, 0, 0.5};
  const float normal[] = {0, 1, 0};
  radvor_output_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  retry("radvor_solution_vertices", 0, [&] {
    return radvor_solution_vertices(solution, 0, RADVOR_IRRADIANCE, RADVOR_VERTEX_SAMPLE, rgb.data(), 0, 8);
  });
  // What is kept in the solution for the next call counts as live: measured by a second call.
  const auto retry_kept = [&](const char* what, const std::function<radvor_result()>& call) {
    int refusals = 0;
    radvor_result result = RADVOR_ERROR_OUT_OF_MEMORY;
    for (std::uint64_t n = 1; result != RADVOR_OK; n = after(n)) {
      engine_.refuse_from(n);
      result = call();
      engine_.refuse_from(0);
      refusals += result != RADVOR_OK;
      ASSERT_TRUE(result == RADVOR_OK || result == RADVOR_ERROR_OUT_OF_MEMORY) << what << ": " << engine_.error();
    }
    EXPECT_GT(refusals, 0) << what;
  };
  retry_kept("radvor_solution_points", [&] {
    return radvor_solution_points(solution, RADVOR_IRRADIANCE, 1, position, normal, 0.1, rgb.data(), nullptr);
  });
  retry_kept("radvor_solution_mesh", [&] { return radvor_solution_mesh(solution, 0, &mesh); });
  EXPECT_TRUE(read_light(solution, 8) == read_light(untroubled, 8));
  radvor_solution_destroy(solution);
  radvor_solution_destroy(untroubled);
}

}  // namespace
}  // namespace radvor::test
