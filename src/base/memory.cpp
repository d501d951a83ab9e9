#include "base/memory.h"

#include <new>

namespace radvor {

namespace {

// AddressSanitizer watches the bounds of what it hands out itself.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool k_regions = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool k_regions = false;
#else
constexpr bool k_regions = true;
#endif
#else
constexpr bool k_regions = true;
#endif

constexpr bool is_for_regions(std::size_t bytes, std::size_t alignment) {
  return k_regions && bytes >= Regions::k_least && alignment <= Regions::k_page;
}

}  // namespace

HostMemory::HostMemory(Acquire acquire, Release release, void* user) noexcept
    : acquire_(acquire), release_(release), user_(user) {}

void* HostMemory::own_allocate(std::size_t bytes, std::size_t alignment) {
  if (is_for_regions(bytes, alignment)) {
    if (void* block = regions_.allocate(bytes)) {
      return block;
    }
  }
  return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
}

void HostMemory::own_deallocate(void* memory, std::size_t bytes, std::size_t alignment) {
  if (!is_for_regions(bytes, alignment) || !regions_.deallocate(memory, bytes)) {
    // Without the size: clang 14 has that one on request only.
    ::operator delete(memory, std::align_val_t(alignment));
  }
}

void* HostMemory::do_allocate(std::size_t bytes, std::size_t alignment) {
  void* memory = acquire_ ? acquire_(user_, bytes, alignment) : own_allocate(bytes, alignment);
  if (!memory) {
    throw std::bad_alloc();
  }
  count_.add(static_cast<std::int64_t>(bytes));
  return memory;
}

void HostMemory::do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) {
  count_.add(-static_cast<std::int64_t>(bytes));
  if (release_) {
    release_(user_, memory, bytes, alignment);
  } else if (!acquire_) {
    own_deallocate(memory, bytes, alignment);
  }
}

}  // namespace radvor
