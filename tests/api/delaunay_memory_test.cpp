// Memory that runs out in the middle of an edit, and how much of it is taken.
#include <cstdlib>
#include <functional>
#include <utility>

#include "api/triangulation.h"

namespace radvor::test {
namespace {

// Every kind of edit, refused from its first block on, from its second, and so on until it works: it is as before.
TEST(DelaunayApi, MemoryRefusedAtAnyBlock) {
  using Edit = std::function<radvor_result(radvor_delaunay*)>;
  const auto many = random_points(300, 4);
  const std::vector<std::pair<const char*, Edit>> edits = {
      {"insert", [](radvor_delaunay* d) { return radvor_delaunay_insert(d, 1.5, 2.25, nullptr); }},
      {"insert many", [&](radvor_delaunay* d) { return radvor_delaunay_insert_many(d, many.data(), 300, nullptr); }},
      {"remove", [](radvor_delaunay* d) { return radvor_delaunay_remove(d, 0); }},
      {"remove inside", [](radvor_delaunay* d) { return radvor_delaunay_remove(d, 14); }},
      {"constrain", [](radvor_delaunay* d) { return radvor_delaunay_constrain(d, 14, 33); }},
      {"cross", [](radvor_delaunay* d) { return radvor_delaunay_constrain_as(d, 2, 33, 4, RADVOR_CROSSING_SPLIT); }},
      {"unconstrain", [](radvor_delaunay* d) { return radvor_delaunay_unconstrain(d, 6, 11); }},
      {"split", [](radvor_delaunay* d) { return radvor_delaunay_split(d, 7, 8, 1 + 0x1p-50, 1.75, nullptr); }},
      {"realign", [](radvor_delaunay* d) { return radvor_delaunay_realign(d); }},
      {"mark", [](radvor_delaunay* d) { return radvor_delaunay_mark_domain(d); }},
      {"values", [](radvor_delaunay* d) {
         const double values[] = {1, 2, 3};
         return radvor_delaunay_set_values(d, values, 3, 3);
       }}};
  int refused = 0;
  for (const bool steered : {false, true}) {
    for (const auto& [name, edit] : edits) {
      bool done = false;
      for (std::uint64_t n = 1; !done; ++n) {
        ASSERT_LT(n, 200u);
        Engine engine;
        const Delaunay d(engine);
        for (int i = 0; i < 36; ++i) {
          d.insert(i / 6, i % 6);
        }
        if (steered) {
          std::vector<double> values;
          for (int i = 0; i < 36; ++i) {
            values.push_back(i * i % 7);
          }
          ASSERT_EQ(radvor_delaunay_set_values(d, values.data(), 0, 36), RADVOR_OK);
        }
        d.constrain(6, 11, RADVOR_CONSTRAINT_CONTINUOUS);
        const auto before = d.state();
        engine.refuse_from(n);
        const radvor_result result = edit(d);
        engine.refuse_from(0);
        ASSERT_EQ(radvor_delaunay_validate(d), RADVOR_OK) << name << " at block " << n << ": " << engine.error();
        done = result == RADVOR_OK;
        if (!done) {
          ++refused;
          ASSERT_EQ(result, RADVOR_ERROR_OUT_OF_MEMORY) << name << " at block " << n << ": " << engine.error();
          ASSERT_EQ(d.state(), before) << name << " at block " << n;
          ASSERT_EQ(edit(d), RADVOR_OK) << name << " once there is memory: " << engine.error();
        }
      }
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(DelaunayApi, AMillionPointsTakeLessThan110BytesEach) {
  struct Memory {
    std::size_t live = 0, peak = 0;
  } memory;
  radvor_context_desc desc{};
  desc.struct_size = sizeof desc;
  desc.thread_count = 1;
  desc.user = &memory;
  desc.acquire = [](void* user, std::size_t bytes, std::size_t alignment) {
    auto& counted = *static_cast<Memory*>(user);
    counted.live += bytes;
    counted.peak = std::max(counted.peak, counted.live);
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  };
  desc.release = [](void* user, void* block, std::size_t bytes, std::size_t) {
    static_cast<Memory*>(user)->live -= bytes;
    std::free(block);
  };
  radvor_context* context = nullptr;
  ASSERT_EQ(radvor_context_create(&desc, &context), RADVOR_OK);
  const std::size_t before = memory.live;
  memory.peak = before;
  radvor_delaunay* d = nullptr;
  ASSERT_EQ(radvor_delaunay_create(context, &d), RADVOR_OK);
  const auto xy = random_points(1000000, 5);
  ASSERT_EQ(radvor_delaunay_insert_many(d, xy.data(), 1000000, nullptr), RADVOR_OK);
  EXPECT_LE(static_cast<double>(memory.peak - before) / 1e6, 110);
  radvor_delaunay_destroy(d);
  EXPECT_EQ(memory.live, before);
  radvor_context_destroy(context);
}

// A scene has thousands of facets with a handful of sites.
TEST(DelaunayApi, ASmallTriangulationTakesFewBlocks) {
  const Engine engine;
  const auto xy = random_points(12, 6);
  const std::uint64_t before = engine.blocks_acquired();
  const Delaunay d(engine);
  ASSERT_EQ(radvor_delaunay_insert_many(d, xy.data(), 12, nullptr), RADVOR_OK);
  EXPECT_LE(engine.blocks_acquired() - before, 10u);
}

}  // namespace
}  // namespace radvor::test
