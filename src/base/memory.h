// The host's allocator as a std::pmr::memory_resource: everything radvor itself keeps in memory comes from here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "base/byte_count.h"
#include "base/regions.h"

namespace radvor {

class HostMemory final : public std::pmr::memory_resource {
 public:
  using Acquire = void* (*)(void* user, std::size_t bytes, std::size_t alignment);
  using Release = void (*)(void* user, void* memory, std::size_t bytes, std::size_t alignment);

  /// NULL callbacks: the C++ runtime's aligned new and delete, and regions for what is large.
  HostMemory(Acquire acquire, Release release, void* user) noexcept;

  std::uint64_t live_bytes() const noexcept { return count_.live(); }
  std::uint64_t peak_bytes() const noexcept { return count_.peak(); }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;  // throws std::bad_alloc
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override;
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }

  void* own_allocate(std::size_t bytes, std::size_t alignment);
  void own_deallocate(void* memory, std::size_t bytes, std::size_t alignment);

  Acquire acquire_;
  Release release_;
  void* user_;
  Regions regions_;
  ByteCount count_;
};

}  // namespace radvor
