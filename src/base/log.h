// Sentences for the host's log. Called on the calling thread alone.
#pragma once

#include <cstdint>

namespace radvor {

enum class LogLevel : std::int32_t { error = 0, warning = 1, info = 2, debug = 3 };

class Log {
 public:
  using Callback = void (*)(void* user, std::int32_t level, const char* utf8);

  Log(Callback callback, void* user) noexcept : callback_(callback), user_(user) {}

  /// printf-style; cut at 1023 bytes; nothing happens where the host gave no callback.
  [[gnu::format(printf, 3, 4)]] void operator()(LogLevel level, const char* format, ...) const noexcept;

 private:
  Callback callback_;
  void* user_;
};

}  // namespace radvor
