// What a bake shows between slices of time: the light that is there, and a guess at what is still to come to some
// samples. What is shown goes nowhere: slices or none, a bake ends the same.
#include <algorithm>
#include <new>
#include <span>

#include "radiosity/light_guess.h"
#include "radiosity/method.h"
#include "radiosity/solver.h"

namespace radvor {

bool Solver::guesses() const {
  const bool first = stage_ == Stage::direct && !looking_ && round_ == 0;
  return may_guess_ && first && source_ < light_->source_count() && guessed_blocks_ < 2 * blocks_->count();
}

// Corners come first, all over the scene, since they are what engines ask for; then, all blocks once more, the rest.
template <class Function>
void Solver::for_each_to_guess(std::uint32_t block, Function&& function) const {
  const auto samples = surface->samples();
  const auto sites = surface->sites();
  const bool corners = block < blocks_->count();
  for (const std::uint32_t sample : blocks_->block(corners ? block : block - blocks_->count())) {
    if ((sites[samples[sample].site].vertex != k_none) == corners) {
      function(sample);
    }
  }
}

void Solver::guess() {
  try {
    guessed_.resize(direct.size(), Color(0.0));
    const std::uint32_t begin = guessed_blocks_;
    const std::uint32_t end = std::min(2 * blocks_->count(), begin + 4 * host.jobs.thread_count());
    host.jobs.for_each(end - begin, [&](std::uint32_t index) {
      Tracer tracer(*visibility_);
      LightGuess guess(*light_, &host.memory);
      for_each_to_guess(begin + index,
                        [&](std::uint32_t sample) { guessed_[sample] = guess.at(receivers_[sample], tracer); });
    });
    guessed_blocks_ = end;
  } catch (const std::bad_alloc&) {  // it is for show alone
    may_guess_ = false;
  }
}

void Solver::show() {
  try {
    shown_.assign(direct.begin(), direct.end());
  } catch (const std::bad_alloc&) {  // what there is for certain will do
    shown_.clear();
    return;
  }
  const Color sky = k_pi * light_->sky_radiance();
  const auto add_sky = [&](std::uint32_t i) {
    shown_[i] += (known_[i] != 0 ? outlooks_[i].open : double{glimpsed_[i]}) * sky;
  };
  const bool shines = stage_ == Stage::direct && source_ < light_->source_count();
  for (const DueAgain& due : due_again_) {
    if (shines) {
      shown_[due.sample] = due.before;
    }
  }
  if (shines && !looking_ && round_ == 0) {
    for (std::uint32_t block = 0; block < guessed_blocks_; ++block) {
      for_each_to_guess(block, [&](std::uint32_t sample) { shown_[sample] = guessed_[sample]; });
    }
  }
  if (!looking_) {
    for (std::uint32_t i = 0; i < shown_.size(); ++i) {
      add_sky(i);
    }
  } else if (stage_ == Stage::direct || stage_ == Stage::hemispheres) {
    for (const std::uint32_t i : pending_) {
      add_sky(i);
    }
  }
  // New samples, until all sources have shone on them, show the light of those that they lie between.
  for (std::size_t n = 0; shines && n < pending_.size(); ++n) {
    const SampleOrigin& anchor = anchors_[pending_[n]];
    if (anchor.samples[0] != k_none) {
      Color between(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        between += static_cast<double>(anchor.weights[k]) * shown_[anchor.samples[k]];
      }
      shown_[pending_[n]] = between;
    }
  }
}

void Solver::show_no_more() {
  shown_ = std::pmr::vector<Color>(&host.memory);
}

std::span<const Color> Solver::direct_meanwhile() const {
  return shown_.empty() ? std::span<const Color>(direct) : shown_;
}

}  // namespace radvor
