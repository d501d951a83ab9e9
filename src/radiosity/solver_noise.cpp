// What rays leave to chance: how noisy a scene's light is, before most of them are cast, and what neighbours know
// together after.
#include <algorithm>
#include <cmath>

#include "radiosity/method.h"
#include "radiosity/smoothing.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

constexpr double k_left_bent = 8;          // tolerances that light may be from linear where the mesh has followed it
constexpr double k_most_scaled = 3;        // how far a scene's rays may be from k_rays, to either side
constexpr std::uint32_t k_soundings = 32;  // blocks of samples

}  // namespace

// The relative standard error of a mean over a hemisphere's rays that differ by so much (their standard deviation over
// the mean). They are a net, so it falls with the 3/4th power of their number; but what few of them meet is met by
// chance, and falls with the root alone.
double Solver::noise_of(std::uint32_t record, double spread) const {
  return spread * std::pow(hemispheres_->outlook(record).weight, k_net_power) * std::pow(1 + spread * spread, 0.25);
}

double Solver::noise_of_sky(std::uint32_t sample) const {
  const double open = outlooks_[sample].open;
  return records_[sample] != k_none && open > 0 ? noise_of(records_[sample], std::sqrt((1 - open) / open)) : 0;
}

// Some of the first samples cast rays ahead of the others. Where one sample's light is less certain than the tolerance,
// all cast more; where it is more so, fewer: a courtyard under the sky needs fewer than a crypt with a candle. As
// certain as the tolerance is enough, since neighbours share what they know.
void Solver::sound_out_noise() {
  const double sky = k_pi * sum(light_->sky_radiance());
  const std::uint32_t count = blocks_->count(), soundings = std::min(count, k_soundings);
  const auto samples_of = [&](std::uint32_t sounding) {
    return blocks_->block(static_cast<std::uint32_t>(std::uint64_t{sounding} * count / soundings));
  };
  over(0, soundings, [&](std::uint32_t sounding, Tracer& tracer) {
    for (const std::uint32_t sample : samples_of(sounding)) {  // none is known yet: how many rays depends on no other
      look_from(sample, rays_for(sample), tracer);
    }
  });
  double area = 0, light = 0, variance = 0;
  for (std::uint32_t sounding = 0; sounding < soundings; ++sounding) {
    for (const std::uint32_t i : samples_of(sounding)) {
      const double reflected = sum(hemispheres_->gather(records_[i], radiosity_));
      const double from_sky = outlooks_[i].open * sky;
      const double error = reflected * noise_of(records_[i], hemispheres_->spread(records_[i], radiosity_));
      const double error_of_sky = from_sky * noise_of_sky(i);
      const double part = surface->samples()[i].area;
      area += part;
      light += part * (reflected + from_sky);
      variance += part * (error * error + error_of_sky * error_of_sky);
    }
  }
  mean_light_ = area > 0 ? light / area + 3 * mean_of(direct) : 0;
  const double scale = std::sqrt(variance / area) / mean_light_ / options.tolerance;
  if (std::isfinite(scale)) {  // else there is no light, or more than can be counted
    // Rays that found nothing, though something shines, do not know how much they missed.
    const double least = light > 0 || mean_of(direct) <= 0 ? 1 / k_most_scaled : 1;
    share_out_rays(std::clamp(scale, least, k_most_scaled));
  }
}

// Of each sample, as its rays say; empty where there is no sky.
std::pmr::vector<Color> Solver::sky_light() const {
  std::pmr::vector<Color> light(&host.memory);
  const Color sky = k_pi * light_->sky_radiance();
  if (sum(sky) > 0) {
    light.reserve(outlooks_.size());
    for (const Outlook& outlook : outlooks_) {
      light.push_back(outlook.open * sky);
    }
  }
  return light;
}

// Of what radiosity_ sends, by all rays.
void Solver::measure_spreads() {
  spreads_.resize(hemispheres_->size());
  host.jobs.for_ranges(spreads_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (auto record = static_cast<std::uint32_t>(begin); record < end; ++record) {
      spreads_[record] = static_cast<float>(hemispheres_->spread(record, radiosity_));
    }
  });
}

// What hemispheres say of sky and surfaces; what was interpolated follows its anchors. reflected: what comes to each
// sample by the links, whose spreads are measured; sky: of each sample, or empty; bend: see Certainty::most_bend.
Steps Solver::free_of_noise(std::pmr::vector<Color>& reflected, std::pmr::vector<Color>& sky, double bend,
                            Pace& pace) const {
  const auto count = static_cast<std::uint32_t>(reflected.size());
  std::pmr::vector<Certainty> certain(count, Certainty{}, &host.memory);
  host.jobs.for_ranges(count, 256, [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      certain[i].nearness = outlooks_[i].inverse_distance;
      certain[i].settled = records_[i] == k_none;
      if (surface->level_of(surface->samples()[i].site) < surface->max_level()) {
        certain[i].most_bend = bend;
      }
      certain[i].noise = certain[i].settled ? 0 : noise_of(records_[i], spreads_[records_[i]]);
    }
  });
  const auto follow_noise = [&] {
    for (const std::uint32_t i : interpolated_) {
      certain[i].noise = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        certain[i].noise += static_cast<double>(anchors_[i].weights[k]) * certain[anchors_[i].samples[k]].noise;
      }
    }
  };
  follow_noise();
  co_await pace.time_for(seconds_of_pass());
  const SampleNeighbours neighbours(*surface, host);
  co_await pace;
  co_await smooth(*surface, neighbours, certain, reflected, host, pace);
  interpolate(interpolated_, reflected);
  if (sky.empty()) {
    co_return;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    certain[i].noise = noise_of_sky(i);
  }
  follow_noise();
  co_await smooth(*surface, neighbours, certain, sky, host, pace);
  interpolate(interpolated_, sky);
}

// For the mesh to follow: what comes from all around by the first bounce. It is not to follow noise.
Steps Solver::settle_surroundings(Pace& pace) {
  settled_.assign(first_bounce_.begin(), first_bounce_.end());
  std::pmr::vector<Color> sky = sky_light();
  co_await free_of_noise(settled_, sky, Certainty{}.most_bend, pace);
  for (std::size_t i = 0; i < sky.size(); ++i) {
    settled_[i] += sky[i];
  }
}

// At the end. What patches shot by themselves no ray had to find.
Steps Solver::settle_noise(Pace& pace) {
  if (hemispheres_->size() == 0) {
    co_return;
  }
  const auto shares = surface->shares();
  radiosity_.resize(shares.size());
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const Color sent = shares[s].albedo * (direct[shares[s].sample] + indirect[shares[s].sample]);
    radiosity_[s] = as_sent(shot_alone_.empty() ? sent : glm::max(sent - shot_alone_[s], Color(0.0)));
  }
  measure_spreads();
  co_await pace;
  const std::uint32_t most_sites = options.spacing.max_sites;
  const bool follows = options.spacing.refines && (most_sites == 0 || surface->sites().size() < most_sites);
  const double left_bent = k_left_bent * options.tolerance * 3 * (mean_of(direct) + mean_of(indirect));
  std::pmr::vector<Color> sky = sky_light();
  const std::pmr::vector<Color> noisy_sky(sky, &host.memory);
  std::pmr::vector<Color> settled(indirect, &host.memory);
  for (std::size_t i = 0; i < from_standouts_.size(); ++i) {
    settled[i] -= from_standouts_[i];
  }
  co_await free_of_noise(settled, sky, follows ? left_bent : Certainty{}.most_bend, pace);
  for (std::size_t i = 0; i < from_standouts_.size(); ++i) {
    settled[i] += from_standouts_[i];
  }
  indirect.swap(settled);
  for (std::size_t i = 0; i < sky.size(); ++i) {
    if (sky[i] != noisy_sky[i]) {  // else to the bit as it was
      direct[i] = glm::max(direct[i] - noisy_sky[i], Color(0.0)) + sky[i];
    }
  }
}

}  // namespace radvor
