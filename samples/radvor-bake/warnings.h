// Warnings about input files: the first few in words, the rest as a number, so that a broken scene of a million
// faces does not bury what matters.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace bake {

class Warnings {
 public:
  static constexpr std::size_t k_spelled_out = 20;

  void add(std::string words) {
    ++count_;
    if (words_.size() < k_spelled_out) {
      words_.push_back(std::move(words));
    }
  }

  const std::vector<std::string>& words() const noexcept { return words_; }
  std::size_t count() const noexcept { return count_; }

 private:
  std::vector<std::string> words_;
  std::size_t count_ = 0;
};

}  // namespace bake
