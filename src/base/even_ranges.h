// Ranges of things of different weight (facets), each about as heavy as a task should be. Where that is much work the
// heaviest run first, so that no thread begins with the largest facet when the others are done.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <vector>

#include "base/jobs.h"
#include "base/steps.h"

namespace radvor {

class EvenRanges {
 public:
  /// Of 0 to count. weight_of(k) >= 0; a range ends with the thing that brings it to `weight` or beyond.
  template <class WeightOf>
  EvenRanges(std::size_t count, double weight, WeightOf&& weight_of, std::pmr::memory_resource* memory)
      : ranges_(memory) {
    Range range{0, 0, 0};
    for (std::uint32_t k = 0; k < count; ++k) {
      range.weight += weight_of(k);
      range.end = k + 1;
      if (range.weight >= weight || range.end == count) {
        ranges_.push_back(range);
        range = {range.end, range.end, 0};
      }
    }
  }

  double heaviest() const {
    double weight = 0;
    for (const Range& range : ranges_) {
      weight = std::max(weight, range.weight);
    }
    return weight;
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(ranges_.size()); }

  /// function(range, begin, end) for each, by its number from the first on.
  template <class Function>
  void for_each(const Jobs& jobs, Function&& function) const {
    const auto order = by_weight();
    jobs.for_each(size(), [&](std::uint32_t k) { function(order[k], ranges_[order[k]].begin, ranges_[order[k]].end); });
  }

  /// The same, which may pause between some of them and others.
  template <class Function>
  Steps for_each(const Jobs& jobs, Function& function, Pace& pace) const {
    const auto order = by_weight();
    const auto run = [&](std::size_t first, std::size_t last) {
      jobs.for_each(static_cast<std::uint32_t>(last - first), [&](std::uint32_t k) {
        const Range& range = ranges_[order[first + k]];
        function(order[first + k], range.begin, range.end);
      });
    };
    co_await in_portions(size(), k_at_once * jobs.thread_count(), run, pace);
  }

  /// The same in no order, for tasks beside each other that touch memory beside each other (Jobs::for_each_in_parts).
  template <class Function>
  void for_each_in_parts(const Jobs& jobs, Function&& function) const {
    jobs.for_each_in_parts(size(), [&](std::uint32_t k) { function(k, ranges_[k].begin, ranges_[k].end); });
  }

 private:
  static constexpr std::uint32_t k_at_once = 4;  // a thread

  struct Range {
    std::uint32_t begin, end;
    double weight;
  };

  // The heaviest first.
  std::pmr::vector<std::uint32_t> by_weight() const {
    std::pmr::vector<std::uint32_t> order(ranges_.size(), ranges_.get_allocator());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return ranges_[a].weight != ranges_[b].weight ? ranges_[a].weight > ranges_[b].weight : a < b;
    });
    return order;
  }

  std::pmr::vector<Range> ranges_;
};

}  // namespace radvor
