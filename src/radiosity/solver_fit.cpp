// Light between the samples, when the mesh is done: its triangles are asked in their middles for the light of sources,
// which is exact there, and what they find moves the corners that interpolate. What reflects has the right power then.
//
// Light from all around is not asked for: it took as many rays again (docs/transport.md).
#include <algorithm>

#include "radiosity/fit.h"
#include "radiosity/method.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

constexpr double k_fitted = 0.01;  // of the squared tolerance: share of the area that a triangle is asked from

}  // namespace

// Where the triangulation is free its edges follow the light.
Steps Solver::align_ties(Pace& pace) {
  if ((options.disable & Disable::tie_alignment) != 0) {
    co_return;
  }
  std::pmr::vector<double> values(&host.memory);
  values.reserve(direct.size());
  for (std::size_t i = 0; i < direct.size(); ++i) {
    values.push_back(luminance(direct[i] + first_bounce_[i]));
  }
  Ties ties;
  co_await surface->align_ties(values, options.tie_tolerance, ties, pace);
  stats_.ties = ties.count;
  stats_.realigned_ties = ties.realigned;
}

void Solver::place_fit_probes() {
  const double area = receiving_area();
  const std::pmr::vector<std::uint8_t> all(direct.size(), 1, &host.memory);
  const double least = std::max(k_fitted * options.tolerance * options.tolerance * area, 1e-300);
  probes_ = place_probes(*surface, least, all, visibility_->lift(), host);
  probed_.assign(probes_.size(), Color(0.0));
}

Steps Solver::fit_between(Pace& pace) {
  if (!catch_up()) {
    co_return;
  }
  if (block_ == 0) {
    co_await align_ties(pace);
    if (!options.spacing.refines || light_->source_count() == 0) {
      stage_ = Stage::account;
      co_return;
    }
    co_await pace;
    place_fit_probes();
    co_await pace;
  }
  if (!over_probes([&](std::size_t k, Tracer& tracer) { probed_[k] = punctual_light(probes_[k].receiver, tracer); })) {
    co_return;
  }
  co_await pace;
  std::pmr::vector<Color> punctual(direct, &host.memory);
  const Color sky = k_pi * light_->sky_radiance();
  for (std::size_t i = 0; i < punctual.size(); ++i) {
    punctual[i] = glm::max(punctual[i] - outlooks_[i].open * sky, Color(0.0));
  }
  fit = fit_to_probes(*surface, probes_, probed_, punctual, host);
  stage_ = Stage::account;
}

}  // namespace radvor
