// Blocks out of regions: apart from one another, whole again when all is back, and refused without harm.
#include "base/regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace radvor {
namespace {

struct Block {
  std::byte* memory;
  std::size_t bytes;
  std::byte mark;
};

// A mark in every page, and at the end, so that blocks that overlap show.
void fill(const Block& block) {
  for (std::size_t at = 0; at < block.bytes; at += Regions::k_page) {
    block.memory[at] = block.mark;
  }
  block.memory[block.bytes - 1] = block.mark;
}

bool is_filled(const Block& block) {
  for (std::size_t at = 0; at < block.bytes; at += Regions::k_page) {
    if (block.memory[at] != block.mark) {
      return false;
    }
  }
  return block.memory[block.bytes - 1] == block.mark;
}

class RegionsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    void* const block = regions.allocate(1);
    if (block == nullptr) {
      GTEST_SKIP() << "no regions on this system";
    }
    ASSERT_TRUE(regions.deallocate(block, 1));
    one = regions.bytes();
  }

  // Takes and gives back blocks in random order; what stays is left in `blocks`.
  void stress(std::uint32_t seed, std::size_t steps, std::vector<Block>& blocks) {
    std::mt19937 random(seed);
    for (std::size_t step = 0; step < steps; ++step) {
      if (blocks.empty() || random() % 5 < 3) {
        const std::size_t bytes = 1 + random() % (random() % 8 == 0 ? 9'000'000 : 300'000);
        auto* const memory = static_cast<std::byte*>(regions.allocate(bytes));
        ASSERT_NE(memory, nullptr);
        ASSERT_EQ(reinterpret_cast<std::uintptr_t>(memory) % Regions::k_page, 0u);
        blocks.push_back({memory, bytes, static_cast<std::byte>(random())});
        fill(blocks.back());
      } else {
        std::swap(blocks[random() % blocks.size()], blocks.back());
        ASSERT_TRUE(is_filled(blocks.back()));
        ASSERT_TRUE(regions.deallocate(blocks.back().memory, blocks.back().bytes));
        blocks.pop_back();
      }
    }
  }

  void give_back(std::vector<Block>& blocks) {
    for (const Block& block : blocks) {
      EXPECT_TRUE(is_filled(block));
      EXPECT_TRUE(regions.deallocate(block.memory, block.bytes));
    }
    blocks.clear();
  }

  Regions regions;
  std::size_t one = 0;  // region's bytes
};

TEST_F(RegionsTest, BlocksLieApartAndKeepWhatIsWritten) {
  std::vector<Block> blocks;
  stress(1, 1000, blocks);
  std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.memory < b.memory; });
  for (std::size_t k = 0; k + 1 < blocks.size(); ++k) {
    EXPECT_LE(blocks[k].memory + blocks[k].bytes, blocks[k + 1].memory);
  }
  give_back(blocks);
}

TEST_F(RegionsTest, HolesJoinAgain) {
  for (std::uint32_t seed = 2; seed < 6; ++seed) {
    std::vector<Block> blocks;
    stress(seed, 1000, blocks);
    give_back(blocks);
    EXPECT_EQ(regions.bytes(), one);  // one stays, whole but for its head:
    const std::size_t whole = one - one / 16;
    void* const block = regions.allocate(whole);
    EXPECT_EQ(regions.bytes(), one);
    EXPECT_TRUE(regions.deallocate(block, whole));
  }
}

TEST_F(RegionsTest, AreUsedAgain) {
  std::vector<Block> blocks;
  for (int round = 0; round < 100; ++round) {
    const std::size_t bytes = one / 4;
    blocks.push_back({static_cast<std::byte*>(regions.allocate(bytes)), bytes, std::byte{7}});
    fill(blocks.back());
    give_back(blocks);
  }
  EXPECT_EQ(regions.bytes(), one);
}

// Arrays that are made anew while the last ones are still there, each time a little larger.
TEST_F(RegionsTest, WhatGrowsALittleLiesWhereTheLastButOneDid) {
  std::size_t bytes = 33 * (one / 50);
  void* before = regions.allocate(bytes);
  void* now = regions.allocate(bytes + bytes / 100);
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(regions.deallocate(before, bytes));
    bytes += bytes / 100;
    void* const next = regions.allocate(bytes + bytes / 100);
    EXPECT_EQ(next, before);
    before = now;
    now = next;
  }
  EXPECT_EQ(regions.bytes(), 2 * one);
  EXPECT_TRUE(regions.deallocate(before, bytes));
  EXPECT_TRUE(regions.deallocate(now, bytes));
}

// One page between the smallest blocks: as many holes as there may be.
TEST_F(RegionsTest, TheMostHoles) {
  const std::size_t wider = Regions::k_least + Regions::k_page;
  std::vector<void*> blocks = {regions.allocate(wider)}, rest;
  // Fills the one region with blocks of a size.
  const auto fill = [&](std::size_t bytes, std::vector<void*>& into) {
    for (;;) {
      auto* const block = static_cast<std::byte*>(regions.allocate(bytes));
      if (block < blocks[0] || block >= static_cast<std::byte*>(blocks[0]) + one) {
        ASSERT_TRUE(regions.deallocate(block, bytes));
        return;
      }
      into.push_back(block);
    }
  };
  fill(wider, blocks);
  fill(Regions::k_least, rest);
  std::sort(blocks.begin(), blocks.end(), std::greater<>());
  for (void* const block : blocks) {  // from the last on, so that no hole joins the one before
    ASSERT_TRUE(regions.deallocate(block, wider));
    void* const smaller = regions.allocate(Regions::k_least);
    ASSERT_EQ(smaller, block);
    std::memset(smaller, 1, Regions::k_least);
  }
  // All of them are known: the last blocks and what lies between are one hole once they are back.
  EXPECT_TRUE(regions.deallocate(blocks[0], Regions::k_least));
  EXPECT_TRUE(regions.deallocate(blocks[1], Regions::k_least));
  blocks.erase(blocks.begin());
  constexpr std::size_t k_two = 2 * Regions::k_least + Regions::k_page;
  void* const two = regions.allocate(k_two);
  EXPECT_EQ(two, static_cast<std::byte*>(blocks[0]) - Regions::k_page);  // with the hole before them
  EXPECT_TRUE(regions.deallocate(two, k_two));
  blocks.erase(blocks.begin());
  for (void* const block : blocks) {
    EXPECT_TRUE(regions.deallocate(block, Regions::k_least));
  }
  for (void* const block : rest) {
    EXPECT_TRUE(regions.deallocate(block, Regions::k_least));
  }
  EXPECT_LE(regions.bytes(), 2 * one);
}

// An eighth of what is in use may lie idle, or one region.
TEST_F(RegionsTest, GoBackToTheSystemThoughSomethingIsLeft) {
  const std::size_t few = one / 8;
  void* const left = regions.allocate(few);
  std::vector<void*> blocks;
  const std::size_t most = one - one / 16;
  for (int k = 0; k < 10; ++k) {
    blocks.push_back(regions.allocate(most));
  }
  EXPECT_EQ(regions.bytes(), 11 * one);
  for (void* const block : blocks) {
    EXPECT_TRUE(regions.deallocate(block, most));
  }
  EXPECT_LE(regions.bytes(), 2 * one);
  EXPECT_TRUE(regions.deallocate(left, few));
  EXPECT_EQ(regions.bytes(), one);
}

TEST_F(RegionsTest, LargerThanARegion) {
  const std::size_t bytes = 3 * one + 5;
  Block block{static_cast<std::byte*>(regions.allocate(bytes)), bytes, std::byte{1}};
  ASSERT_NE(block.memory, nullptr);
  fill(block);
  EXPECT_TRUE(is_filled(block));
  EXPECT_TRUE(regions.deallocate(block.memory, bytes));
  EXPECT_LE(regions.bytes(), one);
}

TEST_F(RegionsTest, RefuseWhatThereIsNot) {
  EXPECT_EQ(regions.allocate(std::numeric_limits<std::size_t>::max()), nullptr);
  EXPECT_EQ(regions.allocate(std::numeric_limits<std::size_t>::max() / 4), nullptr);
  EXPECT_EQ(regions.bytes(), one);
  std::byte elsewhere;
  EXPECT_FALSE(regions.deallocate(&elsewhere, 1));
}

TEST_F(RegionsTest, ManyThreads) {
  std::vector<std::thread> threads;
  std::vector<std::vector<Block>> blocks(4);
  for (std::uint32_t k = 0; k < blocks.size(); ++k) {
    threads.emplace_back([&, k] { stress(10 + k, 500, blocks[k]); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (auto& of_thread : blocks) {
    give_back(of_thread);
  }
  EXPECT_EQ(regions.bytes(), one);
}

}  // namespace
}  // namespace radvor
