// The heap, counted, which can come to an end.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <new>

namespace radvor::test {

class CountedMemory : public std::pmr::memory_resource {
 public:
  std::size_t bytes = 0;  ///< in use
  std::size_t blocks_ever = 0;
  std::size_t most_blocks = 1000;  ///< ever: the next is refused

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override {
    if (blocks_ever == most_blocks) {
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
