// A call that must fail: with which code, and with which words in its reason.
#pragma once

#include <gtest/gtest.h>
#include <radvor.h>

#include <functional>
#include <string>

#include "api/engine.h"

namespace radvor::test {

/// One line of a table of refusals.
template <class Desc>
struct Refusal {
  const char* words;  ///< that the reason has: the culprit and its value
  radvor_result result;
  std::function<void(Desc&)> spoil;  ///< makes the valid description wrong
};

/// The code, the words in the context and in the log, and no memory kept.
inline void expect_refusal(const Engine& engine, radvor_result expected, const std::string& function,
                           const std::string& words, const std::function<radvor_result()>& call) {
  const std::size_t blocks = engine.live_blocks(), lines = engine.lines_logged();
  EXPECT_EQ(call(), expected) << function << ": " << words << "\nsaid: " << engine.error();
  EXPECT_NE(engine.error().find(words), std::string::npos) << "wanted: " << words << "\nsaid: " << engine.error();
  EXPECT_EQ(engine.error().rfind(function + ": ", 0), 0u) << engine.error();
  EXPECT_EQ(engine.lines_logged(), lines + 1) << function << ": " << words;
  EXPECT_EQ(engine.last_log(), engine.error());
  EXPECT_EQ(engine.live_blocks(), blocks) << function << ": " << words;
}

}  // namespace radvor::test
