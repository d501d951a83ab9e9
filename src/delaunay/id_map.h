// Numbers for a few ids out of many, counting up from 0: a hash table with open addressing that keeps its room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace radvor::delaunay {

class IdMap {
 public:
  static constexpr std::uint32_t k_absent = UINT32_MAX;  ///< no id, no number

  explicit IdMap(std::pmr::memory_resource* memory) : slots_(memory) {}

  bool empty() const { return size_ == 0; }
  std::uint32_t size() const { return size_; }

  std::uint32_t find(std::uint32_t id) const { return size_ == 0 ? k_absent : slots_[place(id)].number; }

  /// False if it was there.
  bool add(std::uint32_t id) {
    if (2 * std::size_t{size_} >= slots_.size()) {
      grow();
    }
    Slot& slot = slots_[place(id)];
    if (slot.id == id) {
      return false;
    }
    slot = {id, size_++};
    return true;
  }

  void clear() {
    if (size_ > 0) {
      slots_.assign(slots_.size(), Slot{});
      size_ = 0;
    }
  }

 private:
  struct Slot {
    std::uint32_t id = k_absent, number = k_absent;
  };

  // Where the id is, or would be.
  std::size_t place(std::uint32_t id) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (id * 0x9e3779b97f4a7c15u >> 32) & mask;
    while (slots_[at].id != id && slots_[at].id != k_absent) {
      at = (at + 1) & mask;
    }
    return at;
  }

  void grow() {
    std::pmr::vector<Slot> old(slots_.empty() ? 16 : 4 * slots_.size(), Slot{}, slots_.get_allocator());
    slots_.swap(old);
    for (const Slot& slot : old) {
      if (slot.id != k_absent) {
        slots_[place(slot.id)] = slot;
      }
    }
  }

  std::pmr::vector<Slot> slots_;  // a power of two, at most half of it in use
  std::uint32_t size_ = 0;
};

}  // namespace radvor::delaunay
