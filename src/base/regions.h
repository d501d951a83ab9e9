// Large blocks out of regions that are taken from the system once. A bake's arrays are made anew with every refinement:
// memory that comes fresh each time is paid for page by page, more than what is written there. So what is let go is
// kept for what is asked next, in large pages where the system has them; of regions with nothing in them no more than
// an eighth of what the others hold, or one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>

namespace radvor {

/// Any thread may ask. Systems other than Linux have none: all is refused there.
class Regions {
 public:
  /// Blocks are whole pages: for those that are smaller the general allocator does better.
  static constexpr std::size_t k_least = std::size_t{32} << 10;
  static constexpr std::size_t k_page = 4096;

  Regions() = default;
  Regions(const Regions&) = delete;
  Regions& operator=(const Regions&) = delete;
  ~Regions();

  /// Aligned to a page; NULL where the system has no more. bytes > 0.
  void* allocate(std::size_t bytes) noexcept;
  /// bytes: as asked. False where the block is none of these.
  bool deallocate(void* block, std::size_t bytes) noexcept;

  /// Taken from the system.
  std::size_t bytes() const noexcept;

 private:
  struct Region;

  Region* add(std::uint32_t pages) noexcept;
  void trim(std::size_t most_idle) noexcept;

  mutable std::mutex mutex_;
  Region* first_ = nullptr;
};

}  // namespace radvor
