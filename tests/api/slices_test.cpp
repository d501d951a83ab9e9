// A bake in one go, in slices, cancelled and gone on with, on any number of threads: the same bytes, readable
// throughout.
#include <gtest/gtest.h>
#include <radvor.h>

#include <array>
#include <string>

#include "api/engine.h"
#include "api/light_of.h"
#include "api/room.h"

namespace radvor::test {
namespace {

struct Baked {
  explicit Baked(const Lends& lends = {}) : engine(lends), scene(engine) { scene.add(room.desc()); }
  ~Baked() { radvor_solution_destroy(solution); }

  LightOf light() const { return read_light(solution, 8); }

  Engine engine;
  SceneOf scene;
  FloorAndLamp room;
  radvor_solution* solution = nullptr;
};

LightOf light_of_one_bake(const radvor_bake_options& options = coarse()) {
  Baked baked;
  EXPECT_EQ(radvor_bake(baked.scene, &options, &baked.solution), RADVOR_OK) << baked.engine.error();
  return baked.light();
}

TEST(Slices, OneBakeIsLit) {
  const LightOf light = light_of_one_bake();
  EXPECT_GT(light.points[0], 0.1f) << "under the lamp";
  EXPECT_GT(light.mesh_triangles, 4u);
}

TEST(Slices, AnySequenceGivesTheSameBytes) {
  const LightOf expected = light_of_one_bake();
  for (const double seconds : {1e-9, 1e-3, 1e30}) {
    Baked baked;
    const radvor_bake_options options = coarse();
    ASSERT_EQ(radvor_solution_create(baked.scene, &options, &baked.solution), RADVOR_OK) << baked.engine.error();
    baked.light();  // dark, but readable
    radvor_progress progress{};
    progress.struct_size = sizeof progress;
    double converged = 0;
    radvor_result result = RADVOR_TIME_SPENT;
    for (int slices = 0; result == RADVOR_TIME_SPENT; ++slices) {
      result = radvor_solution_advance(baked.solution, seconds, &progress);
      ASSERT_TRUE(result == RADVOR_OK || result == RADVOR_TIME_SPENT) << baked.engine.error();
      EXPECT_GE(progress.converged, converged) << "it never falls";
      EXPECT_LE(progress.converged, 1);
      converged = progress.converged;
      if (slices % 5 == 0) {
        baked.light();
      }
      ASSERT_LT(slices, 1000000);
    }
    EXPECT_EQ(converged, 1);
    EXPECT_GT(progress.sites, 0u);
    EXPECT_TRUE(baked.light() == expected) << seconds << " seconds a slice";
  }
}

// Cancels once the bake has come that far.
struct Canceller {
  double share;
  bool asked = false;
  bool in_time = false;  ///< asked while there was something left to do
  int calls = 0;

  static std::int32_t call(void* user, const radvor_progress* progress) {
    auto& self = *static_cast<Canceller*>(user);
    EXPECT_EQ(progress->struct_size, sizeof *progress);
    ++self.calls;
    self.asked = progress->converged >= self.share;
    self.in_time = self.in_time || (self.asked && progress->converged < 1);
    return self.asked ? 1 : 0;
  }
};

// Left off after so many of the shortest slices, and cancelled at once, it goes on as if nothing had been.
TEST(Slices, GoesOnFromTheMiddleOfAnything) {
  const LightOf expected = light_of_one_bake(refined());
  radvor_result result = RADVOR_TIME_SPENT;
  int slices = 0;
  for (; result == RADVOR_TIME_SPENT; ++slices) {
    Canceller canceller{2};
    Baked baked;
    radvor_bake_options options = refined();
    options.progress = Canceller::call;
    options.progress_user = &canceller;
    ASSERT_EQ(radvor_solution_create(baked.scene, &options, &baked.solution), RADVOR_OK) << baked.engine.error();
    result = RADVOR_TIME_SPENT;
    for (int slice = 0; slice < slices && result == RADVOR_TIME_SPENT; ++slice) {
      result = radvor_solution_advance(baked.solution, 1e-9, nullptr);
    }
    if (result == RADVOR_TIME_SPENT) {
      canceller.share = 0;
      EXPECT_EQ(radvor_solution_advance(baked.solution, 0, nullptr), RADVOR_CANCELLED);
      baked.light();
      canceller.share = 2;
      EXPECT_EQ(radvor_solution_advance(baked.solution, slices % 2 == 0 ? 0 : 1e30, nullptr), RADVOR_OK);
    }
    ASSERT_TRUE(baked.light() == expected) << slices;
  }
  EXPECT_EQ(result, RADVOR_OK);
  EXPECT_GT(slices, 60);
}

TEST(Slices, ASolutionMayGoInTheMiddleOfAnything) {
  const radvor_bake_options options = refined();
  radvor_result result = RADVOR_TIME_SPENT;
  for (int slices = 0; result == RADVOR_TIME_SPENT; ++slices) {
    Baked baked;
    ASSERT_EQ(radvor_solution_create(baked.scene, &options, &baked.solution), RADVOR_OK) << baked.engine.error();
    result = RADVOR_TIME_SPENT;
    for (int slice = 0; slice < slices && result == RADVOR_TIME_SPENT; ++slice) {
      result = radvor_solution_advance(baked.solution, 1e-9, nullptr);
    }
  }
  EXPECT_EQ(result, RADVOR_OK);
}

TEST(Slices, AnyNumberOfThreadsGivesTheSameBytes) {
  const LightOf expected = light_of_one_bake();
  for (const std::uint32_t threads : {1u, 2u, 3u}) {
    for (const bool lent : {false, true}) {
      if (!lent && plain_threads_wanted()) {
        continue;
      }
      Baked baked({.memory = true, .threads = lent, .thread_count = threads});
      const radvor_bake_options options = coarse();
      ASSERT_EQ(radvor_bake(baked.scene, &options, &baked.solution), RADVOR_OK) << baked.engine.error();
      EXPECT_TRUE(baked.light() == expected) << threads << " threads, lent: " << lent;
      radvor_solution_destroy(baked.solution);
      ASSERT_EQ(radvor_solution_create(baked.scene, &options, &baked.solution), RADVOR_OK) << baked.engine.error();
      radvor_result result = RADVOR_TIME_SPENT;
      while (result == RADVOR_TIME_SPENT) {
        result = radvor_solution_advance(baked.solution, 1e-9, nullptr);
      }
      EXPECT_TRUE(baked.light() == expected) << threads << " threads, in slices, lent: " << lent;
    }
  }
}

class Cancelling : public testing::TestWithParam<double> {};

TEST_P(Cancelling, LeavesAReadableSolutionThatCanGoOn) {
  const LightOf expected = light_of_one_bake();
  Canceller canceller{GetParam()};
  Baked baked;
  radvor_bake_options options = coarse();
  options.progress = Canceller::call;
  options.progress_user = &canceller;
  const radvor_result result = radvor_bake(baked.scene, &options, &baked.solution);
  EXPECT_EQ(result, canceller.in_time ? RADVOR_CANCELLED : RADVOR_OK) << baked.engine.error();
  EXPECT_GT(canceller.calls, 0);
  ASSERT_NE(baked.solution, nullptr);
  baked.light();
  radvor_stats stats{};
  stats.struct_size = sizeof stats;
  EXPECT_EQ(radvor_solution_stats(baked.solution, &stats), RADVOR_OK);
  EXPECT_GT(stats.sites, 0u);

  if (GetParam() <= 0.1) {
    EXPECT_TRUE(canceller.in_time);
  }
  canceller.share = 2;
  EXPECT_EQ(radvor_solution_advance(baked.solution, 0, nullptr), RADVOR_OK) << baked.engine.error();
  EXPECT_TRUE(baked.light() == expected);
}

INSTANTIATE_TEST_SUITE_P(AtShares, Cancelling, testing::Values(0.0, 0.1, 0.5, 1.0), [](const auto& tested) {
  return std::to_string(static_cast<int>(100 * tested.param)) + "percent";
});

TEST(Slices, TimeIsKept) {
  Baked baked;
  radvor_bake_options options = coarse();
  options.max_seconds = 1e-9;
  EXPECT_EQ(radvor_bake(baked.scene, &options, &baked.solution), RADVOR_TIME_SPENT) << baked.engine.error();
  baked.light();
}

// Else it could not end when the time is spent.
TEST(Slices, ABakeWhoseTimeIsLimitedIsDoneInSmallPiecesAndEndsTheSame) {
  std::array<int, 2> pieces{};
  std::array<LightOf, 2> light;
  for (const std::size_t limited : {0u, 1u}) {
    Baked baked;
    radvor_bake_options options = refined();
    options.max_seconds = limited == 0 ? 0 : 1e6;
    options.progress = [](void* count, const radvor_progress*) {
      ++*static_cast<int*>(count);
      return 0;
    };
    options.progress_user = &pieces[limited];
    ASSERT_EQ(radvor_bake(baked.scene, &options, &baked.solution), RADVOR_OK) << baked.engine.error();
    light[limited] = baked.light();
  }
  EXPECT_GT(pieces[1], pieces[0]);
  EXPECT_TRUE(light[0] == light[1]);
}

}  // namespace
}  // namespace radvor::test
