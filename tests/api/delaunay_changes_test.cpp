// radvor_delaunay_changes against the stars before and after.
#include <map>
#include <utility>

#include "api/triangulation.h"

namespace radvor::test {
namespace {

using Star = std::map<std::uint32_t, std::uint32_t>;  // neighbours and the flags of the edges to them

std::map<std::uint32_t, Star> stars(const Delaunay& d) {
  std::map<std::uint32_t, Star> stars;
  for (std::uint32_t v = 0; v < radvor_delaunay_vertex_bound(d); ++v) {
    double xy[2];
    if (radvor_delaunay_position(d, v, xy) == RADVOR_OK) {
      for (const std::uint32_t n : d.neighbours(v)) {
        EXPECT_EQ(radvor_delaunay_constraint(d, v, n, &stars[v][n]), RADVOR_OK);
      }
      stars[v];
    }
  }
  return stars;
}

TEST(DelaunayApi, ChangesNameEveryVertexWhoseStarChanged) {
  const Engine engine;
  const Delaunay d(engine);
  std::mt19937 random(3);
  auto before = stars(d);
  int tight = 0, edits = 0;
  for (int i = 0; i < 600; ++i) {
    const std::uint32_t bound = radvor_delaunay_vertex_bound(d) + 1;
    const std::uint32_t a = pick(random, bound), b = pick(random, bound);
    radvor_result result = RADVOR_OK;
    const unsigned kind = pick(random, 8);
    switch (kind) {
      default:
        result = radvor_delaunay_insert(d, pick(random, 16), pick(random, 16), nullptr);
        break;
      case 4:
        result = radvor_delaunay_remove(d, a);
        break;
      case 5:
        result = radvor_delaunay_constrain_as(d, a, b, 1u << pick(random, 3), pick(random, 2));
        break;
      case 6:
        result = radvor_delaunay_unconstrain(d, a, b);
        break;
      case 7: {
        const double value = pick(random, 3);
        if (a + 1 < bound) {
          ASSERT_EQ(radvor_delaunay_set_values(d, &value, a, 1), RADVOR_OK);
        }
        result = radvor_delaunay_realign(d);
      }
    }
    const auto after = stars(d);
    if (result != RADVOR_OK) {
      ASSERT_EQ(after, before);
      continue;
    }
    std::set<std::uint32_t> changed;
    for (const auto& [v, star] : after) {
      const auto was = before.find(v);
      if (was == before.end() || was->second != star) {
        changed.insert(v);
      }
    }
    const Ids told = d.changes();
    const std::set<std::uint32_t> reported(told.begin(), told.end());
    ASSERT_EQ(reported.size(), told.size()) << "a vertex is told of twice";
    for (const std::uint32_t v : changed) {
      ASSERT_TRUE(reported.count(v)) << "edit " << kind << ": the star of " << v << " changed";
    }
    for (const std::uint32_t v : reported) {
      ASSERT_TRUE(after.count(v)) << v << " is not there";
    }
    tight += reported.size() <= changed.size() + 4;
    ++edits;
    before = after;
  }
  EXPECT_GT(edits, 300);
  EXPECT_GT(tight, edits * 3 / 4) << "reports are much longer than they need to be";
}

// The report is of the last edit that did something: not of one that failed, nor of one that was given nothing.
TEST(DelaunayApi, CallsThatFailOrAreGivenNothingLeaveTheReport) {
  for (const bool steered : {false, true}) {
    Engine engine;
    const Delaunay d(engine);
    for (int i = 0; i < 36; ++i) {
      d.insert(i / 6, i % 6);
    }
    if (steered) {
      std::vector<double> values(36);
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<double>(i * i % 7);
      }
      ASSERT_EQ(radvor_delaunay_set_values(d, values.data(), 0, 36), RADVOR_OK);
    }
    d.constrain(7, 9, RADVOR_CONSTRAINT_BORDER);
    const Ids told = d.changes();
    ASSERT_FALSE(told.empty());
    const double nothing[] = {0, 0}, many[] = {0.5, 0.5, 1.25, 1.25}, bad[] = {1, HUGE_VAL};
    EXPECT_EQ(radvor_delaunay_insert_many(d, nothing, 0, nullptr), RADVOR_OK);
    EXPECT_EQ(d.changes(), told);
    EXPECT_EQ(radvor_delaunay_realign_near(d, nullptr, 0), RADVOR_OK);
    EXPECT_EQ(d.changes(), told);
    EXPECT_LT(radvor_delaunay_insert(d, HUGE_VAL, 0, nullptr), 0);
    EXPECT_LT(radvor_delaunay_insert_many(d, bad, 1, nullptr), 0);
    EXPECT_LT(radvor_delaunay_remove(d, 99), 0);
    EXPECT_LT(radvor_delaunay_constrain(d, 8, 8), 0);
    EXPECT_LT(radvor_delaunay_constrain(d, 2, 15), 0);  // across the border, after some flips
    EXPECT_LT(radvor_delaunay_unconstrain(d, 0, 35), 0);
    EXPECT_LT(radvor_delaunay_split(d, 7, 8, 5, 5, nullptr), 0);
    EXPECT_LT(radvor_delaunay_mark_domain(d), 0);
    EXPECT_EQ(d.changes(), told);
    // Memory that runs out, at every block.
    int refusals = 0;
    const auto starve = [&](auto&& edit) {
      const Ids before = d.changes();
      for (std::uint64_t n = 1;; ++n) {
        engine.refuse_from(n);
        const radvor_result result = edit();
        engine.refuse_from(0);
        if (result == RADVOR_OK) {
          return;
        }
        ASSERT_EQ(result, RADVOR_ERROR_OUT_OF_MEMORY);
        ASSERT_EQ(d.changes(), before) << "at block " << n;
        ++refusals;
      }
    };
    starve([&] { return radvor_delaunay_constrain(d, 12, 35); });
    starve([&] { return radvor_delaunay_insert_many(d, many, 2, nullptr); });
    EXPECT_TRUE(d.changes().empty());
    starve([&] { return radvor_delaunay_insert(d, 4.5, 4.25, nullptr); });
    EXPECT_FALSE(d.changes().empty());
    starve([&] { return radvor_delaunay_remove(d, 14); });
    EXPECT_GT(refusals, 3);
    // Edits that succeed and change nothing say so.
    d.insert(0, 0);
    EXPECT_TRUE(d.changes().empty());
  }
}

}  // namespace
}  // namespace radvor::test
