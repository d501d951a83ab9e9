// Work that can be left off and gone on with, so that a slice of time can end in the middle of it: coroutines that name
// the places where they may pause.
//
//   Steps count(Pace& pace) {
//     for (...) {
//       ...
//       co_await pace;                // pauses here, once the time is over
//     }
//     co_await count_others(pace);    // pauses wherever that does
//     co_await pace.time_for(0.01);   // pauses here, unless there is time for what follows
//     sort();
//   }
//
// What a coroutine works on must stay until its end: it keeps references as they are given to it. Its frame lies in the
// memory of the Pace that is among its arguments.
#pragma once

#include <algorithm>
#include <cassert>
#include <chrono>
#include <coroutine>
#include <cstddef>
#include <exception>
#include <memory_resource>
#include <new>
#include <utility>

namespace radvor {

/// When work is to pause: never, until it is told.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Pace(std::pmr::memory_resource* memory) : memory_(memory) {}

  /// There is the time between the two: the end may come earlier where what is next would take too long.
  void pause_at(Clock::time_point begin, Clock::time_point end) {
    begin_ = begin;
    end_ = end;
    pauses_ = true;
    ends_early_ = false;
  }
  void pause_no_more() { pauses_ = ends_early_ = false; }

  bool pauses() const { return pauses_; }
  bool is_over() const { return ends_early_ || (pauses_ && Clock::now() >= end_); }
  std::pmr::memory_resource* memory() const { return memory_; }

  struct TimeFor {
    Pace& pace;
    double seconds;
  };
  /// To be awaited before work of about so long that can't be left off: pauses where an eighth of the time is spent and
  /// the work would end later than it by more than a quarter. What takes longer than the whole time is not cut short.
  TimeFor time_for(double seconds) { return {*this, seconds}; }

 private:
  friend class Steps;
  using Seconds = std::chrono::duration<double>;

  bool has_time_for(double seconds) {
    if (pauses_ && !ends_early_) {
      const Clock::time_point now = Clock::now();
      const double all = Seconds(end_ - begin_).count();
      ends_early_ = Seconds(now - begin_).count() > all / 8 && seconds > Seconds(end_ - now).count() + all / 4;
    }
    return !is_over();
  }

  std::pmr::memory_resource* memory_;
  Clock::time_point begin_, end_;
  bool pauses_ = false, ends_early_ = false;
};

class [[nodiscard]] Steps {
 public:
  struct promise_type;

  /// Nothing to do.
  Steps() = default;
  Steps(Steps&& other) noexcept : work_(std::exchange(other.work_, nullptr)) {}
  Steps& operator=(Steps&& other) noexcept {
    std::swap(work_, other.work_);
    return *this;
  }
  ~Steps() {
    if (work_) {
      work_.destroy();
    }
  }

  bool is_done() const { return !work_ || work_.done(); }

  /// Begins or goes on: true where it pauses, false at the end. What the work throws ends it, and comes out here.
  bool go_on();

  void finish() {
    while (go_on()) {
    }
  }

 private:
  using Work = std::coroutine_handle<promise_type>;

  // Of a coroutine: its object or one of its arguments, which may be the Pace.
  struct Argument {
    Argument() : pace(nullptr) {}
    Argument(const Pace& given) : pace(&given) {}
    template <class Other>
    Argument(const Other&) : pace(nullptr) {}

    const Pace* pace;
  };

  explicit Steps(Work work) : work_(work) {}

  Work work_ = nullptr;
};

struct Steps::promise_type {
  // Other work that this one waits for, where it lies in the frame of this one.
  struct Awaited {
    Steps steps;
    promise_type& by;

    bool await_ready() { return !steps.go_on(); }
    void await_suspend(std::coroutine_handle<>) { by.awaited = &steps; }
    void await_resume() {
      if (by.failure) {
        std::rethrow_exception(std::exchange(by.failure, nullptr));
      }
    }
  };
  struct Pause {
    bool goes_on;

    bool await_ready() const { return goes_on; }
    void await_suspend(std::coroutine_handle<>) const {}
    void await_resume() const {}
  };

  Steps get_return_object() { return Steps(Work::from_promise(*this)); }
  std::suspend_always initial_suspend() const noexcept { return {}; }
  std::suspend_always final_suspend() const noexcept { return {}; }
  void return_void() const {}
  void unhandled_exception() { failure = std::current_exception(); }
  Awaited await_transform(Steps&& steps) { return {std::move(steps), *this}; }
  Pause await_transform(const Pace& pace) { return {!pace.is_over()}; }
  Pause await_transform(const Pace::TimeFor& work) { return {work.pace.has_time_for(work.seconds)}; }

  // No template of any arguments: gcc 12 would take it for one that operator delete does not belong to.
  static void* operator new (std::size_t size, Argument a, Argument b = {}, Argument c = {}, Argument d = {},
                             Argument e = {}, Argument f = {}, Argument g = {}, Argument h = {}) {
    std::pmr::memory_resource* memory = nullptr;
    for (const Argument& argument : {a, b, c, d, e, f, g, h}) {
      memory = argument.pace ? argument.pace->memory() : memory;
    }
    assert(memory);  // one of the arguments must be a Pace
    auto* head = static_cast<Head*>(memory->allocate(sizeof(Head) + size, alignof(Head)));
    head->memory = memory;
    return head + 1;
  }
  static void operator delete(void* frame, std::size_t size) {
    auto* head = static_cast<Head*>(frame) - 1;
    head->memory->deallocate(head, sizeof(Head) + size, alignof(Head));
  }

  Steps* awaited = nullptr;
  std::exception_ptr failure;

 private:
  struct alignas(std::max_align_t) Head {
    std::pmr::memory_resource* memory;
  };
};

// As deep as the work waits for other work, which is written down, not given.
inline bool Steps::go_on() {  // NOLINT(misc-no-recursion)
  if (is_done()) {
    return false;
  }
  promise_type& promise = work_.promise();
  if (promise.awaited) {
    try {
      if (promise.awaited->go_on()) {
        return true;
      }
    } catch (...) {  // it is thrown where the work waits
      promise.failure = std::current_exception();
    }
    promise.awaited = nullptr;
  }
  work_.resume();
  if (!work_.done()) {
    return true;
  }
  if (promise.failure) {
    std::rethrow_exception(std::exchange(promise.failure, nullptr));
  }
  return false;
}

/// function(begin, end) for all of 0 to count: at once or, where it may pause, for a portion after the other.
template <class Function>
Steps in_portions(std::size_t count, std::size_t portion, Function& function, Pace& pace) {
  for (std::size_t begin = 0; begin < count;) {
    const std::size_t end = pace.pauses() ? std::min(count, begin + portion) : count;
    function(begin, end);
    begin = end;
    co_await pace;
  }
}

}  // namespace radvor
