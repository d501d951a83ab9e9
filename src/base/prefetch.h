// Memory asked ahead for a whole thing, all lines of it.
#pragma once

#include <cstddef>

namespace radvor {

template <class T>
void prefetch(const T& thing) {
  constexpr std::size_t k_line = 64;  // bytes
  for (std::size_t at = 0; at < sizeof(T); at += k_line) {
    __builtin_prefetch(reinterpret_cast<const char*>(&thing) + at);
  }
}

}  // namespace radvor
