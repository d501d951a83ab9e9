// How many bytes are held, counted by many threads at once. One counter for all would be fetched from core to core with
// every block that a task takes: building meshes on two cores took up to a tenth longer for it (by hand). So threads
// add up what they take and give back, and tell the others once it matters.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace radvor {

class ByteCount {
 public:
  /// bytes < 0: given back. Any thread may call it.
  void add(std::int64_t bytes) noexcept {
    std::atomic<std::int64_t>& untold = stripes_[stripe_of_thread()].untold;
    const std::int64_t sum = untold.fetch_add(bytes, std::memory_order_relaxed) + bytes;
    if (std::abs(sum) * k_matters > told_.load(std::memory_order_relaxed)) {
      tell(untold.exchange(0, std::memory_order_relaxed));
    }
  }

  /// Exact while nobody adds; meanwhile it may miss what is being told.
  std::uint64_t live() const noexcept {
    std::int64_t sum = told_.load(std::memory_order_relaxed);
    for (const Stripe& stripe : stripes_) {
      sum += stripe.untold.load(std::memory_order_relaxed);
    }
    return static_cast<std::uint64_t>(std::max<std::int64_t>(0, sum));
  }

  /// The most that there was, to 1 / 256 of it for each thread, of up to k_stripes.
  std::uint64_t peak() const noexcept {
    return std::max(live(), static_cast<std::uint64_t>(peak_.load(std::memory_order_relaxed)));
  }

 private:
  static constexpr std::int64_t k_matters = 256;
  static constexpr std::uint32_t k_stripes = 32;
  static constexpr std::size_t k_apart = 128;  // two cache lines: processors fetch them in pairs

  struct alignas(k_apart) Stripe {
    std::atomic<std::int64_t> untold{0};
  };

  static std::uint32_t stripe_of_thread() noexcept {
    static std::atomic<std::uint32_t> threads{0};
    thread_local const std::uint32_t number = threads.fetch_add(1, std::memory_order_relaxed);
    return number % k_stripes;
  }

  void tell(std::int64_t bytes) noexcept {
    const std::int64_t live = told_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
    std::int64_t peak = peak_.load(std::memory_order_relaxed);
    while (live > peak && !peak_.compare_exchange_weak(peak, live, std::memory_order_relaxed)) {
    }
  }

  std::array<Stripe, k_stripes> stripes_;
  alignas(k_apart) std::atomic<std::int64_t> told_{0};
  std::atomic<std::int64_t> peak_{0};
};

}  // namespace radvor
