#include "base/regions.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace radvor {

namespace {

constexpr std::size_t k_large_page = std::size_t{2} << 20;
constexpr std::size_t k_region = std::size_t{64} << 20;  // bytes, unless one block is larger
constexpr std::size_t k_idle = 8;                        // of what is in use, this part may lie idle beside it

// Bytes of a block: page numbers have 32 bits, and there is no more memory.
constexpr std::size_t k_most =
    std::min<std::uint64_t>(std::uint64_t{1} << 42, std::numeric_limits<std::size_t>::max() / 4);

std::byte* take_from_system([[maybe_unused]] std::size_t bytes) noexcept {
#ifdef __linux__
  // A large page more, to begin at the first one's bounds.
  void* const taken = mmap(nullptr, bytes + k_large_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (taken == MAP_FAILED) {
    return nullptr;
  }
  auto* const begin = static_cast<std::byte*>(taken);
  const std::size_t before = (k_large_page - reinterpret_cast<std::uintptr_t>(taken) % k_large_page) % k_large_page;
  if (before > 0) {
    munmap(begin, before);
  }
  munmap(begin + before + bytes, k_large_page - before);
  madvise(begin + before, bytes, MADV_HUGEPAGE);  // where it is refused pages stay small
  return begin + before;
#else
  return nullptr;
#endif
}

void give_to_system([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) noexcept {
#ifdef __linux__
  munmap(begin, bytes);
#endif
}

constexpr std::size_t pages_of(std::size_t bytes) {
  return (bytes + Regions::k_page - 1) / Regions::k_page;
}

// One of eight sizes up to the double: an array that is made anew a little larger fits where the last one lay. What is
// added is mostly never touched.
constexpr std::size_t pages_of_block(std::size_t bytes) {
  const std::size_t pages = pages_of(std::max(bytes, Regions::k_least));
  const std::size_t step = std::max<std::size_t>(1, std::bit_floor(pages) / 8);
  return (pages + step - 1) / step * step;
}

struct Hole {
  std::uint32_t first, count;  // pages of the region
};

// Between two holes lies a block of k_least at least, so there are never more of them than this.
constexpr std::size_t most_holes(std::size_t pages) {
  return pages / (Regions::k_least / Regions::k_page) + 2;
}

}  // namespace

// Lies at its own beginning, with its holes, ascending, behind it: giving a block back needs no memory.
struct Regions::Region {
  Region* next;
  std::uint32_t page_count, hole_count, used;  // the latter in pages, this head's included
  std::uint32_t widest;                        // no hole has more pages

  static std::size_t head(std::size_t pages) { return pages_of(sizeof(Region) + most_holes(pages) * sizeof(Hole)); }

  std::byte* begin() { return reinterpret_cast<std::byte*>(this); }
  Hole* holes() { return reinterpret_cast<Hole*>(this + 1); }
  bool is_empty() const { return used == head(page_count); }

  void* take(Hole& hole, std::uint32_t pages) {
    std::byte* const block = begin() + std::size_t{hole.first} * k_page;
    used += pages;
    hole.first += pages;
    hole.count -= pages;
    if (hole.count == 0) {
      erase(&hole);
    }
    return block;
  }

  void give_back(std::uint32_t first, std::uint32_t pages) {
    used -= pages;
    Hole* const end = holes() + hole_count;
    Hole* const after =
        std::lower_bound(holes(), end, first, [](const Hole& hole, std::uint32_t page) { return hole.first < page; });
    const bool joins_after = after != end && after->first == first + pages;
    const bool joins_before = after != holes() && (after - 1)->first + (after - 1)->count == first;
    if (joins_before) {
      (after - 1)->count += pages + (joins_after ? after->count : 0);
      widest = std::max(widest, (after - 1)->count);
      if (joins_after) {
        erase(after);
      }
      return;
    }
    if (joins_after) {
      *after = {first, after->count + pages};
    } else {
      std::copy_backward(after, end, end + 1);
      *after = {first, pages};
      ++hole_count;
    }
    widest = std::max(widest, after->count);
  }

 private:
  void erase(Hole* hole) {
    std::copy(hole + 1, holes() + hole_count, hole);
    --hole_count;
  }
};

Regions::~Regions() {
  while (first_ != nullptr) {
    Region* const region = std::exchange(first_, first_->next);
    give_to_system(region, std::size_t{region->page_count} * k_page);
  }
}

std::size_t Regions::bytes() const noexcept {
  const std::lock_guard lock(mutex_);
  std::size_t sum = 0;
  for (const Region* region = first_; region != nullptr; region = region->next) {
    sum += std::size_t{region->page_count} * k_page;
  }
  return sum;
}

// With room for a block of so many pages.
Regions::Region* Regions::add(std::uint32_t pages) noexcept {
  const std::size_t with_head = (pages + Region::head(2 * std::size_t{pages})) * k_page;
  const std::size_t bytes = std::max(k_region, (with_head + k_large_page - 1) / k_large_page * k_large_page);
  std::byte* begin = take_from_system(bytes);
  if (begin == nullptr) {
    trim(0);
    begin = take_from_system(bytes);
  }
  if (begin == nullptr) {
    return nullptr;
  }
  const auto count = static_cast<std::uint32_t>(bytes / k_page);
  const auto head = static_cast<std::uint32_t>(Region::head(count));
  auto* const region = ::new (static_cast<void*>(begin)) Region{first_, count, 1, head, count - head};
  std::construct_at(region->holes(), Hole{head, count - head});
  first_ = region;
  return region;
}

// The smallest hole that will do, so that large ones stay.
void* Regions::allocate(std::size_t bytes) noexcept {
  if (bytes > k_most) {
    return nullptr;
  }
  const auto pages = static_cast<std::uint32_t>(pages_of_block(bytes));
  const std::lock_guard lock(mutex_);
  Region* best = nullptr;
  Hole* best_hole = nullptr;
  for (Region* region = first_; region != nullptr; region = region->next) {
    if (region->widest < pages) {
      continue;
    }
    region->widest = 0;
    for (Hole* hole = region->holes(); hole != region->holes() + region->hole_count; ++hole) {
      region->widest = std::max(region->widest, hole->count);
      if (hole->count >= pages && (best_hole == nullptr || hole->count < best_hole->count)) {
        best = region;
        best_hole = hole;
      }
    }
  }
  if (best == nullptr) {
    best = add(pages);
    best_hole = best != nullptr ? best->holes() : nullptr;
  }
  return best != nullptr ? best->take(*best_hole, pages) : nullptr;
}

bool Regions::deallocate(void* block, std::size_t bytes) noexcept {
  auto* const begin = static_cast<std::byte*>(block);
  const std::lock_guard lock(mutex_);
  for (Region* region = first_; region != nullptr; region = region->next) {
    if (begin > region->begin() && begin < region->begin() + std::size_t{region->page_count} * k_page) {
      const std::size_t page = static_cast<std::size_t>(begin - region->begin()) / k_page;
      region->give_back(static_cast<std::uint32_t>(page), static_cast<std::uint32_t>(pages_of_block(bytes)));
      if (region->is_empty()) {
        std::size_t used = 0;
        for (const Region* each = first_; each != nullptr; each = each->next) {
          used += each->is_empty() ? 0 : std::size_t{each->used} * k_page;
        }
        trim(std::max(used / k_idle, k_region));
      }
      return true;
    }
  }
  return false;
}

// What is kept for later is no more than so many bytes of empty regions.
void Regions::trim(std::size_t most_idle) noexcept {
  std::size_t idle = 0;
  for (Region** at = &first_; *at != nullptr;) {
    Region* const region = *at;
    const std::size_t bytes = std::size_t{region->page_count} * k_page;
    if (!region->is_empty()) {
      at = &region->next;
    } else if (idle + bytes <= most_idle) {
      idle += bytes;
      at = &region->next;
    } else {
      *at = region->next;
      give_to_system(region, bytes);
    }
  }
}

}  // namespace radvor
