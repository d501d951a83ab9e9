// Whether light between the samples is what they say.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/hash.h"
#include "radiosity/method.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

constexpr double k_probed = 0.1;    // of the squared tolerance: share of the area that a triangle is probed from
constexpr double k_probe_rays = 2;  // of a hemisphere, over the tolerance

}  // namespace

// The light that is being followed, in the middle of triangles. A triangle that is wrong by the mean irradiance is
// worth its share of the area against the squared tolerance: smaller ones than a tenth of that are not looked into.
void Solver::probe() {
  if (block_ == 0) {
    place_probes_due();
  }
  const Color sky = k_pi * light_->sky_radiance();
  const bool all = over_probes([&](std::size_t k, Tracer& tracer) {
    const Probe& probe = probes_[k];
    if (!looking_) {
      probed_[k] = punctual_light(probe.receiver, tracer);
      return;
    }
    const std::uint64_t seed = hash(options.seed, std::uint64_t{round_} + 1, k);
    const std::uint32_t rays = probe_rays() * rays_by_sky(probe.samples, 0);
    const Outlook outlook = hemispheres_->glance(probe.receiver, rays, seed, *surface, radiosity_, tracer, probed_[k]);
    probed_[k] += outlook.open * sky;
  });
  if (!all) {
    return;
  }
  if (round_ < 3 * surface->max_level()) {
    raised_ = wrong_between();
  }
  if (!raised_.empty()) {
    raised_by_probes_ = true;
    stage_ = Stage::remake;
    return;
  }
  end_probes();
}

void Solver::end_probes() {
  if (looking_) {
    stage_ = Stage::fit;
  } else {
    begin_looking();
  }
}

// Of all sources with a place or a direction.
Color Solver::punctual_light(const Receiver& receiver, Tracer& tracer) const {
  Color light(0.0);
  for (std::uint32_t source = 0; source < light_->source_count(); ++source) {
    Sight sight;
    light += light_->irradiance(source, receiver, tracer, sight);
  }
  return light;
}

std::uint32_t Solver::probe_rays() const {
  return std::bit_ceil(
      static_cast<std::uint32_t>(std::clamp(k_probe_rays / options.tolerance, k_least_rays, k_most_rays)));
}

void Solver::place_probes_due() {
  const double area = receiving_area();
  const double least = std::max(k_probed * options.tolerance * options.tolerance * area, 1e-300);
  probes_ = place_probes(*surface, least, unprobed_, visibility_->lift(), host);
  if (looking_) {
    // Light from all around changes over the distance of what is seen: where that is far, nothing is between.
    const double most = 0.5 * k_reach * std::sqrt(options.tolerance);
    std::erase_if(probes_, [&](const Probe& probe) {
      return std::none_of(probe.samples.begin(), probe.samples.end(), [&](std::uint32_t sample) {
        return outlooks_[sample].inverse_distance * glm::distance(receivers_[sample].point, probe.receiver.point) >
               most;
      });
    });
  }
  probed_.assign(probes_.size(), Color(0.0));
  std::fill(unprobed_.begin(), unprobed_.end(), std::uint8_t{0});
}

// Sites about the triangles whose probes say otherwise than their corners, worst first, until the rest is within the
// tolerance. What noise explains says nothing.
std::pmr::vector<std::uint32_t> Solver::wrong_between() const {
  const auto samples = surface->samples();
  std::pmr::vector<Color> light(direct, &host.memory);
  for (std::size_t i = 0; i < light.size(); ++i) {
    light[i] += first_bounce_[i];
  }
  const double mean = mean_of(light);
  const double noise = looking_ ? k_noise * std::pow(probe_rays(), -k_net_power) : 0;
  struct Wrong {
    double score;
    std::array<std::uint32_t, 3> samples;
  };
  std::pmr::vector<Wrong> wrong(&host.memory);
  const double area = receiving_area();
  double left = 0;
  const auto add = [&](double score, const std::array<std::uint32_t, 3>& about) {
    left += score;
    wrong.push_back({score, about});
  };
  for (std::uint32_t k = 0; k < probes_.size() && mean > 0; ++k) {
    const Probe& probe = probes_[k];
    double expected = 0;
    for (const std::uint32_t sample : probe.samples) {
      expected += sum(looking_ ? settled_[sample] : direct[sample]) / 9;
    }
    const double found = sum(probed_[k]) / 3;
    const double unexplained = std::max(0.0, std::abs(found - expected) - noise * std::max(found, expected));
    add(score_of(unexplained, 0, mean, probe.area), probe.samples);
  }
  for (std::size_t k = 0; k < shadowed_.size() && !looking_; ++k) {
    const Shadowed& place = shadowed_[k];
    const FacetPoint point = surface->locate(place.facet, place.at);
    std::array<std::uint32_t, 3> about;
    double expected = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      about[i] = sample_of(point.shares[i], place.back);
      expected += point.weights[i] * sum(direct[about[i]]) / 3;
    }
    add(score_of(sum(place.light) / 3, expected, mean, place.area), about);
  }
  std::sort(wrong.begin(), wrong.end(), [](const Wrong& a, const Wrong& b) {
    return a.score != b.score ? a.score > b.score : a.samples < b.samples;
  });
  std::pmr::vector<std::uint32_t> raised(&host.memory);
  std::pmr::vector<std::uint8_t> is_raised(surface->sites().size(), 0, &host.memory);
  for (const Wrong& of : wrong) {
    if (left <= area) {
      break;
    }
    left -= of.score;
    for (const std::uint32_t sample : of.samples) {
      const std::uint32_t site = samples[sample].site;
      if (is_raised[site] == 0) {
        is_raised[site] = 1;
        raised.push_back(site);
      }
    }
  }
  return raised;
}

}  // namespace radvor
