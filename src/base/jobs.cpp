#include "base/jobs.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

#include "base/floating_point.h"
#include "base/task_parts.h"

namespace radvor {

struct Jobs::Arena {
  // No more than the process may have: TBB would ignore the rest, and say so on the host's stderr.
  explicit Arena(std::size_t threads)
      : arena(static_cast<int>(
            std::min(threads, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)))) {}
  tbb::task_arena arena;
};

namespace {

// One loop's tasks with the exception of the lowest index that threw.
struct Loop {
  Jobs::Task task;
  void* data;
  std::mutex mutex;
  std::exception_ptr exception;
  std::uint32_t exception_index = 0;

  void run(std::uint32_t index) noexcept {
    const FloatingPointGuard guard(Denormals::flush);
    try {
      task(data, index);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!exception || index < exception_index) {
        exception = std::current_exception();
        exception_index = index;
      }
    }
  }
};

}  // namespace

Jobs::Jobs(std::uint32_t thread_count, HostParallelFor parallel_for, void* user, std::pmr::memory_resource* memory)
    : thread_count_(thread_count), host_(parallel_for), user_(user), memory_(memory) {
  if (thread_count_ == 0) {
    thread_count_ = std::max(1u, std::thread::hardware_concurrency());
  }
  if (!host_) {
    void* storage = memory_->allocate(sizeof(Arena), alignof(Arena));
    try {
      arena_ = new (storage) Arena(thread_count_);
    } catch (...) {
      memory_->deallocate(storage, sizeof(Arena), alignof(Arena));
      throw;
    }
  }
}

Jobs::~Jobs() {
  if (arena_) {
    arena_->~Arena();
    memory_->deallocate(arena_, sizeof(Arena), alignof(Arena));
  }
}

void Jobs::run(std::uint32_t count, Task task, void* data, Order order) const {
  Loop loop{task, data, {}, nullptr, 0};
  if (host_) {
    host_(
        user_, count, [](void* pointer, std::uint32_t index) { static_cast<Loop*>(pointer)->run(index); }, &loop);
  } else if (thread_count_ == 1 || count <= 1) {
    for (std::uint32_t index = 0; index < count; ++index) {
      loop.run(index);
    }
  } else {
    const std::uint32_t threads = std::min(count, thread_count_);
    const auto on_all = [&](auto&& work) {
      arena_->arena.execute([&] { tbb::parallel_for(0u, threads, work, tbb::simple_partitioner()); });
    };
    if (order == Order::in_parts) {
      TaskParts parts(count, threads);
      on_all([&](std::uint32_t) {  // a thread keeps its index from loop to loop, for as long as it stays in the arena
        const auto thread = static_cast<std::uint32_t>(tbb::this_task_arena::current_thread_index());
        parts.work(thread, [&](std::uint32_t index) { loop.run(index); });
      });
    } else {
      std::atomic<std::uint32_t> next{0};
      on_all([&](std::uint32_t) {
        for (std::uint32_t index = next++; index < count; index = next++) {
          loop.run(index);
        }
      });
    }
  }
  if (loop.exception) {
    std::rethrow_exception(loop.exception);
  }
}

void Jobs::run_alone(Task task, void* data) const {
  tbb::task_arena single(1, 1);
  single.execute([&] { task(data, 0); });
}

void Jobs::run_in_arena(Task task, void* data) const {
  if (host_) {
    run_alone(task, data);
  } else {
    arena_->arena.execute([&] { task(data, 0); });
  }
}

}  // namespace radvor
