#include "base/error.h"

#include <cstdio>

namespace radvor {

Error::Error(ErrorCode code, const char* format, ...) noexcept : code_(code) {
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(message_, sizeof message_, format, arguments);
  va_end(arguments);
}

}  // namespace radvor
