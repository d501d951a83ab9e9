// What a bake shows between slices of time: the light that is there, and a guess at what is still to come to some
// samples. What is shown goes nowhere: slices or none, a bake ends the same.
#include <span>

#include "radiosity/method.h"
#include "radiosity/solver.h"

namespace radvor {

// New samples, until their own light is there, show that of those that they lie between.
void Solver::show() {
  const Color sky = k_pi * light_->sky_radiance();
  shown_.assign(direct.begin(), direct.end());
  const bool shines = stage_ == Stage::direct, looks = stage_ == Stage::hemispheres;
  const auto add_sky = [&](std::uint32_t i) {
    shown_[i] += (known_[i] != 0 ? outlooks_[i].open : double{glimpsed_[i]}) * sky;
  };
  if (!looking_) {
    for (std::uint32_t i = 0; i < shown_.size(); ++i) {
      add_sky(i);
    }
  } else if (shines || looks) {
    for (const std::uint32_t i : pending_) {
      add_sky(i);
    }
  }
  if (shines && round_ > 0) {
    for (const std::uint32_t i : pending_) {
      const SampleOrigin& anchor = anchors_[i];
      if (anchor.samples[0] == k_none) {
        continue;
      }
      shown_[i] = Color(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        shown_[i] += static_cast<double>(anchor.weights[k]) * shown_[anchor.samples[k]];
      }
    }
  }
}

std::span<const Color> Solver::direct_meanwhile() const {
  return shown_.empty() ? std::span<const Color>(direct) : shown_;
}

}  // namespace radvor
