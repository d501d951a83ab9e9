// A loop's tasks in parts, one a thread. A thread takes its own part's from the first on; when that is done it helps,
// from the end of the part that most is left of, which is the farthest from where its own thread is.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace radvor {

class TaskParts {
 public:
  /// threads: 1 and more; those beyond k_most share parts.
  TaskParts(std::uint32_t tasks, std::uint32_t threads) : count_(std::min(threads, k_most)) {
    const auto begin_of = [&](std::uint64_t part) { return static_cast<std::uint32_t>(tasks * part / count_); };
    for (std::uint32_t part = 0; part < count_; ++part) {
      parts_[part].left.store(packed({begin_of(part), begin_of(part + 1)}), std::memory_order_relaxed);
    }
  }

  /// Calls run(index), each thread by its number, until no task is left that none has begun: all together each once.
  template <class Run>
  void work(std::uint32_t thread, Run&& run) {
    const std::uint32_t own = thread % count_;
    for (std::uint32_t index = take_first(own); index != k_nothing; index = take_first(own)) {
      run(index);
    }
    for (std::uint32_t fullest = find_fullest(); fullest != k_nothing; fullest = find_fullest()) {
      if (const std::uint32_t index = take_last(fullest); index != k_nothing) {
        run(index);
      }
    }
  }

 private:
  static constexpr std::uint32_t k_most = 64;
  static constexpr std::uint32_t k_nothing = 0xffffffffu;
  struct Range {
    std::uint32_t begin, end;  // the former only rises, the latter only falls
  };
  struct alignas(128) Part {
    std::atomic<std::uint64_t> left;  // a Range
  };

  static std::uint64_t packed(const Range& range) { return std::uint64_t{range.begin} << 32 | range.end; }
  static Range unpacked(std::uint64_t left) {
    return {static_cast<std::uint32_t>(left >> 32), static_cast<std::uint32_t>(left)};
  }

  std::uint32_t take_first(std::uint32_t part) {
    return take(part, [](Range& left) { return left.begin++; });
  }
  std::uint32_t take_last(std::uint32_t part) {
    return take(part, [](Range& left) { return --left.end; });
  }

  template <class Shorten>
  std::uint32_t take(std::uint32_t part, Shorten&& shorten) {
    std::uint64_t known = parts_[part].left.load(std::memory_order_relaxed);
    for (Range left = unpacked(known); left.begin < left.end; left = unpacked(known)) {
      const std::uint32_t index = shorten(left);
      if (parts_[part].left.compare_exchange_weak(known, packed(left), std::memory_order_relaxed)) {
        return index;
      }
    }
    return k_nothing;
  }

  std::uint32_t find_fullest() const {
    std::uint32_t fullest = k_nothing, most = 0;
    for (std::uint32_t part = 0; part < count_; ++part) {
      const Range left = unpacked(parts_[part].left.load(std::memory_order_relaxed));
      if (left.end - left.begin > most) {
        most = left.end - left.begin;
        fullest = part;
      }
    }
    return fullest;
  }

  std::uint32_t count_;
  std::array<Part, k_most> parts_;
};

}  // namespace radvor
