// The mesh follows the light: sites are raised where it is too coarse, and what is known of samples goes along.
#include <algorithm>

#include "radiosity/method.h"
#include "radiosity/refinement_plan.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

// Of all samples. So few sites rise by two levels at once: the next round, a pass over everything, would be for them.
constexpr double k_few = 0.0005;

}  // namespace

// Raises the mesh's level where the light so far demands it; the new samples' light is next. Where it demands nothing
// more, the next kind of light is due.
Steps Solver::refine(Pace& pace) {
  std::pmr::vector<Color> light(direct, &host.memory);
  if (options.spacing.refines && looking_) {
    co_await settle_surroundings(pace);
    const Color sky = k_pi * light_->sky_radiance();
    for (std::size_t i = 0; i < light.size(); ++i) {
      light[i] += settled_[i] - outlooks_[i].open * sky;
    }
  }
  if (options.spacing.refines && round_ < 2 * surface->max_level()) {
    const double mean = mean_of(light);
    const RefinementGoal goal{k_share_of_mesh * options.tolerance, mean};
    if (mean > 0) {
      co_await plan_refinement(*surface, {light, sights_}, goal, host, raised_, pace);
    }
    if (!raised_.empty()) {
      raised_by_probes_ = false;
      stage_ = Stage::remake;
      co_return;
    }
  }
  end_refinement();
}

void Solver::end_refinement() {
  if (options.spacing.refines) {
    stage_ = silhouettes_ ? Stage::silhouettes : Stage::probes;
  } else if (looking_) {
    stage_ = Stage::fit;
  } else {
    begin_looking();
  }
}

// Raises what is planned: new samples' direct light is next, if there are any.
Steps Solver::remake(Pace& pace) {
  const std::pmr::vector<std::uint32_t> raised(std::move(raised_));
  raised_.clear();
  const std::uint32_t most = options.spacing.max_sites;
  if (most != 0 && surface->sites().size() >= most) {
    end_remake();
    co_return;
  }
  const std::size_t sites = surface->sites().size();
  const double few = k_few * static_cast<double>(direct.size());
  co_await surface->raise(raised, most, pace);
  if (static_cast<double>(raised.size()) < few) {
    co_await surface->raise(raised, most, pace);
  }
  if (surface->sites().size() == sites) {  // levels alone rose: whatever comes next tells itself what is pending
    end_remake();
    co_return;
  }
  std::optional<SharesBefore> before;  // for links
  if (hemispheres_->size() > 0) {
    before.emplace(*surface, host);
  }
  std::pmr::vector<SampleOrigin> origins(&host.memory);
  co_await surface->refine({}, most, {}, origins, pace);
  co_await follow(before, origins, pace);
  if (pending_.empty()) {
    --round_;
    end_remake();
  }
}

void Solver::end_remake() {
  if (raised_by_probes_) {
    end_probes();
  } else {
    end_refinement();
  }
}

// Renumbers what is known of samples and shares after a refinement; new samples are pending. What is shown between
// slices comes first.
Steps Solver::follow(const std::optional<SharesBefore>& before, std::span<const SampleOrigin> origins, Pace& pace) {
  std::pmr::memory_resource* memory = &host.memory;
  std::pmr::vector<std::uint32_t> now(direct.size(), k_none, memory);
  pending_.clear();
  for (std::uint32_t i = 0; i < origins.size(); ++i) {
    if (origins[i].kept) {
      now[origins[i].samples[0]] = i;
    } else {
      pending_.push_back(i);
    }
  }
  renumber(anchors_, origins, k_unanchored);
  std::pmr::vector<float> glimpsed(origins.size(), memory);
  host.jobs.for_ranges(origins.size(), k_samples_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      SampleOrigin& anchor = anchors_[i];
      anchor = origins[i].kept ? anchor : origins[i];
      bool all = anchor.samples[0] != k_none;
      for (std::size_t k = 0; all && k < 3; ++k) {
        anchor.samples[k] = now[anchor.samples[k]];
        all = anchor.samples[k] != k_none;
      }
      anchor = all ? anchor : k_unanchored;
      for (std::size_t k = 0; k < 3; ++k) {
        glimpsed[i] += origins[i].weights[k] * glimpsed_[origins[i].samples[k]];
      }
    }
  });
  glimpsed_.swap(glimpsed);
  renumber(direct, origins, Color(0.0));
  renumber(sights_, origins, std::uint64_t{0});
  renumber(records_, origins, k_none);
  renumber(outlooks_, origins, Outlook{});
  renumber(known_, origins, std::uint8_t{0});
  renumber(first_bounce_, origins, Color(0.0));
  keep_interpolated(now);
  renumber(unprobed_, origins, std::uint8_t{1});
  indirect.assign(origins.size(), Color(0.0));
  due_again_.clear();
  ++round_;  // what is shown of pending samples depends on these
  source_ = 0;
  stage_ = Stage::direct;
  co_await pace.time_for(seconds_of_pass());

  follow_receivers(origins);
  co_await pace;
  if (before) {
    hemispheres_->follow(follow_shares(*before, now, *surface, host));
    co_await pace;
  }
  blocks_.emplace(*surface, receivers_, pending_, host);
}

// Interpolated samples keep to their anchors. One that lost them, or became several where a facet was taken apart, is
// as a new one.
void Solver::keep_interpolated(std::span<const std::uint32_t> now) {
  std::pmr::vector<std::uint8_t> kept(direct.size(), 0, &host.memory);
  std::size_t still = 0;
  for (const std::uint32_t before : interpolated_) {
    const std::uint32_t sample = now[before];
    if (sample != k_none && anchors_[sample].samples[0] != k_none) {
      interpolated_[still++] = sample;
      kept[sample] = 1;
    }
  }
  interpolated_.resize(still);
  for (std::uint32_t i = 0; looking_ && i < direct.size(); ++i) {
    if (known_[i] != 0 && records_[i] == k_none && kept[i] == 0) {
      known_[i] = 0;
      direct[i] = first_bounce_[i] = Color(0.0);
      sights_[i] = 0;
      outlooks_[i] = Outlook{};
      anchors_[i] = k_unanchored;
      pending_.push_back(i);
    }
  }
}

}  // namespace radvor
