// Light from all around: which samples look at it, with how many rays, and what the others make of that.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/hash.h"
#include "radiosity/hemisphere.h"
#include "radiosity/method.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

constexpr double k_least_weight = 1e-6;  // of an anchor that matters
constexpr double k_alike = 0.42;  // times the root of the tolerance: of the mean light, that anchors may differ by
constexpr std::uint32_t k_rays_of_glimpse = 16;  // one packet
constexpr std::uint64_t k_seed_of_glimpse = 0x676c696d70736573;
constexpr float k_wide_open = 0.5f;   // share of the view that is sky, from which on its edges matter less
constexpr double k_much_finer = 0.3;  // more samples than when all links were last asked what they see of the mesh
constexpr std::uint32_t k_tasks_a_block = 8;  // a sample may cast thousands of rays
constexpr double k_same_way = 0.95;           // cosine between normals of which one may take the other's light

}  // namespace

void Solver::begin_looking() {
  looking_ = true;
  round_ = 0;
  pending_.resize(direct.size());
  std::iota(pending_.begin(), pending_.end(), 0u);
  std::fill(unprobed_.begin(), unprobed_.end(), std::uint8_t{1});
  known_.assign(direct.size(), 0);
  share_out_rays(1);
  stage_ = Stage::hemispheres;
}

// Which pending samples of a level look around by themselves; the others take from their anchors. After Ward et al., A
// ray tracing solution for diffuse interreflection (1988): light from all around changes over the distance of what is
// seen.
void Solver::begin_level() {
  const auto samples = surface->samples();
  const auto sites = surface->sites();
  const bool lazy = (options.disable & Disable::lazy) == 0;
  const double most = k_reach * std::sqrt(options.tolerance);
  if (level_ == 0 && round_ == 0) {
    reflect_direct();
  }
  std::pmr::vector<std::uint32_t> looking(&host.memory);
  for (const std::uint32_t i : pending_) {
    if (sites[samples[i].site].level != level_) {
      continue;
    }
    const SampleOrigin& anchor = anchors_[i];
    bool looks = !lazy || anchor.samples[0] == k_none;
    for (std::size_t k = 0; !looks && k < 3; ++k) {
      const std::uint32_t other = anchor.samples[k];
      if (anchor.weights[k] > k_least_weight) {
        looks = known_[other] == 0;
        const double nearness = outlooks_[other].inverse_distance;
        looks = looks || glm::distance(receivers_[i].point, receivers_[other].point) * nearness > most ||
                glm::dot(samples[i].normal, samples[other].normal) < k_same_way;
      }
    }
    if (looks || differ(anchor)) {
      looking.push_back(i);
      continue;
    }
    Outlook& own = outlooks_[i];
    first_bounce_[i] = Color(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const Outlook& other = outlooks_[anchor.samples[k]];
      const double weight = anchor.weights[k];
      own.open += weight * other.open;
      own.backs += weight * other.backs;
      own.inverse_distance += weight * other.inverse_distance;
      first_bounce_[i] += weight * first_bounce_[anchor.samples[k]];
    }
    known_[i] = 1;
    interpolated_.push_back(i);
    ++stats_.skipped_lazy;
  }
  first_record_ = hemispheres_->add(static_cast<std::uint32_t>(looking.size()));
  for (std::uint32_t k = 0; k < looking.size(); ++k) {
    records_[looking[k]] = first_record_ + k;
  }
  move_to_lookouts(looking);
  blocks_.emplace(*surface, receivers_, looking, host);
  if (!sounded_out_) {
    sound_out_noise();
    sounded_out_ = true;
  }
  ray_counts_.clear();
  for (const std::uint32_t sample : looking) {
    ray_counts_.push_back(rays_for(sample));
  }
}

// Whether light from all around may bend between a sample's anchors: by one reflection of what is known of direct
// light, and the sky, they get more and less. Beside the edge of a table whose top is lit, what a wall sees changes at
// once, however far the table is.
bool Solver::differ(const SampleOrigin& anchor) const {
  const double sky = k_pi * sum(light_->sky_radiance());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < 3; ++k) {
    if (anchor.weights[k] > k_least_weight) {
      const std::uint32_t other = anchor.samples[k];
      const double light = sum(first_bounce_[other]) + outlooks_[other].open * sky;
      low = std::min(low, light);
      high = std::max(high, light);
    }
  }
  return high - low > k_alike * std::sqrt(options.tolerance) * mean_light_;
}

// Casts a sample's rays, unless as many of them, or more, have been.
void Solver::look_from(std::uint32_t sample, std::uint32_t rays, Tracer& tracer) {
  const std::uint32_t record = records_[sample];
  const double weight = hemispheres_->outlook(record).weight;
  if (weight == 0 || weight * rays > 1) {
    hemispheres_->trace(record, receivers_[sample], rays, hash(options.seed, record), *surface, tracer);
  }
  outlooks_[sample] = hemispheres_->outlook(record);
}

// How many rays a sample's hemisphere is worth: of all ways to spend them, in proportion to the root of the area leaves
// the least area-weighted squared error. As much of it is left as if every sample cast the rays that method.h tells of,
// k_rays scaled.
void Solver::share_out_rays(double scale) {
  double roots = 0, area = 0;
  for (const Sample& sample : surface->samples()) {
    roots += std::sqrt(sample.area);
    area += sample.area;
  }
  rays_per_length_ = area > 0 ? (k_first_rays + scale * k_rays / options.tolerance) * roots / area : 0;
}

// A power of two, so that they are a net.
std::uint32_t Solver::rays_for(std::uint32_t sample) const {
  const double wanted = rays_per_length_ * std::sqrt(surface->samples()[sample].area);
  const double bounded = std::clamp(wanted, k_least_rays, k_most_rays);
  return std::bit_ceil(static_cast<std::uint32_t>(bounded)) * rays_by_sky(anchors_[sample].samples, glimpsed_[sample]);
}

// A sky that is seen a little of, or perhaps, is worth as many rays again. Their number does not depend on what they
// meet: to go on only where the first ones saw sky would darken all that sees little of it.
std::uint32_t Solver::rays_by_sky(std::span<const std::uint32_t, 3> around, float glimpsed) const {
  if (sum(light_->sky_radiance()) <= 0) {
    return 1;
  }
  const bool unknown = std::any_of(around.begin(), around.end(),
                                   [&](std::uint32_t sample) { return sample == k_none || known_[sample] == 0; });
  const bool some = unknown ? glimpsed < k_wide_open : std::any_of(around.begin(), around.end(), [&](auto sample) {
    return outlooks_[sample].open > 0 && outlooks_[sample].open < k_wide_open;
  });
  return some ? 2 : 1;
}

// The sky, which is in the hemispheres' rays and so comes last: a guess of its own, to be shown meanwhile, and to tell
// how many rays its edges are worth.
void Solver::glimpse() {
  const std::uint32_t end = next_blocks(4);
  over_blocks(block_, end, [&](std::uint32_t sample, Tracer& tracer) {
    const Receiver& receiver = receivers_[sample];
    const Net net(hash(options.seed, k_seed_of_glimpse, sample));
    const Basis basis(receiver.normal);
    std::array<Vec3, k_rays_of_glimpse> targets;
    std::array<std::uint8_t, k_rays_of_glimpse> blocked;
    for (std::uint32_t ray = 0; ray < k_rays_of_glimpse; ++ray) {
      targets[ray] = receiver.lifted + light_->far() * direction(basis, net.point(ray));
    }
    tracer.blocked_from(receiver.lifted, targets, blocked.data());
    const auto open = std::count(blocked.begin(), blocked.end(), std::uint8_t{0});
    glimpsed_[sample] = static_cast<float>(open) / k_rays_of_glimpse;
  });
  block_ = end;
  if (block_ == blocks_->count()) {
    block_ = 0;
    stage_ = Stage::direct;
  }
}

// What some blocks of pending receivers see of their hemispheres.
Steps Solver::look_around(Pace& pace) {
  if ((options.disable & Disable::indirect) != 0 && sum(light_->sky_radiance()) <= 0) {
    stage_ = Stage::fit;
    co_return;
  }
  if (block_ == 0) {
    co_await pace.time_for(seconds_of_pass());
    begin_level();
    co_await pace;
  }
  const std::uint32_t end = next_blocks(slice.pauses() ? 1 : 4);
  over_blocks(
      block_, end,
      [&](std::uint32_t sample, Tracer& tracer) {
        look_from(sample, ray_counts_[records_[sample] - first_record_], tracer);
        if (round_ == 0) {  // later, anchors are samples whose first bounce has been seen
          first_bounce_[sample] = hemispheres_->gather(records_[sample], radiosity_);
        }
        known_[sample] = 1;
      },
      k_tasks_a_block);
  block_ = end;
  if (block_ < blocks_->count()) {
    co_return;
  }
  block_ = 0;
  if (++level_ <= surface->max_level()) {
    co_return;
  }
  level_ = 0;
  const Color sky = k_pi * light_->sky_radiance();
  for (const std::uint32_t i : pending_) {
    direct[i] += outlooks_[i].open * sky;
  }
  stage_ = Stage::first_bounce;
}

// radiosity_: what direct light makes shares send.
void Solver::reflect_direct() {
  const auto shares = surface->shares();
  radiosity_.assign(shares.size(), glm::vec3(0.0f));
  if ((options.disable & Disable::indirect) != 0) {
    return;
  }
  for (std::size_t s = 0; s < shares.size(); ++s) {
    radiosity_[s] = as_sent(shares[s].albedo * direct[shares[s].sample]);
  }
}

// What samples get by one reflection of direct light. Those that have looked around before see the mesh as it is now,
// once it is much finer than when they last did: every one of their links is read again for it.
void Solver::see_first_bounce() {
  const std::size_t samples = records_.size();
  const bool all = static_cast<double>(samples) > (1 + k_much_finer) * static_cast<double>(seen_by_all_);
  if (all && !catch_up()) {
    return;
  }
  if (block_ == 0) {
    reflect_direct();
    spreads_.resize(hemispheres_->size());
  }
  constexpr std::size_t k_block = 256;
  const std::size_t count = all ? samples : pending_.size();
  const std::size_t begin = block_ * k_block;
  const std::size_t end = std::min(count, begin + (slice.pauses() ? 8 : 64) * k_block * host.jobs.thread_count());
  host.jobs.for_ranges(end - begin, k_block, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = begin + first; k < begin + last; ++k) {
      const std::uint32_t sample = all ? static_cast<std::uint32_t>(k) : pending_[k];
      if (const std::uint32_t record = records_[sample]; record != k_none) {
        first_bounce_[sample] = hemispheres_->gather(record, radiosity_);
        // Where a facet was taken apart samples share a record, and tell the same of it.
        std::atomic_ref(spreads_[record])
            .store(static_cast<float>(hemispheres_->spread(record, radiosity_)), std::memory_order_relaxed);
      }
    }
  });
  block_ = static_cast<std::uint32_t>((end + k_block - 1) / k_block);
  if (end == count) {
    block_ = 0;
    seen_by_all_ = all ? samples : seen_by_all_;
    interpolate(interpolated_, first_bounce_);
    stage_ = Stage::refinement;
  }
}

// A unit of work on links that the mesh went ahead of; whether that was all of them.
bool Solver::catch_up() {
  constexpr std::uint64_t k_links = 1u << 15;  // a thread, in slices
  return hemispheres_->catch_up(*surface, (slice.pauses() ? 1 : 16) * k_links * host.jobs.thread_count());
}

}  // namespace radvor
