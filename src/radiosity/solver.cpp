// Progressive refinement after Cohen et al. (1988), the paper's [5]: the steps are in solver_*.cpp.
#include "radiosity/solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/sums.h"
#include "radiosity/method.h"
#include "scene/find_contacts.h"

namespace radvor {

namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

Solver::Solver(Scene given, const BakeOptions& wanted, const VisibilityMaker& maker, Host& lender)
    : host(lender),
      options(wanted),
      scene(std::move(given)),
      direct(&host.memory),
      indirect(&host.memory),
      fit(&host.memory),
      slice(&host.memory),
      occluders_(&host.memory),
      skips_{(options.disable & Disable::facing) == 0, (options.disable & Disable::negligible) == 0},
      visibility_(nullptr, Unmake{maker, host}),
      receivers_(&host.memory),
      in_slot_(&host.memory),
      sights_(&host.memory),
      anchors_(&host.memory),
      records_(&host.memory),
      ray_counts_(&host.memory),
      known_(&host.memory),
      outlooks_(&host.memory),
      first_bounce_(&host.memory),
      spreads_(&host.memory),
      pending_(&host.memory),
      interpolated_(&host.memory),
      unshot_(&host.memory),
      radiosity_(&host.memory),
      incoming_(&host.memory),
      incoming_before_(&host.memory),
      links_read_(&host.memory),
      settled_(&host.memory),
      shot_alone_(&host.memory),
      from_standouts_(&host.memory),
      glimpsed_(&host.memory),
      guessed_(&host.memory),
      due_again_(&host.memory),
      shown_(&host.memory),
      stood_out_(&host.memory),
      raised_(&host.memory),
      casts_(&host.memory),
      shadowed_(&host.memory),
      probes_(&host.memory),
      probed_(&host.memory),
      unprobed_(&host.memory) {
  const Clock::time_point begin = Clock::now();
  welded.emplace(weld(scene, options.weld_distance, host));
  facets.emplace(find_facets(scene, *welded, options.crease_angle, host));
  const SurfaceOptions spacing = choose_spacing(scene, *welded, *facets, options.spacing);
  if ((options.disable & Disable::intersections) == 0) {
    find_contacts(scene, *welded, *facets, ContactLimits::at_spacing(finest_spacing(spacing)), host);
  }
  surface.emplace(scene, *welded, *facets, spacing, host);

  std::pmr::vector<std::uint32_t> corners(&host.memory);
  for (std::uint32_t t = 0; t < welded->triangles.size(); ++t) {
    const Triangle& triangle = welded->triangles[t];
    if (scene.meshes[triangle.mesh].casts) {
      occluders_.push_back(t);
      corners.insert(corners.end(), triangle.vertices.begin(), triangle.vertices.end());
    }
  }
  if ((options.disable & Disable::clear_shafts) == 0) {
    occluder_tree_.emplace(Occluders{welded->positions, corners}, &host.memory);
  }
  light_.emplace(scene, *welded, *facets, occluder_tree_ ? &*occluder_tree_ : nullptr, options.tolerance, host);

  const auto samples = surface->samples();
  direct.assign(samples.size(), Color(0.0));
  indirect.assign(samples.size(), Color(0.0));
  sights_.assign(samples.size(), 0);
  anchors_.assign(samples.size(), k_unanchored);
  visibility_.reset(maker.make(maker.user, {welded->positions, corners}, host));
  pending_.resize(samples.size());
  std::iota(pending_.begin(), pending_.end(), 0u);
  place_receivers(pending_);
  records_.assign(samples.size(), k_none);
  known_.assign(samples.size(), 0);
  outlooks_.assign(samples.size(), Outlook{});
  first_bounce_.assign(samples.size(), Color(0.0));
  unprobed_.assign(samples.size(), 1);
  glimpsed_.assign(samples.size(), 0.0f);
  stage_ = sum(light_->sky_radiance()) > 0 ? Stage::glimpse : Stage::direct;
  blocks_.emplace(*surface, receivers_, pending_, host);
  hemispheres_.emplace(scene, *facets, occluders_, host);
  if (options.spacing.refines && light_->source_count() > 0 && !occluders_.empty()) {
    silhouettes_.emplace(*surface, *light_, occluders_, host);
  }
  stats_.seconds_setup = std::chrono::duration<double>(Clock::now() - begin).count();
  seconds = stats_.seconds_setup;
}

void Solver::step() {
  if (under_way_.is_done()) {
    begin_step();
  }
  if (!under_way_.go_on()) {
    under_way_ = Steps();
  }
  report_convergence();
}

void Solver::begin_step() {
  switch (stage_) {
    case Stage::glimpse:
      glimpse();
      break;
    case Stage::direct:
      shine();
      break;
    case Stage::refinement:
      under_way_ = refine(slice);
      break;
    case Stage::remake:
      under_way_ = remake(slice);
      break;
    case Stage::silhouettes:
      cast_shadows();
      break;
    case Stage::shadows:
      judge_shadows();
      break;
    case Stage::probes:
      probe();
      break;
    case Stage::hemispheres:
      under_way_ = look_around(slice);
      break;
    case Stage::first_bounce:
      see_first_bounce();
      break;
    case Stage::fit:
      under_way_ = fit_between(slice);
      break;
    case Stage::account:
      under_way_ = account(slice);
      break;
    case Stage::standouts:
      under_way_ = shoot_standout(slice);
      break;
    case Stage::bounces:
      bounce();
      break;
    case Stage::finish:
      under_way_ = finish(slice);
      break;
    case Stage::done:
      break;
  }
}

Steps Solver::finish(Pace& pace) {
  co_await settle_noise(pace);
  stage_ = Stage::done;
}

void Solver::count(const TransportCounters& counters) {
  stats_.rays += counters.rays;
  idle_rays_ += counters.idle_rays;
  stats_.form_factors += counters.form_factors;
  stats_.skipped_facing += counters.skipped_facing;
  stats_.skipped_negligible += counters.skipped_negligible;
  stats_.skipped_clear += counters.skipped_clear;
  stats_.seconds_rays += counters.ray_seconds();
}

std::uint32_t Solver::next_blocks(std::uint32_t per_thread) const {
  return std::min(blocks_->count(), block_ + per_thread * host.jobs.thread_count());
}

// Direct light of one source on some blocks of receivers.
void Solver::shine() {
  if (source_ == light_->source_count()) {
    stage_ = looking_ ? Stage::hemispheres : Stage::refinement;
    guessed_ = std::pmr::vector<Color>(&host.memory);
    return;
  }
  const std::uint32_t end = next_blocks(4);
  over_blocks(block_, end, [&](std::uint32_t sample, Tracer& tracer) {
    Sight sight;
    direct[sample] += light_->irradiance(source_, receivers_[sample], tracer, sight);
    sights_[sample] = with_sight(sights_[sample], sight);
  });
  block_ = end;
  if (block_ >= blocks_->count()) {
    block_ = 0;
    ++source_;
    ++stats_.shots;
  }
}

// Of all receiving sides, scene units squared.
double Solver::receiving_area() const {
  const auto samples = surface->samples();
  return sum_side_by_side<double>(samples.size(), host.jobs, &host.memory,
                                  [&](double& area, std::size_t i) { area += samples[i].area; });
}

std::uint32_t Solver::sample_of(std::uint32_t front_share, bool back) const {
  const auto shares = surface->shares();
  return shares[back ? shares[front_share].other_side : front_share].sample;
}

// The mean irradiance over all receiving sides, three channels as one.
double Solver::mean_of(std::span<const Color> irradiance) const {
  const auto samples = surface->samples();
  const double received = sum_side_by_side<double>(
      samples.size(), host.jobs, &host.memory,
      [&](double& power, std::size_t i) { power += samples[i].area * sum(irradiance[i]) / 3; });
  const double area = receiving_area();
  return area > 0 ? received / area : 0;
}

// Values of samples without a record from those of their anchors.
void Solver::interpolate(std::span<const std::uint32_t> list, std::pmr::vector<Color>& values) const {
  for (const std::uint32_t sample : list) {
    const SampleOrigin& anchor = anchors_[sample];
    Color value(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      value += static_cast<double>(anchor.weights[k]) * values[anchor.samples[k]];
    }
    values[sample] = value;
  }
}

// Two fifths of the way are direct light, as many the hemispheres; the rest is the logarithm of what is left.
void Solver::report_convergence() {
  double now = 0;
  const double part = static_cast<double>(block_) / std::max(1u, blocks_->count());
  switch (stage_) {
    case Stage::glimpse:
      break;
    case Stage::direct:
      now = 0.4 * (source_ + part) / std::max(1u, light_->source_count());
      break;
    case Stage::refinement:
    case Stage::remake:
    case Stage::silhouettes:
    case Stage::shadows:
    case Stage::probes:
      now = 0.4;
      break;
    case Stage::hemispheres:
      now = 0.4 + 0.4 * part;
      break;
    case Stage::first_bounce:
    case Stage::fit:
    case Stage::account:
    case Stage::standouts:
      now = 0.8;
      break;
    case Stage::bounces: {
      const double goal = std::log(k_share_left_unshot * options.tolerance);
      const double made = first_unshot_ > 0 ? std::log(std::max(previous_unshot_ / first_unshot_, 1e-300)) : goal;
      now = 0.8 + 0.2 * std::clamp(made / goal, 0.0, 0.99);
      break;
    }
    case Stage::finish:
      now = 0.999;
      break;
    case Stage::done:
      now = 1;
      break;
  }
  converged = std::max(converged, now);
}

BakeStats Solver::stats() const {
  BakeStats stats = stats_;
  stats.seconds_direct = seconds_direct;
  stats.seconds_indirect = seconds_indirect;
  const auto shares = surface->shares();
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const Share& share = shares[s];
    const Color received = direct[share.sample] + indirect[share.sample];
    stats.absorbed_power += share.area * sum((1.0 - share.albedo) * received);
    stats.unshot_power += share.area * sum(share.albedo * (unshot_.empty() ? direct[share.sample] : unshot_[s]));
  }
  return stats;
}

}  // namespace radvor
