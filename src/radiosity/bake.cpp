// What the API holds: a solver on the host's memory, and time slices.
#include "radiosity/bake.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

struct Bake::State : Solver {
  using Solver::Solver;
  bool broken = false;  // a step threw

  void require_whole() const {
    if (broken) {
      throw Error(ErrorCode::out_of_memory, "the solution broke off when memory ran out: it can only be destroyed");
    }
  }
};

Bake::Bake(Scene scene, const BakeOptions& options, const VisibilityMaker& visibility, Host& host) {
  void* storage = host.memory.allocate(sizeof(State), alignof(State));
  try {
    state_ = new (storage) State(std::move(scene), options, visibility, host);
  } catch (...) {
    host.memory.deallocate(storage, sizeof(State), alignof(State));
    throw;
  }
}

Bake::~Bake() {
  Host& lender = state_->host;
  state_->~State();
  lender.memory.deallocate(state_, sizeof(State), alignof(State));
}

BakeStatus Bake::advance(double seconds, const ProgressCallback& callback) {
  state_->require_whole();
  const Clock::time_point begin = Clock::now();
  const double before = state_->seconds;
  BakeStatus status = BakeStatus::converged;
  state_->show_no_more();
  const double limit = state_->options.max_seconds;
  if (seconds > 0 || limit > 0) {
    constexpr double k_no_end = 1e9;
    const double slice = seconds > 0 ? std::min(seconds, k_no_end) : k_no_end;
    const double left = limit > 0 ? std::max(0.0, limit - before) : k_no_end;
    const std::chrono::duration<double> given(std::min(slice, left));
    state_->slice.pause_at(begin, begin + std::chrono::duration_cast<Clock::duration>(given));
  } else {
    state_->slice.pause_no_more();
  }
  bool moved = false;  // every slice does a unit of work, however short it is: a sequence of them comes to its end
  while (state_->stage() != Solver::Stage::done) {
    const Clock::time_point unit = Clock::now();
    const bool on_direct = !state_->looks_around();
    if (callback.call && callback.call(callback.user, progress())) {
      status = BakeStatus::cancelled;
      break;
    }
    const double spent = seconds_since(begin);
    if ((moved && state_->slice.is_over()) ||
        (state_->options.max_seconds > 0 && before + spent >= state_->options.max_seconds)) {
      status = BakeStatus::time_spent;
      break;
    }
    state_->broken = true;  // until the step is done
    if (seconds > 0 && state_->guesses()) {
      state_->guess();
    } else {
      state_->step();
    }
    state_->broken = false;
    moved = true;
    (on_direct ? state_->seconds_direct : state_->seconds_indirect) += seconds_since(unit);
    state_->seconds = before + seconds_since(begin);
  }
  if (status != BakeStatus::converged) {
    state_->show();
  }
  if (status == BakeStatus::converged && callback.call) {
    callback.call(callback.user, progress());
  }
  return status;
}

const Scene& Bake::scene() const {
  return state_->scene;
}
const WeldedScene& Bake::welded() const {
  return *state_->welded;
}
const Facets& Bake::facets() const {
  return *state_->facets;
}
const Surface& Bake::surface() const {
  state_->require_whole();
  return *state_->surface;
}
const BakeOptions& Bake::options() const {
  return state_->options;
}
Host& Bake::host() const {
  return state_->host;
}
std::span<const Color> Bake::direct() const {
  state_->require_whole();
  return state_->direct_meanwhile();
}
std::span<const Color> Bake::indirect() const {
  state_->require_whole();
  return state_->indirect;
}
std::span<const Color> Bake::fit() const {
  state_->require_whole();
  return state_->fit;
}

BakeProgress Bake::progress() const {
  const BakeStats& counters = state_->counters();
  return {static_cast<std::uint32_t>(state_->surface->sites().size()), counters.shots, counters.rays, state_->seconds,
          state_->converged};
}

BakeStats Bake::stats() const {
  state_->require_whole();
  return state_->stats();
}

}  // namespace radvor
