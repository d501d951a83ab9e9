// Visibility with a count: the rays of one block of receivers, and a sample of the time they take.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>

#include "base/vector.h"
#include "visibility/visibility.h"

namespace radvor {

/// What is left undone where it cannot matter; off: it is done all the same, and nothing of it counts that would not
/// have.
struct Skips {
  bool facing = true;      ///< what turns its back, or lies under the horizon
  bool negligible = true;  ///< what is worth too little against the tolerance
};

/// What was done and what was saved. Sums of integers, so the same for any number of threads; the time is not.
struct TransportCounters {
  std::uint64_t rays = 0;
  std::uint64_t idle_rays = 0;  ///< of these: cast though nothing of them counts, since a skip is off
  std::uint64_t form_factors = 0;
  std::uint64_t skipped_facing = 0;
  std::uint64_t skipped_negligible = 0;
  std::uint64_t skipped_clear = 0;
  std::uint64_t calls = 0, timed_calls = 0;  ///< of the visibility; of every 64th in a task the time is taken
  double timed_seconds = 0;

  TransportCounters& operator+=(const TransportCounters& other) {
    rays += other.rays;
    idle_rays += other.idle_rays;
    form_factors += other.form_factors;
    skipped_facing += other.skipped_facing;
    skipped_negligible += other.skipped_negligible;
    skipped_clear += other.skipped_clear;
    calls += other.calls;
    timed_calls += other.timed_calls;
    timed_seconds += other.timed_seconds;
    return *this;
  }

  /// CPU time of all calls, by those that were timed.
  double ray_seconds() const {
    return timed_calls > 0 ? timed_seconds * static_cast<double>(calls) / static_cast<double>(timed_calls) : 0;
  }
};

/// One per task; not shared between threads.
class Tracer {
 public:
  explicit Tracer(const Visibility& visibility, const Skips& on = {}) : skips(on), visibility_(visibility) {}

  void blocked_from(const Vec3& from, std::span<const Vec3> to, std::uint8_t* blocked) {
    counters.rays += to.size();
    timed([&] { visibility_.blocked_from(from, to, blocked); });
  }

  FirstHit first_hit(const Vec3& from, const Vec3& direction) {
    ++counters.rays;
    FirstHit hit;
    timed([&] { hit = visibility_.first_hit(from, direction); });
    return hit;
  }

  /// first_hit of many directions; those that follow one another lie close together.
  void first_hits(const Vec3& from, std::span<const Vec3> directions, FirstHit* hits) {
    counters.rays += directions.size();
    timed([&] { visibility_.first_hits(from, directions, hits); });
  }

  double lift() const { return visibility_.lift(); }

  const Skips skips;
  TransportCounters counters;

 private:
  static constexpr std::uint32_t k_timed = 64;

  template <class Call>
  void timed(Call&& call) {
    if (counters.calls++ % k_timed != 0) {
      call();
      return;
    }
    const auto begin = std::chrono::steady_clock::now();
    call();
    counters.timed_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ++counters.timed_calls;
  }

  const Visibility& visibility_;
};

}  // namespace radvor
