// Work that pauses: where it goes on, what it throws, and that its memory is what was lent.
#include "base/steps.h"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "support/counted_memory.h"

namespace radvor {
namespace {

using std::chrono::hours;

class StepsTest : public testing::Test {
 protected:
  test::CountedMemory memory;
  Pace pace{&memory};
  std::vector<int> done;

  void pause_everywhere() { pace.pause_at(Pace::Clock::now() - hours(2), Pace::Clock::now() - hours(1)); }
  void pause_nowhere() { pace.pause_at(Pace::Clock::now(), Pace::Clock::now() + hours(1)); }

  Steps count(int from, int to, Pace& at) {
    const std::vector<int> local(1000, from);  // to be let go whenever the work ends
    for (int k = from; k < to; ++k) {
      done.push_back(k + local[0] - from);
      co_await at;
    }
  }
  Steps count_twice(Pace& at) {
    co_await count(0, 2, at);
    done.push_back(-1);
    co_await count(10, 12, at);
  }
  Steps fail(int after, Pace& at) {
    co_await count(0, after, at);
    throw std::runtime_error("it is over");
  }
  Steps catch_failure(int after, Pace& at) {
    try {
      co_await fail(after, at);
    } catch (const std::runtime_error&) {
      done.push_back(-2);
    }
    co_await count(10, 12, at);
  }
};

TEST_F(StepsTest, GoesOnWhereItPaused) {
  pause_everywhere();
  Steps steps = count_twice(pace);
  const std::array<std::vector<int>, 5> after{{{0}, {0, 1}, {0, 1, -1, 10}, {0, 1, -1, 10, 11}, {0, 1, -1, 10, 11}}};
  for (std::size_t k = 0; k < after.size(); ++k) {
    EXPECT_FALSE(steps.is_done());
    EXPECT_EQ(steps.go_on(), k + 1 < after.size());
    EXPECT_EQ(done, after[k]);
  }
  EXPECT_TRUE(steps.is_done());
  EXPECT_FALSE(steps.go_on());
  EXPECT_EQ(done, after.back());
}

TEST_F(StepsTest, DoesNotPauseBeforeItsTime) {
  for (const bool limited : {false, true}) {
    if (limited) {
      pause_nowhere();
    }
    done.clear();
    EXPECT_FALSE(count_twice(pace).go_on());
    EXPECT_EQ(done, (std::vector<int>{0, 1, -1, 10, 11}));
  }
  pause_everywhere();
  pace.pause_no_more();
  EXPECT_FALSE(count_twice(pace).go_on());
}

// Where there is less time than that, and some of it is spent, what is next waits for more.
TEST_F(StepsTest, PausesBeforeWhatTakesLonger) {
  const auto takes = [](double seconds, Pace& at) -> Steps { co_await at.time_for(seconds); };
  const auto spent = [&](double seconds, double of) {  // what there is: `of` seconds, some spent
    const auto now = Pace::Clock::now();
    const auto length = [](double s) {
      return std::chrono::duration_cast<Pace::Clock::duration>(std::chrono::duration<double>(s));
    };
    pace.pause_at(now - length(seconds), now + length(of - seconds));
  };
  EXPECT_FALSE(takes(1e9, pace).go_on()) << "nobody waits";
  struct Case {
    double spent, seconds;
    bool pauses;
  };
  for (const Case& c : {Case{0, 5000, false}, Case{50, 5000, false}, Case{200, 900, false}, Case{200, 1200, true},
                        Case{900, 200, false}, Case{900, 400, true}}) {
    spent(c.spent, 1000);
    Steps steps = takes(c.seconds, pace);
    EXPECT_EQ(steps.go_on(), c.pauses) << c.spent << " of 1000, " << c.seconds;
    EXPECT_EQ(pace.is_over(), c.pauses);
    spent(0, 1000);
    EXPECT_FALSE(pace.is_over());
    EXPECT_FALSE(steps.go_on());
  }
}

TEST_F(StepsTest, BeginsWhenItIsTold) {
  {
    const Steps steps = count_twice(pace);
    EXPECT_FALSE(steps.is_done());
  }
  EXPECT_TRUE(done.empty());
  EXPECT_TRUE(Steps().is_done());
  EXPECT_FALSE(Steps().go_on());
}

TEST_F(StepsTest, ThrowsToTheWorkThatWaitsAndOut) {
  for (const bool pausing : {false, true}) {
    for (const int after : {0, 2}) {
      done.clear();
      if (pausing) {
        pause_everywhere();
      }
      EXPECT_THROW(fail(after, pace).finish(), std::runtime_error);
      Steps failing = fail(after, pace);
      EXPECT_THROW(failing.finish(), std::runtime_error);
      EXPECT_TRUE(failing.is_done());
      EXPECT_FALSE(failing.go_on());
      done.clear();
      catch_failure(after, pace).finish();
      EXPECT_EQ(done.size(), static_cast<std::size_t>(after) + 3);
      EXPECT_EQ(done[static_cast<std::size_t>(after)], -2);
    }
  }
}

TEST_F(StepsTest, GoesThroughAllInPortionsOrAtOnce) {
  const auto add = [&](std::size_t begin, std::size_t end) {
    done.push_back(static_cast<int>(begin));
    done.push_back(static_cast<int>(end));
  };
  in_portions(0, 3, add, pace).finish();
  EXPECT_TRUE(done.empty());
  in_portions(7, 3, add, pace).finish();
  EXPECT_EQ(done, (std::vector{0, 7}));
  done.clear();
  pause_everywhere();
  Steps steps = in_portions(7, 3, add, pace);
  EXPECT_TRUE(steps.go_on());
  EXPECT_EQ(done, (std::vector{0, 3}));
  EXPECT_TRUE(steps.go_on());
  EXPECT_EQ(done, (std::vector{0, 3, 3, 6}));
  pace.pause_no_more();
  EXPECT_FALSE(steps.go_on());
  EXPECT_EQ(done, (std::vector{0, 3, 3, 6, 6, 7}));
}

TEST_F(StepsTest, LetsMemoryGoWhereverItEnds) {
  pause_everywhere();
  for (int pauses = 0; pauses < 6; ++pauses) {
    Steps steps = catch_failure(2, pace);
    for (int k = 0; k < pauses; ++k) {
      steps.go_on();
    }
    EXPECT_GT(memory.bytes, 0u);
    steps = Steps();
  }
  EXPECT_EQ(memory.bytes, 0u);
}

TEST_F(StepsTest, RunsOutOfMemoryInOrder) {
  pause_everywhere();
  for (int most = 0; most < 3; ++most) {
    memory.left = most;
    EXPECT_THROW(count_twice(pace).finish(), std::bad_alloc);
    EXPECT_EQ(memory.bytes, 0u);
  }
}

}  // namespace
}  // namespace radvor
