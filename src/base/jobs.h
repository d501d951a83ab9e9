// Loops over many cores: oneTBB in an arena of radvor's own, or the host's parallel_for where it lends one.
// What runs is the same for any number of threads, and so are the bytes that come out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <type_traits>

namespace radvor {

class Jobs {
 public:
  using Task = void (*)(void* data, std::uint32_t index);
  using HostParallelFor = void (*)(void* user, std::uint32_t count, Task task, void* data);

  /// thread_count 0: all cores. With a host parallel_for no thread is ever made here.
  Jobs(std::uint32_t thread_count, HostParallelFor parallel_for, void* user, std::pmr::memory_resource* memory);
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  std::uint32_t thread_count() const noexcept { return thread_count_; }
  bool lent_by_host() const noexcept { return host_ != nullptr; }

  /// Calls function(index) once for each index < count, begun in that order by radvor's own threads, in any by the
  /// host's, and returns when all have run. Every task runs with round-to-nearest and denormals flushed. What tasks
  /// throw reaches the caller: that of the lowest index, so that errors too are the same for any number of threads.
  template <class Function>
  void for_each(std::uint32_t count, Function&& function) const {
    run(count, function, Order::ascending);
  }

  /// The same, but each of radvor's own threads begins with a part of its own, and helps out in the others' when it is
  /// done: for tasks beside each other that touch memory beside each other. What a thread has written in one loop it
  /// mostly reads itself in the next, and not from another core.
  template <class Function>
  void for_each_in_parts(std::uint32_t count, Function&& function) const {
    run(count, function, Order::in_parts);
  }

  /// Calls function(begin, end) for ranges of at most `size` that together are 0 to count.
  template <class Function>
  void for_ranges(std::size_t count, std::size_t size, Function&& function) const {
    for_each_in_parts(static_cast<std::uint32_t>((count + size - 1) / size),
                      [&](std::uint32_t range) { function(range * size, std::min(count, (range + 1) * size)); });
  }

  /// Runs function on one thread in an arena of that one thread: for libraries that bring their own parallelism
  /// (Embree's build) where the host lends its threads.
  template <class Function>
  void alone(Function&& function) const {
    using Plain = std::remove_reference_t<Function>;
    run_alone([](void* data, std::uint32_t) { (*static_cast<Plain*>(data))(); },
              const_cast<void*>(static_cast<const void*>(&function)));
  }

  /// Runs function in radvor's own arena (the host's threads: alone), so that libraries built on TBB keep to it.
  template <class Function>
  void in_arena(Function&& function) const {
    using Plain = std::remove_reference_t<Function>;
    run_in_arena([](void* data, std::uint32_t) { (*static_cast<Plain*>(data))(); },
                 const_cast<void*>(static_cast<const void*>(&function)));
  }

 private:
  struct Arena;
  enum class Order { ascending, in_parts };

  template <class Function>
  void run(std::uint32_t count, Function& function, Order order) const {
    run(
        count, [](void* data, std::uint32_t index) { (*static_cast<Function*>(data))(index); },
        const_cast<void*>(static_cast<const void*>(&function)), order);
  }
  void run(std::uint32_t count, Task task, void* data, Order order) const;
  void run_alone(Task task, void* data) const;
  void run_in_arena(Task task, void* data) const;

  std::uint32_t thread_count_;
  HostParallelFor host_;
  void* user_;
  std::pmr::memory_resource* memory_;
  Arena* arena_ = nullptr;
};

}  // namespace radvor
