// Debian 12's two compilers read the same sources: clang 14, which builds for the sanitizers, the fuzzers and
// clang-tidy, rejects libstdc++ 12's std::ranges::subrange, and so every algorithm that returns one. The builds that
// notice are slow; this reads the sources.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace {

namespace fs = std::filesystem;

const std::regex k_subrange(
    R"(std::ranges::(subrange|views|equal_range|unique|remove|remove_if|partition|stable_partition|rotate|shift_left)"
    R"(|shift_right|search|search_n|find_end|find_last|find_last_if)\b|std::views::)");

TEST(Ranges, WhatGivesASubrangeIsSeen) {
  EXPECT_TRUE(std::regex_search("  const auto doubles = std::ranges::unique(vertices);", k_subrange));
  EXPECT_TRUE(std::regex_search("for (auto x : std::views::reverse(v))", k_subrange));
  EXPECT_FALSE(std::regex_search("std::ranges::unique_copy(a, b); std::unique(a.begin(), a.end());", k_subrange));
  EXPECT_FALSE(std::regex_search("std::ranges::sort(a); std::ranges::lower_bound(a, 3);", k_subrange));
}

TEST(Ranges, NothingNeedsASubrange) {
  std::size_t files = 0;
  for (const char* folder : {"src", "samples", "tests", "fuzz", "bench"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(RADVOR_SOURCE_DIR) / folder)) {
      const std::string extension = entry.path().extension().string();
      if ((extension != ".h" && extension != ".cpp") || entry.path().filename() == "ranges_test.cpp") {
        continue;
      }
      ++files;
      std::ifstream text(entry.path());
      std::size_t number = 0;
      for (std::string line; std::getline(text, line);) {
        ++number;
        EXPECT_FALSE(std::regex_search(line, k_subrange))
            << entry.path().string() << ":" << number << ": clang 14 rejects this: " << line;
      }
    }
  }
  EXPECT_GT(files, 100u);
}

}  // namespace
