// Every allocation fails once: the call throws, and the triangulation is as it was.
#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <random>

#include "base/error.h"
#include "delaunay/point_sets.h"
#include "delaunay/triangulation.h"
#include "support/counted_memory.h"

namespace radvor::delaunay {
namespace {

using testing::canonical_triangles;

struct State {
  explicit State(const Triangulation& d)
      : triangles(canonical_triangles(d)),
        positions(),
        count(d.vertex_count()),
        bound(d.vertex_bound()),
        constraints(d.constraint_count()) {
    for (VertexId v = 0; v < d.vertex_bound(); ++v) {
      positions.push_back(d.is_vertex(v) ? d.position(v) : Vec2(-1e9));
    }
  }
  bool operator==(const State&) const = default;
  std::vector<std::array<double, 6>> triangles;
  std::vector<Vec2> positions;
  std::uint32_t count, bound, constraints;
};

using Edit = std::function<void(Triangulation&)>;

// A fresh triangulation, the preparation, then the edit with its n-th allocation failing, for all n.
void fail_everywhere(const Edit& prepare, const Edit& edit) {
  for (std::int64_t n = 0;; ++n) {
    ASSERT_LT(n, 10000);
    test::CountedMemory memory;
    Triangulation d(&memory);
    prepare(d);
    const State before(d);
    memory.left = n;
    try {
      edit(d);
      memory.left = INT64_MAX;
      ASSERT_NO_THROW(d.validate());
      if (n == 0) {
        ADD_FAILURE() << "the edit allocates nothing: this proves nothing";
      }
      return;
    } catch (const std::bad_alloc&) {
    }
    memory.left = INT64_MAX;
    ASSERT_NO_THROW(d.validate()) << "allocation " << n;
    ASSERT_TRUE(State(d) == before) << "allocation " << n;
    ASSERT_NO_THROW(edit(d)) << "allocation " << n;
    ASSERT_NO_THROW(d.validate()) << "allocation " << n;
  }
}

void grid(Triangulation& d) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      d.insert({i, j});
    }
  }
}

void steered_grid(Triangulation& d) {
  grid(d);
  std::mt19937 random(3);
  std::vector<double> values;
  for (int i = 0; i < 36; ++i) {
    values.push_back(static_cast<double>(random() % 5));
  }
  d.set_values(values, 0);
}

TEST(out_of_memory, insert) {
  fail_everywhere([](Triangulation&) {},
                  [](Triangulation& d) {
                    for (int i = 0; i < 1; ++i) {
                      d.insert({i * 1.5, 0.25 * i});
                    }
                  });
  fail_everywhere(steered_grid, [](Triangulation& d) { d.insert({2.5, 2.5}); });
}

TEST(out_of_memory, insert_many) {
  const auto points = testing::point_sets()[2].make(60, 4);
  fail_everywhere([](Triangulation&) {}, [&](Triangulation& d) { d.insert_many(points, nullptr); });
  fail_everywhere(grid, [&](Triangulation& d) {
    auto shifted = points;
    for (Vec2& p : shifted) {
      p *= 0.75;
    }
    d.insert_many(shifted, nullptr);
  });
}

TEST(out_of_memory, remove_constrain_and_the_rest) {
  fail_everywhere(grid, [](Triangulation& d) { d.remove(2); });  // of the hull; inside nothing is allocated
  fail_everywhere(steered_grid, [](Triangulation& d) { d.remove(14); });
  fail_everywhere(grid, [](Triangulation& d) { d.constrain(1, 34, constraint::k_border); });
  fail_everywhere(
      [](Triangulation& d) {
        grid(d);
        d.constrain(1, 33, constraint::k_border);
        d.constrain(3, 35, constraint::k_border);
      },
      [](Triangulation& d) { d.constrain(18, 23 - 12, constraint::k_border, Crossing::split); });
  fail_everywhere(
      [](Triangulation& d) {
        grid(d);
        d.constrain(1, 34, constraint::k_border);
      },
      [](Triangulation& d) { d.unconstrain(1, 34); });
  fail_everywhere(
      [](Triangulation& d) {
        grid(d);
        d.constrain(14, 15, constraint::k_border);
      },
      [](Triangulation& d) {
        d.split(14, 15, {2.0 + 1e-15, 2.5});
      });
  fail_everywhere(steered_grid, [](Triangulation& d) { d.realign(); });
}

TEST(out_of_memory, the_second_vertex_beside_values) {  // found by fuzzing
  fail_everywhere(
      [](Triangulation& d) {
        d.insert({0, 0});
        const double value = 1;
        d.set_values({&value, 1}, 0);
      },
      [](Triangulation& d) {
        d.insert({4, 0});
      });
}

}  // namespace
}  // namespace radvor::delaunay
