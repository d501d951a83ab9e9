// A hash table of indices: the keys live elsewhere, in the caller's arrays, and are compared there. Open addressing
// with linear probing; nothing is ever removed.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/hash.h"

namespace radvor {

class IndexTable {
 public:
  IndexTable(std::size_t expected, std::pmr::memory_resource* memory)
      : slots_(std::bit_ceil(2 * expected + 16), Slot{0, k_free}, memory) {}

  /// The index stored before whose key equals, else `index`, which is stored. equal(i) compares the key at hand with
  /// that of index i; `hash` must be equal for equal keys.
  template <class Equal>
  std::uint32_t find_or_insert(std::uint64_t hash, std::uint32_t index, Equal&& equal) {
    Slot* slot = probe(hash, equal);
    if (slot->index != k_free) {
      return slot->index;
    }
    *slot = {hash, index};
    if (++size_ * 2 > slots_.size()) {
      grow();
    }
    return index;
  }

  /// The index stored whose key equals, or k_absent.
  template <class Equal>
  std::uint32_t find(std::uint64_t hash, Equal&& equal) const {
    return slots_[find_slot(hash, equal)].index;
  }
  static constexpr std::uint32_t k_absent = 0xffffffffu;

 private:
  static constexpr std::uint32_t k_free = k_absent;
  struct Slot {
    std::uint64_t hash;
    std::uint32_t index;
  };

  template <class Equal>
  std::size_t find_slot(std::uint64_t hash, Equal&& equal) const {
    std::size_t at = hash & (slots_.size() - 1);
    while (slots_[at].index != k_free && !(slots_[at].hash == hash && equal(slots_[at].index))) {
      at = (at + 1) & (slots_.size() - 1);
    }
    return at;
  }

  template <class Equal>
  Slot* probe(std::uint64_t hash, Equal&& equal) {
    return &slots_[find_slot(hash, equal)];
  }

  void grow() {
    std::pmr::vector<Slot> old(2 * slots_.size(), Slot{0, k_free}, slots_.get_allocator());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.index != k_free) {
        *probe(slot.hash, [](std::uint32_t) { return false; }) = slot;
      }
    }
  }

  std::pmr::vector<Slot> slots_;
  std::size_t size_ = 0;
};

/// Of an unordered pair.
inline std::uint64_t hash_pair(std::uint32_t a, std::uint32_t b) {
  return mix(a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a);
}

}  // namespace radvor
