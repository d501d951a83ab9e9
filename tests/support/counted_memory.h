// The heap, counted, which may refuse a block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <new>

namespace radvor::test {

class CountedMemory : public std::pmr::memory_resource {
 public:
  std::size_t bytes = 0;  ///< in use
  std::size_t blocks_ever = 0;
  std::int64_t left = INT64_MAX;  ///< blocks until one is refused; those after it are given again

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override {
    if (left-- == 0) {
      throw std::bad_alloc();
    }
    ++blocks_ever;
    bytes += size;
    return std::pmr::new_delete_resource()->allocate(size, alignment);
  }
  void do_deallocate(void* block, std::size_t size, std::size_t alignment) override {
    bytes -= size;
    std::pmr::new_delete_resource()->deallocate(block, size, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

}  // namespace radvor::test
