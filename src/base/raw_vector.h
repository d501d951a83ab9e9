// A std::pmr::vector whose new elements hold anything until they are written: for those that tasks fill side by side.
// To write them twice was a twentieth of a bake, and on one thread.
#pragma once

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <type_traits>
#include <utility>
#include <vector>

namespace radvor {

template <class T>
class RawAllocator {
 public:
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  using value_type = T;

  RawAllocator(std::pmr::memory_resource* memory) noexcept : memory_(memory) {}
  template <class Other>
  RawAllocator(const RawAllocator<Other>& other) noexcept : memory_(other.resource()) {}

  T* allocate(std::size_t count) { return std::pmr::polymorphic_allocator<T>(memory_).allocate(count); }
  void deallocate(T* memory, std::size_t count) {
    std::pmr::polymorphic_allocator<T>(memory_).deallocate(memory, count);
  }

  template <class... Arguments>
  void construct(T* at, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) > 0) {
      std::construct_at(at, std::forward<Arguments>(arguments)...);
    }
  }

  std::pmr::memory_resource* resource() const noexcept { return memory_; }
  bool operator==(const RawAllocator& other) const noexcept { return *memory_ == *other.memory_; }

 private:
  std::pmr::memory_resource* memory_;
};

template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace radvor
