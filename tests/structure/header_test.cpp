// The public header by itself: without a warning in every language and for every kind of target it is meant for.
#include <gtest/gtest.h>

#include <string>

#include "structure/command.h"

namespace {

using radvor::test::run_command;

const std::string k_warnings =
    " -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wundef -Werror -fsyntax-only -I " RADVOR_SOURCE_DIR "/include ";

// The header twice (its guard), a struct by its size and a call: what any user writes.
const std::string k_use =
    "printf '#include <radvor.h>\\n#include <radvor.h>\\n"
    "uint32_t use(radvor_stats* stats);\\n"
    "uint32_t use(radvor_stats* stats) { stats->struct_size = (uint32_t)sizeof *stats; return radvor_version(); }\\n'";

struct Language {
  const char* name;
  const char* compiler;
  const char* flags;
};

class HeaderLanguage : public testing::TestWithParam<Language> {};

TEST_P(HeaderLanguage, CompilesWithoutAWarning) {
  const Language& language = GetParam();
  const auto result = run_command(k_use + " | " + language.compiler + " " + language.flags + k_warnings + "-");
  EXPECT_EQ(result.status, 0) << result.output;
}

INSTANTIATE_TEST_SUITE_P(All, HeaderLanguage,
                         testing::Values(Language{"C99", RADVOR_C_COMPILER, "-x c -std=c99 -Wstrict-prototypes"},
                                         Language{"C11", RADVOR_C_COMPILER, "-x c -std=c11 -Wstrict-prototypes"},
                                         Language{"Cxx11", RADVOR_CXX_COMPILER, "-x c++ -std=c++11"},
                                         Language{"Cxx20", RADVOR_CXX_COMPILER, "-x c++ -std=c++20"}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Header, AWarningWouldBeSeen) {
  const auto result = run_command("printf '#include <radvor.h>\\nint f(void) { int unused; return 0; }\\n' | " +
                                  std::string(RADVOR_C_COMPILER) + " -x c -std=c99" + k_warnings + "-");
  EXPECT_NE(result.status, 0);
}

class HeaderTarget : public testing::TestWithParam<const char*> {};

TEST_P(HeaderTarget, CompilesWithoutAWarning) {
  if (run_command("clang --version").status != 0) {
    GTEST_SKIP() << "clang is not installed: the header is not tried for " << GetParam();
  }
  for (const char* language : {"-x c -std=c99", "-x c++ -std=c++11 -nostdinc++"}) {
    // Freestanding: clang's own stddef.h and stdint.h, so that no target's system headers are needed.
    const auto result = run_command(k_use + " | clang --target=" + GetParam() + " -ffreestanding -nostdlibinc " +
                                    language + k_warnings + "-");
    EXPECT_EQ(result.status, 0) << language << "\n" << result.output;
  }
}

INSTANTIATE_TEST_SUITE_P(All, HeaderTarget,
                         testing::Values("x86_64-pc-windows-msvc", "i686-pc-windows-msvc", "aarch64-pc-windows-msvc",
                                         "x86_64-w64-mingw32", "arm64-apple-macos11", "x86_64-apple-macos10.15",
                                         "arm64-apple-ios14", "aarch64-linux-gnu", "armv7-linux-gnueabihf",
                                         "aarch64-linux-android21", "armv7a-linux-androideabi21", "i686-linux-gnu",
                                         "riscv64-linux-gnu", "wasm32-unknown-unknown", "wasm32-wasi"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& letter : name) {
                             letter = std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
                           }
                           return name;
                         });

}  // namespace
