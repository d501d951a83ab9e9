// Sorts on many threads: parts by themselves, then pairs of parts merged.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/jobs.h"

namespace radvor {

/// less: a strict order of all values but equal ones, so that what comes out is the same for any number of threads.
template <class Value, class Less>
void sort_side_by_side(std::pmr::vector<Value>& values, const Jobs& jobs, Less&& less) {
  constexpr std::size_t k_task = 4096;  // less is not worth waking a thread for
  const std::size_t wanted = std::min<std::size_t>(jobs.thread_count(), values.size() / k_task);
  const std::size_t parts = wanted < 2 ? 1 : std::bit_ceil(wanted);
  const auto begin_of = [&](std::size_t part) { return values.size() * part / parts; };
  jobs.for_each(static_cast<std::uint32_t>(parts), [&](std::uint32_t part) {
    std::sort(values.begin() + static_cast<std::ptrdiff_t>(begin_of(part)),
              values.begin() + static_cast<std::ptrdiff_t>(begin_of(part + 1)), less);
  });
  if (parts == 1) {
    return;
  }
  std::pmr::vector<Value> merged(values.size(), values.get_allocator());
  for (std::size_t width = 1; width < parts; width *= 2) {
    jobs.for_each(static_cast<std::uint32_t>(parts / (2 * width)), [&](std::uint32_t pair) {
      const std::size_t first = 2 * width * pair;
      const auto at = [&](std::size_t part) { return values.begin() + static_cast<std::ptrdiff_t>(begin_of(part)); };
      std::merge(at(first), at(first + width), at(first + width), at(first + 2 * width),
                 merged.begin() + static_cast<std::ptrdiff_t>(begin_of(first)), less);
    });
    values.swap(merged);
  }
}

}  // namespace radvor
