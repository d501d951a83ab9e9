// A parallel_for of plain std::threads: what a host may lend, and what ThreadSanitizer can follow (it knows neither TBB
// nor Embree, which are not built with it).
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <thread>
#include <vector>

namespace radvor::test {

/// Whether tests are to lend plain threads and brute-force visibility instead of TBB and Embree.
inline bool plain_threads_wanted() {
  const char* wanted = std::getenv("RADVOR_TEST_PLAIN_THREADS");
  return wanted && *wanted == '1';
}

/// The signature of radvor_context_desc::parallel_for; `threads` of them, the calling one included, share the tasks.
template <unsigned threads>
void plain_parallel_for(void*, std::uint32_t count, void (*task)(void* data, std::uint32_t index), void* data) {
  std::atomic<std::uint32_t> next{0};
  const auto work = [&] {
    for (std::uint32_t index; (index = next.fetch_add(1)) < count;) {
      task(data, index);
    }
  };
  std::vector<std::thread> others;
  for (std::uint32_t i = 1; i < std::min<std::uint32_t>(threads, count); ++i) {
    others.emplace_back(work);
  }
  work();
  for (std::thread& thread : others) {
    thread.join();
  }
}

}  // namespace radvor::test
