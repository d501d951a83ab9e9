// Sums over everything, on many threads: ranges by themselves, and then in order, so that they round the same for any
// number of threads.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <vector>

#include "base/jobs.h"

namespace radvor {

/// add(sum, index) for each index < count; Sum{} is nothing, and += adds.
template <class Sum, class Add>
Sum sum_side_by_side(std::size_t count, const Jobs& jobs, std::pmr::memory_resource* memory, Add&& add) {
  constexpr std::size_t k_task = 16384;  // less is not worth waking a thread for
  std::pmr::vector<Sum> parts((count + k_task - 1) / k_task, Sum{}, memory);
  jobs.for_ranges(count, k_task, [&](std::size_t begin, std::size_t end) {
    Sum sum{};
    for (std::size_t k = begin; k < end; ++k) {
      add(sum, k);
    }
    parts[begin / k_task] = sum;
  });
  Sum all{};
  for (const Sum& part : parts) {
    all += part;
  }
  return all;
}

}  // namespace radvor
