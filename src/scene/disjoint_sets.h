// Disjoint sets with path halving (Tarjan & van Leeuwen 1984); the smallest member represents a set, so that the
// result does not depend on the order of the unions.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <vector>

namespace radvor {

class DisjointSets {
 public:
  DisjointSets(std::uint32_t count, std::pmr::memory_resource* memory) : parents_(count, memory) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  /// Whether it is the smallest of its set.
  bool is_first(std::uint32_t member) const { return parents_[member] == member; }

  std::uint32_t find(std::uint32_t member) {
    while (parents_[member] != member) {
      parents_[member] = parents_[parents_[member]];
      member = parents_[member];
    }
    return member;
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) {
      parents_[b] = a;
    } else {
      parents_[a] = b;
    }
  }

 private:
  std::pmr::vector<std::uint32_t> parents_;
};

}  // namespace radvor
