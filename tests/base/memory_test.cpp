// The library's own memory, whatever a block's size and alignment; and what is lent comes from the host alone.
#include "base/memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <new>
#include <thread>
#include <vector>

namespace radvor {
namespace {

TEST(HostMemory, OwnBlocksOfAnySizeAndAlignment) {
  HostMemory memory(nullptr, nullptr, nullptr);
  struct Block {
    void* memory;
    std::size_t bytes, alignment;
  };
  std::vector<Block> blocks;
  std::uint64_t live = 0;
  for (const std::size_t bytes : {std::size_t{1}, Regions::k_least - 1, Regions::k_least, Regions::k_least + 1,
                                  std::size_t{3} << 20, std::size_t{100} << 20}) {
    for (const std::size_t alignment : {std::size_t{1}, std::size_t{64}, Regions::k_page, 2 * Regions::k_page}) {
      void* const block = memory.allocate(bytes, alignment);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % alignment, 0u);
      std::memset(block, 1, bytes > std::size_t{4} << 20 ? Regions::k_page : bytes);
      blocks.push_back({block, bytes, alignment});
      live += bytes;
    }
  }
  EXPECT_EQ(memory.live_bytes(), live);
  for (const Block& block : blocks) {
    memory.deallocate(block.memory, block.bytes, block.alignment);
  }
  EXPECT_EQ(memory.live_bytes(), 0u);
  EXPECT_EQ(memory.peak_bytes(), live);
}

// Threads add up for themselves: in the end nothing is lost, and the peak is what it was to 1 / 256 for each.
TEST(HostMemory, ManyThreadsCountTogether) {
  constexpr std::uint32_t k_threads = 40;  // more than there are counters for
  constexpr std::size_t k_kept = 200, k_bytes = 1000;
  HostMemory memory(nullptr, nullptr, nullptr);
  const auto on_all = [](auto&& work) {
    std::vector<std::thread> threads;
    for (std::uint32_t thread = 0; thread < k_threads; ++thread) {
      threads.emplace_back([&, thread] { work(thread); });
    }
    for (std::thread& thread : threads) {
      thread.join();
    }
  };
  std::vector<std::vector<void*>> blocks(k_threads);
  on_all([&](std::uint32_t thread) {
    for (std::size_t k = 0; k < 10 * k_kept; ++k) {
      void* const block = memory.allocate(k_bytes, 16);
      if (k % 10 == 0) {
        blocks[thread].push_back(block);
      } else {
        memory.deallocate(block, k_bytes, 16);
      }
    }
  });
  constexpr std::uint64_t k_live = k_threads * k_kept * k_bytes;
  EXPECT_EQ(memory.live_bytes(), k_live);
  on_all([&](std::uint32_t thread) {
    for (void* const block : blocks[k_threads - 1 - thread]) {  // given back by others than took them
      memory.deallocate(block, k_bytes, 16);
    }
  });
  EXPECT_EQ(memory.live_bytes(), 0u);
  EXPECT_GE(memory.peak_bytes(), k_live - k_live * k_threads / 256);
  EXPECT_LE(memory.peak_bytes(), k_live + k_threads * k_bytes + k_live * k_threads / 256);
}

TEST(HostMemory, MoreThanThereIsIsRefused) {
  HostMemory memory(nullptr, nullptr, nullptr);
  EXPECT_THROW(static_cast<void>(memory.allocate(std::size_t{1} << 60, 16)), std::bad_alloc);
  EXPECT_EQ(memory.live_bytes(), 0u);
}

TEST(HostMemory, WhatIsLentIsAskedForAlone) {
  struct Lender {
    std::size_t acquired = 0, released = 0;
  } lender;
  HostMemory memory(
      [](void* user, std::size_t bytes, std::size_t alignment) {
        static_cast<Lender*>(user)->acquired += bytes;
        return ::operator new(bytes, std::align_val_t(alignment));
      },
      [](void* user, void* block, std::size_t bytes, std::size_t alignment) {
        static_cast<Lender*>(user)->released += bytes;
        ::operator delete(block, std::align_val_t(alignment));
      },
      &lender);
  void* const block = memory.allocate(1 << 20, 16);
  EXPECT_EQ(lender.acquired, 1u << 20);
  memory.deallocate(block, 1 << 20, 16);
  EXPECT_EQ(lender.released, 1u << 20);
}

}  // namespace
}  // namespace radvor
