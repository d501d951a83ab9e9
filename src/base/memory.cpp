#include "base/memory.h"

#include <algorithm>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace radvor {

namespace {

// Large blocks are read all over (a triangulation's triangles, light of all samples): in pages of 4 KiB every step of a
// walk misses the table of pages too. Linux gives larger ones to who asks.
constexpr std::size_t k_large = std::size_t{16} << 20, k_large_page = std::size_t{2} << 20;

std::size_t own_alignment(std::size_t bytes, std::size_t alignment) {
  return bytes >= k_large ? std::max(alignment, k_large_page) : alignment;
}

void* own_allocate(std::size_t bytes, std::size_t alignment) {
  void* memory = ::operator new(bytes, std::align_val_t(own_alignment(bytes, alignment)), std::nothrow);
#ifdef __linux__
  if (memory != nullptr && bytes >= k_large) {
    madvise(memory, bytes / k_large_page * k_large_page, MADV_HUGEPAGE);  // where it is refused pages stay small
  }
#endif
  return memory;
}

}  // namespace

HostMemory::HostMemory(Acquire acquire, Release release, void* user) noexcept
    : acquire_(acquire), release_(release), user_(user) {}

void* HostMemory::do_allocate(std::size_t bytes, std::size_t alignment) {
  void* memory = acquire_ ? acquire_(user_, bytes, alignment) : own_allocate(bytes, alignment);
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
    // Without the size: clang 14 has that one on request only.
    ::operator delete(memory, std::align_val_t(own_alignment(bytes, alignment)));
  }
}

}  // namespace radvor
