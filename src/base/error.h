// The one exception of the core: a result code and a sentence for people. It allocates nothing, so that it can
// report running out of memory.
#pragma once

#include <cstdarg>
#include <cstdint>
#include <exception>

namespace radvor {

/// Why a call failed. The numbers are those of radvor_result; src/api proves it.
enum class ErrorCode : std::int32_t {
  invalid_argument = -1,
  invalid_geometry = -2,
  out_of_memory = -3,
  limit = -4,
  constraint = -5,
  unsupported = -6,
  internal = -7,
};

class Error : public std::exception {
 public:
  /// printf-style; the sentence names the culprit (mesh, triangle, value) and is cut at 511 bytes.
  [[gnu::format(printf, 3, 4)]] Error(ErrorCode code, const char* format, ...) noexcept;

  const char* what() const noexcept override { return message_; }
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
  char message_[512];
};

}  // namespace radvor
