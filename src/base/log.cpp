#include "base/log.h"

#include <cstdarg>
#include <cstdio>

namespace radvor {

void Log::operator()(LogLevel level, const char* format, ...) const noexcept {
  if (!callback_) {
    return;
  }
  char text[1024];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  callback_(user_, static_cast<std::int32_t>(level), text);
}

}  // namespace radvor
