// An engine as the tests play it: it lends memory that it audits and can refuse, threads that it counts, and a log that
// it reads. Everything here goes through the public header.
#pragma once

#include <gtest/gtest.h>
#include <radvor.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "support/plain_threads.h"

namespace radvor::test {

/// What an engine lends.
struct Lends {
  bool memory = true;
  bool threads = plain_threads_wanted();  ///< a parallel_for of plain threads
  std::uint32_t thread_count = 2;
  std::string embree_path{};  ///< empty: the system's; under the thread sanitizer the stand-in for it
};

class Engine {
 public:
  explicit Engine(const Lends& lends = {}) {
    desc_.struct_size = sizeof desc_;
    desc_.thread_count = lends.thread_count;
    desc_.user = this;
    desc_.log = [](void* user, std::int32_t level, const char* text) { of(user).hear(level, text); };
    if (lends.memory) {
      desc_.acquire = [](void* user, std::size_t bytes, std::size_t alignment) {
        return of(user).acquire(bytes, alignment);
      };
      desc_.release = [](void* user, void* memory, std::size_t bytes, std::size_t alignment) {
        of(user).release(memory, bytes, alignment);
      };
    }
    if (lends.threads) {
      desc_.parallel_for = [](void* user, std::uint32_t count, radvor_task task, void* data) {
        ++of(user).loops;
        plain_parallel_for<2>(nullptr, count, task, data);
      };
    }
#ifdef RADVOR_STAND_IN_EMBREE
    if (plain_threads_wanted()) {
      desc_.embree_path = RADVOR_STAND_IN_EMBREE;  // brute force, built with the sanitizer
    }
#endif
    if (!lends.embree_path.empty()) {
      desc_.embree_path = lends.embree_path.c_str();
    }
    EXPECT_EQ(radvor_context_create(&desc_, &context_), RADVOR_OK) << last_log();
  }

  ~Engine() {
    radvor_context_destroy(context_);
    EXPECT_TRUE(blocks_.empty()) << blocks_.size() << " blocks were not given back";
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  radvor_context* context() const {
    return context_;
  }
  const radvor_context_desc& desc() const {
    return desc_;
  }

  std::string error() const {
    return radvor_context_error(context_);
  }

  /// Empty where nothing was logged.
  std::string last_log() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return lines_.empty() ? std::string() : lines_.back();
  }
  std::size_t lines_logged() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return lines_.size();
  }

  std::size_t live_blocks() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return blocks_.size();
  }
  std::uint64_t blocks_acquired() const {
    return acquired_;
  }

  /// The n-th acquire from now (1: the next) and all after it find no memory; 0: all do again.
  void refuse_from(std::uint64_t n) {
    refuse_ = n == 0 ? UINT64_MAX : acquired_ + n;
  }

  std::atomic<std::uint64_t> loops{0};  ///< parallel_for calls

 private:
  struct Block {
    std::size_t bytes, alignment;
  };

  static Engine& of(void* user) {
    return *static_cast<Engine*>(user);
  }

  void* acquire(std::size_t bytes, std::size_t alignment) {
    EXPECT_GT(bytes, 0u);
    EXPECT_TRUE(alignment > 0 && (alignment & (alignment - 1)) == 0) << alignment;
    if (++acquired_ >= refuse_) {
      return nullptr;
    }
    const std::size_t unit = std::max(alignment, sizeof(void*));  // what aligned_alloc takes, and multiples of it
    void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
    if (!memory) {
      return nullptr;
    }
    std::memset(memory, 0xcd, bytes);  // nobody may count on zeros
    const std::lock_guard<std::mutex> lock(mutex_);
    blocks_[memory] = {bytes, alignment};
    return memory;
  }

  void release(void* memory, std::size_t bytes, std::size_t alignment) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto block = blocks_.find(memory);
      ASSERT_NE(block, blocks_.end()) << "a block that was never lent, or given back twice";
      EXPECT_EQ(block->second.bytes, bytes);
      EXPECT_EQ(block->second.alignment, alignment);
      blocks_.erase(block);
    }
    std::memset(memory, 0xdd, bytes);
    std::free(memory);
  }

  void hear(std::int32_t level, const char* text) {
    const std::lock_guard<std::mutex> lock(mutex_);
    EXPECT_TRUE(level >= RADVOR_LOG_ERROR && level <= RADVOR_LOG_DEBUG) << level;
    lines_.emplace_back(text);
  }

  radvor_context_desc desc_{};
  radvor_context* context_ = nullptr;
  mutable std::mutex mutex_;
  std::map<void*, Block> blocks_;
  std::vector<std::string> lines_;
  std::atomic<std::uint64_t> acquired_{0}, refuse_{UINT64_MAX};
};

}  // namespace radvor::test
