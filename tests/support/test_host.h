// A Host for tests of internals: radvor's own threads, or plain ones where a sanitizer wants them.
#pragma once

#include "base/host.h"
#include "support/plain_threads.h"

namespace radvor::test {

/// The C++ runtime's memory, `threads` threads (1 to 3), no log unless given.
struct TestHost : Host {
  explicit TestHost(std::uint32_t threads = 2, const Log& where = Log(nullptr, nullptr))
      : Host{HostMemory(nullptr, nullptr, nullptr), where,
             Jobs(threads, plain_threads_wanted() ? plain(threads) : nullptr, nullptr, &memory)} {}

 private:
  static Jobs::HostParallelFor plain(std::uint32_t threads) {
    return threads == 1 ? plain_parallel_for<1> : threads == 2 ? plain_parallel_for<2> : plain_parallel_for<3>;
  }
};

}  // namespace radvor::test
