// What the shared library shows and needs: radvor_* alone, all of the header, and no Embree.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "structure/command.h"

namespace {

using radvor::test::run_command;

std::set<std::string> exported_symbols() {
  const auto listing = run_command("nm -D --defined-only " RADVOR_LIBRARY_FILE);
  EXPECT_EQ(listing.status, 0) << listing.output;
  std::set<std::string> symbols;
  std::istringstream lines(listing.output);
  for (std::string line; std::getline(lines, line);) {
    symbols.insert(line.substr(line.rfind(' ') + 1));
  }
  return symbols;
}

std::set<std::string> declared_functions() {
  std::ifstream stream(RADVOR_SOURCE_DIR "/include/radvor.h");
  const std::string header{std::istreambuf_iterator<char>(stream), {}};
  static const std::regex k_declaration(R"(RADVOR_API[^;(]*\b(radvor_\w+)\s*\()");
  std::set<std::string> functions;
  for (std::sregex_iterator match(header.begin(), header.end(), k_declaration), end; match != end; ++match) {
    functions.insert((*match)[1]);
  }
  return functions;
}

TEST(Exports, AreTheFunctionsOfTheHeaderAlone) {
  const std::set<std::string> symbols = exported_symbols(), functions = declared_functions();
  EXPECT_GT(functions.size(), 30u);
  for (const std::string& symbol : symbols) {
    EXPECT_TRUE(functions.contains(symbol)) << symbol << " is exported, but not in the header";
  }
  for (const std::string& function : functions) {
    EXPECT_TRUE(symbols.contains(function)) << function << " is in the header, but not exported";
  }
}

TEST(Exports, TheLibraryIsNotLinkedToEmbree) {
  // Hosts carry Embrees of their own: a library that is linked to another one hits nothing inside them.
  const auto needed = run_command("readelf -d " RADVOR_LIBRARY_FILE);
  ASSERT_EQ(needed.status, 0) << needed.output;
  EXPECT_NE(needed.output.find("NEEDED"), std::string::npos);
  EXPECT_EQ(needed.output.find("embree"), std::string::npos) << needed.output;
}

TEST(Imports, MemoryComesFromTheHostAlone) {
  if (std::string(RADVOR_SANITIZERS) != "") {
    GTEST_SKIP() << "sanitizers bring allocations of their own";
  }
  const auto listing = run_command("nm -DC --undefined-only " RADVOR_LIBRARY_FILE);
  ASSERT_EQ(listing.status, 0) << listing.output;
  // HostMemory's own calls, for hosts that lend none (base/memory.cpp, base/regions.cpp). std::stable_sort,
  // std::function or a plain std::vector would bring others.
  static const std::regex k_allowed(R"(operator new\(unsigned long, std::align_val_t, std::nothrow_t const&\)|\bmmap)");
  static const std::regex k_allocation(
      R"(\boperator new\b|\b(malloc|calloc|realloc|aligned_alloc|posix_memalign|mmap|mmap64|sbrk)\b)");
  std::istringstream lines(listing.output);
  std::size_t seen = 0;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_search(line, k_allocation)) {
      ++seen;
      EXPECT_TRUE(std::regex_search(line, k_allowed)) << line;
    }
  }
  EXPECT_EQ(seen, 2u);
}

}  // namespace
