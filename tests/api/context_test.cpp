// Version, result strings, contexts: what is refused, and where the reason goes.
#include <gtest/gtest.h>
#include <radvor.h>

#include <cstring>
#include <set>
#include <string>

#include "api/engine.h"

namespace radvor::test {
namespace {

TEST(Version, IsTheHeaders) {
  EXPECT_EQ(radvor_version(), (RADVOR_VERSION_MAJOR << 22 | RADVOR_VERSION_MINOR << 12 | RADVOR_VERSION_PATCH));
}

TEST(ResultStrings, AreThereAndDiffer) {
  std::set<std::string> texts;
  for (radvor_result result = RADVOR_ERROR_INTERNAL; result <= RADVOR_TIME_SPENT; ++result) {
    ASSERT_NE(radvor_result_string(result), nullptr);
    texts.insert(radvor_result_string(result));
  }
  EXPECT_EQ(texts.size(), 10u);
  for (const radvor_result unknown : {3, -8, INT32_MAX, INT32_MIN}) {
    ASSERT_NE(radvor_result_string(unknown), nullptr);
    EXPECT_FALSE(texts.contains(radvor_result_string(unknown))) << unknown;
  }
}

TEST(Context, NeedsNothing) {
  radvor_context* context = nullptr;
  ASSERT_EQ(radvor_context_create(nullptr, &context), RADVOR_OK);
  ASSERT_NE(context, nullptr);
  EXPECT_STREQ(radvor_context_error(context), "");
  radvor_context_destroy(context);
  radvor_context_destroy(nullptr);
}

TEST(Context, ErrorOfNullIsText) {
  ASSERT_NE(radvor_context_error(nullptr), nullptr);
  EXPECT_GT(std::strlen(radvor_context_error(nullptr)), 0u);
}

TEST(Context, RefusesNullForTheHandle) {
  EXPECT_EQ(radvor_context_create(nullptr, nullptr), RADVOR_ERROR_INVALID_ARGUMENT);
}

radvor_context* const k_stale =
    reinterpret_cast<radvor_context*>(std::uintptr_t{64});  // a handle that must become NULL

// The reason goes to the description's log, the handle becomes NULL.
void expect_refused(radvor_context_desc desc, radvor_result expected, const std::string& words) {
  std::string heard;
  desc.user = &heard;
  desc.log = [](void* user, std::int32_t level, const char* text) {
    EXPECT_EQ(level, RADVOR_LOG_ERROR);
    *static_cast<std::string*>(user) = text;
  };
  radvor_context* context = k_stale;
  EXPECT_EQ(radvor_context_create(&desc, &context), expected) << words;
  EXPECT_EQ(context, nullptr) << words;
  EXPECT_NE(heard.find(words), std::string::npos) << "heard: " << heard;
}

radvor_context_desc valid() {
  radvor_context_desc desc{};
  desc.struct_size = sizeof desc;
  return desc;
}

TEST(Context, RefusesTooManyThreads) {
  radvor_context_desc desc = valid();
  desc.thread_count = 4097;
  expect_refused(desc, RADVOR_ERROR_INVALID_ARGUMENT, "thread_count is 4097");
}

TEST(Context, RefusesReleaseWithoutAcquire) {
  radvor_context_desc desc = valid();
  desc.release = [](void*, void*, std::size_t, std::size_t) { FAIL() << "released what was never acquired"; };
  expect_refused(desc, RADVOR_ERROR_INVALID_ARGUMENT, "release without acquire");
}

TEST(Context, OutOfMemoryIsSaid) {
  radvor_context_desc desc = valid();
  desc.acquire = [](void*, std::size_t, std::size_t) -> void* { return nullptr; };
  expect_refused(desc, RADVOR_ERROR_OUT_OF_MEMORY, "out of memory");
}

TEST(Context, GivesAllMemoryBackWhereCreationFails) {
  static int live, until_refusal;
  for (int refused = 1, result = RADVOR_ERROR_OUT_OF_MEMORY; result != RADVOR_OK; ++refused) {
    live = 0;
    until_refusal = refused;
    radvor_context_desc desc = valid();
    desc.embree_path = "/a/path/that/is/too/long/for/any/string/to/keep/inside/itself/libembree.so";
    desc.acquire = [](void*, std::size_t bytes, std::size_t alignment) -> void* {
      if (--until_refusal <= 0) {
        return nullptr;
      }
      ++live;
      const std::size_t unit = std::max(alignment, sizeof(void*));  // what aligned_alloc takes, and multiples of it
      return std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
    };
    desc.release = [](void*, void* memory, std::size_t, std::size_t) {
      --live;
      std::free(memory);
    };
    radvor_context* context = k_stale;
    result = radvor_context_create(&desc, &context);
    if (result == RADVOR_OK) {
      EXPECT_GT(refused, 2) << "a context and its path are at least two blocks";
      EXPECT_GT(live, 1);
      radvor_context_destroy(context);
    } else {
      EXPECT_EQ(result, RADVOR_ERROR_OUT_OF_MEMORY);
      EXPECT_EQ(context, nullptr);
    }
    EXPECT_EQ(live, 0) << "refused from block " << refused;
    ASSERT_LT(refused, 100);
  }
}

TEST(Context, KeepsTheReasonOfTheLastFailure) {
  const Engine engine;
  EXPECT_EQ(engine.error(), "");
  radvor_scene* scene = nullptr;
  EXPECT_EQ(radvor_scene_create(engine.context(), nullptr), RADVOR_ERROR_INVALID_ARGUMENT);
  const std::string reason = engine.error();
  EXPECT_NE(reason.find("radvor_scene_create"), std::string::npos) << reason;
  EXPECT_EQ(engine.last_log(), reason);
  ASSERT_EQ(radvor_scene_create(engine.context(), &scene), RADVOR_OK);
  EXPECT_EQ(engine.error(), reason) << "calls that work leave it alone";
  radvor_scene_destroy(scene);
}

}  // namespace
}  // namespace radvor::test
