// What a bake shows between slices of time: the light that is there, and a guess at what is still to come to some
// samples. Nothing of it goes into the bake: slices or none, it ends the same.
#include <array>
#include <span>

#include "base/hash.h"
#include "radiosity/hemisphere.h"
#include "radiosity/method.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

constexpr std::uint32_t k_rays_of_glimpse = 16;  // one packet

}  // namespace

void Solver::expect_pauses() {
  const bool begun = stage_ != Stage::direct || round_ > 0 || source_ > 0 || block_ > 0 || !glimpsed_.empty();
  if (!begun && sum(light_->sky_radiance()) > 0) {
    glimpsed_.assign(direct.size(), 0.0f);
    stage_ = Stage::glimpse;
  }
}

// The sky, which the bake itself comes to last.
void Solver::glimpse() {
  const std::uint32_t end = next_blocks(4);
  over_blocks(block_, end, [&](std::uint32_t sample, Tracer& tracer) {
    const Receiver& receiver = receivers_[sample];
    const Net net(hash(options.seed, sample));
    const Basis basis(receiver.normal);
    std::array<Vec3, k_rays_of_glimpse> targets;
    std::array<std::uint8_t, k_rays_of_glimpse> blocked;
    for (std::uint32_t ray = 0; ray < k_rays_of_glimpse; ++ray) {
      targets[ray] = receiver.lifted + light_->far() * direction(basis, net.point(ray));
    }
    tracer.blocked_from(receiver.lifted, targets, blocked.data());
    std::uint32_t open = 0;
    for (const std::uint8_t hidden : blocked) {
      open += hidden != 0 ? 0 : 1;
    }
    glimpsed_[sample] = static_cast<float>(open) / k_rays_of_glimpse;
  });
  block_ = end;
  if (block_ == blocks_->count()) {
    block_ = 0;
    stage_ = Stage::direct;
  }
}

// New samples, until their own light is there, show that of those that they lie between.
void Solver::show() {
  const Color sky = k_pi * light_->sky_radiance();
  shown_.assign(direct.begin(), direct.end());
  const bool shines = stage_ == Stage::direct, looks = stage_ == Stage::hemispheres;
  const auto add_sky = [&](std::uint32_t i) {
    const double open = known_[i] != 0 ? outlooks_[i].open : glimpsed_.empty() ? 0.0 : double{glimpsed_[i]};
    shown_[i] += open * sky;
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
