// Light between the samples, at the end of refinement: the triangles are asked in their middles once more, and what
// they find moves the corners that interpolate. What reflects has the right power then, too.
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/hash.h"
#include "radiosity/fit.h"
#include "radiosity/method.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

constexpr double k_fitted = 0.01;   // of the squared tolerance: share of the area that a triangle is asked from
constexpr double k_nearest = 0.25;  // of k_reach: where nothing is so near, light from all around is even
constexpr double k_most_gain = 1.5;

}  // namespace

// Where the triangulation is free its edges follow the light.
void Solver::align_ties() {
  if ((options.disable & Disable::tie_alignment) != 0) {
    return;
  }
  std::pmr::vector<double> values(&host.memory);
  values.reserve(direct.size());
  for (std::size_t i = 0; i < direct.size(); ++i) {
    values.push_back(luminance(direct[i] + first_bounce_[i]));
  }
  const Ties ties = surface->align_ties(values, options.tie_tolerance);
  stats_.ties = ties.count;
  stats_.realigned_ties = ties.realigned;
}

void Solver::place_fit_probes() {
  double area = 0;
  for (const Sample& sample : surface->samples()) {
    area += sample.area;
  }
  const std::pmr::vector<std::uint8_t> all(direct.size(), 1, &host.memory);
  const double least = std::max(k_fitted * options.tolerance * options.tolerance * area, 1e-300);
  probes_ = place_probes(*surface, least, all, visibility_->lift(), host);
  probed_.assign(probes_.size(), Color(0.0));
  probed_bounce_.assign(probes_.size(), Color(0.0));
}

// What a probe finds of light from all around is taken for what its corners say where noise explains the difference.
void Solver::look_between(std::size_t k, Tracer& tracer) {
  const Probe& probe = probes_[k];
  const Color sky = k_pi * light_->sky_radiance();
  double nearness = 0, open = 0;
  Color bounce(0.0);
  for (const std::uint32_t sample : probe.samples) {
    nearness = std::max(
        nearness, outlooks_[sample].inverse_distance * glm::distance(receivers_[sample].point, probe.receiver.point));
    open += outlooks_[sample].open / 3;
    bounce += first_bounce_[sample] / 3.0;
  }
  const bool looks = (options.disable & Disable::indirect) == 0 || sum(sky) > 0;
  if (looks && nearness > k_nearest * k_reach * std::sqrt(options.tolerance)) {
    const std::uint32_t rays = rays_for(probe.area) * (may_see_edge_of_sky(probe.samples) ? 2 : 1);
    const double noise = k_noise * std::pow(rays, -0.75);
    Color found(0.0);
    const Outlook outlook = hemispheres_->glance(probe.receiver, rays, hash(options.seed, std::uint64_t{1} << 32, k),
                                                 *surface, radiosity_, tracer, found);
    if (std::abs(outlook.open - open) > noise * std::max(outlook.open, open)) {
      open = outlook.open;
    }
    if (std::abs(sum(found) - sum(bounce)) > noise * std::max(sum(found), sum(bounce))) {
      bounce = found;
    }
  }
  probed_[k] = punctual_light(probe.receiver, tracer) + open * sky;
  probed_bounce_[k] = bounce;
}

void Solver::fit_between() {
  if (block_ == 0) {
    align_ties();
    if (!options.spacing.refines) {
      stage_ = Stage::account;
      return;
    }
    place_fit_probes();
  }
  const auto count = static_cast<std::uint32_t>((probes_.size() + ReceiverBlocks::k_size - 1) / ReceiverBlocks::k_size);
  const std::uint32_t end = std::min(count, block_ + 4 * host.jobs.thread_count());
  over(block_, end, [&](std::uint32_t block, Tracer& tracer) {
    const std::size_t stop = std::min<std::size_t>(probes_.size(), std::size_t{block + 1} * ReceiverBlocks::k_size);
    for (std::size_t k = std::size_t{block} * ReceiverBlocks::k_size; k < stop; ++k) {
      look_between(k, tracer);
    }
  });
  block_ = end;
  if (block_ < count) {
    return;
  }
  block_ = 0;
  direct_fit = fit_to_probes(*surface, probes_, probed_, direct, host);
  bounce_gain_ = fit_to_probes(*surface, probes_, probed_bounce_, first_bounce_, host);
  for (std::size_t i = 0; i < bounce_gain_.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      double& gain = bounce_gain_[i][channel];
      const double light = first_bounce_[i][channel];
      gain = light > 0 ? std::clamp(1 + gain / light, 1 / k_most_gain, k_most_gain) : 1;
    }
  }
  stage_ = Stage::account;
}

// Light of later bounces is short of as much as that of the first.
void Solver::fit_indirect() {
  if (bounce_gain_.empty()) {
    return;
  }
  indirect_fit.resize(indirect.size());
  for (std::size_t i = 0; i < indirect.size(); ++i) {
    indirect_fit[i] = (bounce_gain_[i] - 1.0) * indirect[i];
  }
}

}  // namespace radvor
