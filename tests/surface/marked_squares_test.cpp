// Marked squares against a set of them, square by square.
#include "surface/marked_squares.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace radvor {
namespace {

using Square = MarkedSquares::Square;
using Key = std::tuple<std::uint32_t, std::uint8_t, std::int64_t, std::int64_t>;

class MarkedSquaresTest : public testing::Test {
 protected:
  static Key key(const Square& square) { return {square.facet, square.level, square.x, square.y}; }

  // A box of up to 20 x 20 squares near the origin, whose sides lie anywhere among the blocks.
  std::pair<Square, Square> box() {
    const auto below = [&](std::int64_t end) {
      return std::uniform_int_distribution<std::int64_t>(0, end - 1)(random_);
    };
    const Square first{static_cast<std::uint32_t>(below(2)), static_cast<std::uint8_t>(1 + below(2)), below(60) - 30,
                       below(60) - 30};
    return {first, {first.facet, first.level, first.x + below(20), first.y + below(20)}};
  }

  bool mark_in_set(const Square& first, const Square& last) {
    bool some = false;
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      for (std::int64_t x = first.x; x <= last.x; ++x) {
        some = set_.insert({first.facet, first.level, x, y}).second || some;
      }
    }
    return some;
  }

  void expect_same() const {
    for (std::uint32_t facet = 0; facet < 2; ++facet) {
      for (std::uint8_t level = 1; level <= 2; ++level) {
        for (std::int64_t y = -40; y < 60; ++y) {
          for (std::int64_t x = -40; x < 60; ++x) {
            const Square square{facet, level, x, y};
            ASSERT_EQ(squares_.contains(square), set_.count(key(square)) > 0) << facet << ' ' << x << ' ' << y;
            ASSERT_EQ(squares_.is_centre(square), centres_.count(key(square)) > 0) << facet << ' ' << x << ' ' << y;
          }
        }
      }
    }
  }

  MarkedSquares squares_{std::pmr::get_default_resource()};
  std::set<Key> set_, centres_;
  std::mt19937 random_{1};
};

TEST_F(MarkedSquaresTest, AreThoseOfAllBoxes) {
  EXPECT_TRUE(squares_.empty());
  for (int k = 0; k < 40; ++k) {
    const auto [first, last] = box();
    EXPECT_EQ(squares_.mark(first, last), mark_in_set(first, last));
    EXPECT_FALSE(squares_.mark(first, last));
    squares_.set_centre(last);
    centres_.insert(key(last));
    expect_same();
  }
  EXPECT_FALSE(squares_.empty());
}

TEST_F(MarkedSquaresTest, AStepThatIsUndoneLeavesNothing) {
  for (int k = 0; k < 40; ++k) {
    squares_.begin_step();
    const auto before = set_;
    const auto centres_before = centres_;
    for (int j = 0; j < 3; ++j) {
      const auto [first, last] = box();
      squares_.mark(first, last);
      squares_.set_centre(first);
      mark_in_set(first, last);
      centres_.insert(key(first));
    }
    if (k % 2 == 0) {
      squares_.undo();
      set_ = before;
      centres_ = centres_before;
    }
    expect_same();
  }
}

}  // namespace
}  // namespace radvor
