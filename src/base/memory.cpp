#include "base/memory.h"

#include <new>

namespace radvor {

HostMemory::HostMemory(Acquire acquire, Release release, void* user) noexcept
    : acquire_(acquire), release_(release), user_(user) {}

void* HostMemory::do_allocate(std::size_t bytes, std::size_t alignment) {
  void* memory =
      acquire_ ? acquire_(user_, bytes, alignment) : ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
  if (!memory) {
    throw std::bad_alloc();
  }
  const std::uint64_t live = live_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  std::uint64_t peak = peak_.load(std::memory_order_relaxed);
  while (live > peak && !peak_.compare_exchange_weak(peak, live, std::memory_order_relaxed)) {
  }
  return memory;
}

void HostMemory::do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) {
  live_.fetch_sub(bytes, std::memory_order_relaxed);
  if (release_) {
    release_(user_, memory, bytes, alignment);
  } else if (!acquire_) {
    ::operator delete(memory, std::align_val_t(alignment));  // clang 14 has the sized one on request only
  }
}

}  // namespace radvor
