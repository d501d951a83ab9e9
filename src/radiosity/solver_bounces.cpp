// Reflections: what stands out first, by itself; then everything together, bounce by bounce.
#include <algorithm>
#include <cmath>

#include "base/sums.h"
#include "radiosity/fate.h"
#include "radiosity/links.h"
#include "radiosity/method.h"
#include "radiosity/shooting_tree.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

// A patch shoots by itself, once, while that takes away this share of the variance that rays meet, in tolerances: at
// finer ones there are more rays, and a shot is the cheaper beside them.
constexpr double k_stands_out = 4.0 / 3;

// No more shots once they have cast this share of all rays before: beside a patch of many small shares one is dear.
constexpr double k_most_spent = 0.25;

// Bounces read all of a sample's links while this share of its light, or more, is still to come. How many the others
// read is chosen for two in a row, which are to be compared.
constexpr double k_in_full = 1.0 / 32;
constexpr std::uint32_t k_same_links = 2;

constexpr double k_most_ratio = 0.97;  // of a bounce to the one before, as a series

}  // namespace

// What the sources emitted and lost; what surfaces have to reflect.
Steps Solver::account(Pace& pace) {
  co_await pace.time_for(seconds_of_pass());
  surface->group_patches();
  co_await pace;
  const FateMeter meter(scene, *welded, *visibility_, occluders_, options.tolerance, options.seed);
  const FateMeter::Powers powers = meter.of_sources(*light_, host);
  stats_.emitted_power = powers.emitted;
  stats_.escaped_power = powers.escaped;
  stats_.absorbed_back_power = powers.backs;
  stats_.rays += powers.rays;
  co_await pace;
  const auto shares = surface->shares();
  unshot_.reserve(shares.size());
  for (const Share& share : shares) {
    unshot_.push_back(fit.empty() ? direct[share.sample] : direct[share.sample] + fit[share.sample]);
  }
  co_await pace.time_for(seconds_of_pass());
  incoming_.assign(receivers_.size(), Color(0.0));
  pending_.clear();
  links_read_.assign(records_.size(), 0);
  for (std::uint32_t i = 0; i < records_.size(); ++i) {
    if (records_[i] != k_none) {
      pending_.push_back(i);
      links_read_[i] = hemispheres_->link_count(records_[i]);
    }
  }
  blocks_.emplace(*surface, receivers_, pending_, host);
  radiosity_.assign(shares.size(), glm::vec3(0.0f));
  first_unshot_ = previous_unshot_ = unshot_luminance();
  if ((options.disable & Disable::indirect) != 0 || first_unshot_ <= 0) {
    stage_ = Stage::finish;
    co_return;
  }
  stood_out_.assign(surface->patch_count(), 0);
  rays_before_standouts_ = stats_.rays - idle_rays_;
  stage_ = options.max_bounces == 0 ? Stage::standouts : Stage::bounces;
}

double Solver::unshot_luminance() const {
  const auto shares = surface->shares();
  return sum_side_by_side<double>(shares.size(), host.jobs, &host.memory, [&](double& power, std::size_t s) {
    power += shares[s].area * luminance(shares[s].albedo * unshot_[s]);
  });
}

// Shoots the patch that stands out farthest at all receivers, while one does: few rays would meet it.
Steps Solver::shoot_standout(Pace& pace) {
  const auto shares = surface->shares();
  std::pmr::vector<double> powers(surface->patch_count(), 0.0, &host.memory),
      areas(surface->patch_count(), 0.0, &host.memory);
  double all_power = 0, all_area = 0;
  for (std::uint32_t p = 0; p < powers.size(); ++p) {
    for (const std::uint32_t s : surface->patch(p)) {
      powers[p] += shares[s].area * luminance(shares[s].albedo * unshot_[s]);
      areas[p] += shares[s].area;
    }
    all_power += powers[p];
    all_area += areas[p];
  }
  // Rays that meet a patch of radiosity b among others of mean m differ by b - m, and by m once it has shot: where all
  // are equally bright there is no noise, and a shot would make some.
  const double mean = all_area > 0 ? all_power / all_area : 0;
  double variance = 0, most = 0;
  std::uint32_t patch = k_none;
  for (std::uint32_t p = 0; p < powers.size(); ++p) {
    const double radiosity = areas[p] > 0 ? powers[p] / areas[p] : 0;
    const double less = areas[p] * radiosity * (radiosity - 2 * mean);
    variance += areas[p] * (radiosity - mean) * (radiosity - mean);
    if (less > most && stood_out_[p] == 0) {
      most = less;
      patch = p;
    }
  }
  const double spent = static_cast<double>(stats_.rays - idle_rays_ - rays_before_standouts_);
  if (patch == k_none || most < k_stands_out * options.tolerance * variance ||
      spent > k_most_spent * static_cast<double>(rays_before_standouts_)) {
    stage_ = Stage::bounces;
    co_return;
  }
  const ShootingTree tree(*surface, std::span(&patch, 1), host);
  std::pmr::vector<NodeLight> light(tree.nodes().size(), NodeLight{}, &host.memory);
  for (const Element& element : tree.elements()) {
    light[element.node].radiosity = shares[element.share].albedo * unshot_[element.share];
  }
  tree.pull(light, host);

  const auto shine_on_block = [&](std::uint32_t block, Tracer& tracer) {
    LinkMaker maker(tree, occluder_tree_ ? &*occluder_tree_ : nullptr, {}, &host.memory);
    std::pmr::vector<Link> links(&host.memory);
    for (const std::uint32_t sample : blocks_->block(block)) {
      links.clear();
      maker.make(receivers_[sample], tree.roots(), tracer, links);
      incoming_[sample] = Color(0.0);
      for (const Link& link : links) {
        incoming_[sample] += sent_along(link, light);
      }
    }
  };
  const auto shine_on = [&](std::size_t begin, std::size_t end) {
    over(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), shine_on_block);
  };
  co_await in_portions(blocks_->count(), std::size_t{4} * host.jobs.thread_count(), shine_on, pace);
  interpolate(interpolated_, incoming_);
  stood_out_[patch] = 1;
  shot_alone_.resize(shares.size(), Color(0.0));
  from_standouts_.resize(incoming_.size(), Color(0.0));
  for (const Element& element : tree.elements()) {
    const Color sent = shares[element.share].albedo * unshot_[element.share];
    lose(lost_of(element.share, sent));
    shot_alone_[element.share] += sent;
    unshot_[element.share] = Color(0.0);
  }
  for (std::size_t i = 0; i < incoming_.size(); ++i) {
    indirect[i] += incoming_[i];
    from_standouts_[i] += incoming_[i];
  }
  for (std::size_t s = 0; s < shares.size(); ++s) {
    unshot_[s] += incoming_[shares[s].sample];
  }
  ++stats_.shots;
}

// What does not come back of a share's shot.
Solver::Lost Solver::lost_of(std::uint32_t share, const Color& radiosity) const {
  const Share& shot = surface->shares()[share];
  const Outlook& outlook = outlooks_[shot.sample];
  const double power = shot.area * sum(radiosity);
  return {power * outlook.open, power * outlook.backs};
}

void Solver::lose(const Lost& lost) {
  stats_.escaped_power += lost.escaped;
  stats_.absorbed_back_power += lost.on_backs;
}

// Decides whether another bounce is due; takes what is unshot as what is shot.
bool Solver::begin_bounce() {
  const double left = unshot_luminance();
  const auto samples = surface->samples();
  const double received = sum_side_by_side<double>(
      samples.size(), host.jobs, &host.memory,
      [&](double& all, std::size_t i) { all += samples[i].area * luminance(direct[i] + indirect[i]); });
  // What is left goes on as a geometric series; its ratio is that of the last two bounces.
  const double ratio = bounces_ > 0 && previous_unshot_ > 0 ? std::min(0.99, left / previous_unshot_) : 0.5;
  previous_unshot_ = left;
  // So put that light which is not a number ends too.
  const double least = skips_.negligible ? k_share_left_unshot * options.tolerance : k_lost_to_rounding;
  const bool allowed = options.max_bounces == 0 || bounces_ < options.max_bounces;
  const bool comparable =
      options.max_bounces != 0 || !skips_.negligible || bounces_ < k_same_links || bounces_ % k_same_links == 0;
  if (!(left / (1 - ratio) > least * received) && comparable) {
    if (skips_.negligible && left > 0 && allowed) {
      stats_.skipped_negligible += pending_.size();  // of one bounce more
    }
    if (options.max_bounces == 0 && bounces_ > 1) {
      add_series(ratio);
    }
    return false;
  }
  if (!allowed) {
    return false;
  }
  const auto shares = surface->shares();
  // One pass over the shares: what each sends, and the sum of what that loses.
  lose(sum_side_by_side<Lost>(shares.size(), host.jobs, &host.memory, [&](Lost& lost, std::size_t s) {
    const Color sent = shares[s].albedo * unshot_[s];
    radiosity_[s] = as_sent(sent);
    lost += lost_of(static_cast<std::uint32_t>(s), sent);
  }));
  return true;
}

// All that is left, at once: each place's light goes on as the series of its own last two bounces. Where surfaces are
// white and close together (a sofa's cushions) that is a seventh of their light, though next to nothing of the scene's.
void Solver::add_series(double ratio_of_all) {
  const auto ratio = [&](std::uint32_t sample, int channel) {
    const double now = incoming_[sample][channel], before = incoming_before_[sample][channel];
    return now < before ? std::min(now / before, k_most_ratio) : now > 0 ? std::min(ratio_of_all, k_most_ratio) : 0.0;
  };
  const auto shares = surface->shares();
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    Color sent = shares[s].albedo * unshot_[s];
    for (int channel = 0; channel < 3; ++channel) {
      sent[channel] /= 1 - ratio(shares[s].sample, channel);
    }
    lose(lost_of(s, sent));
    unshot_[s] = Color(0.0);
  }
  for (std::uint32_t i = 0; i < incoming_.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      const double of = ratio(i, channel);
      indirect[i][channel] += incoming_[i][channel] * of / (1 - of);
    }
  }
}

// Chooses how many of a sample's links this bounce and the next are worth, by the two before them: so many that what is
// still to come, as a series, is as uncertain as k_in_full of the sample's light is by all links. While light still
// rises, or is not there yet, that is not known. The number never rises again: of a sample's first links either half
// might have been the first, so those of them that are kept are off by chance alone, but what would be read again only
// where little was found would be found too little.
void Solver::choose_links(std::uint32_t sample) {
  const double last = luminance(incoming_before_[sample]), before = luminance(incoming_[sample]);
  if (!(last < before)) {
    return;
  }
  const double to_come = last / (1 - std::min(last / before, k_most_ratio));
  const double part = to_come / luminance(direct[sample] + indirect[sample]);
  const double worth = hemispheres_->link_count(records_[sample]) * std::pow(part / k_in_full, 1 / k_net_power);
  std::uint32_t& links = links_read_[sample];
  while (links > k_least_rays && links >= 2 * worth) {
    links /= 2;
  }
}

// What the bounce brought is what is unshot.
void Solver::end_bounce() {
  constexpr std::size_t k_task = 4 * k_samples_a_task;  // it does next to nothing to each
  interpolate(interpolated_, incoming_);
  host.jobs.for_ranges(incoming_.size(), k_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      indirect[i] += incoming_[i];
    }
  });
  const auto shares = surface->shares();
  host.jobs.for_ranges(shares.size(), k_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      unshot_[s] = incoming_[shares[s].sample];
    }
  });
}

// All shares together, on some blocks of receivers.
void Solver::bounce() {
  if (block_ == 0 && !begin_bounce()) {
    stage_ = Stage::finish;
    return;
  }
  if (block_ == 0) {
    incoming_before_.swap(incoming_);
    incoming_.resize(incoming_before_.size());
  }
  const std::uint32_t end = next_blocks(slice.pauses() ? 32 : 256);
  const bool chooses = skips_.negligible && bounces_ > 0 && bounces_ % k_same_links == 0;
  over_blocks(block_, end, [&](std::uint32_t sample, Tracer& tracer) {
    if (chooses) {
      choose_links(sample);
    }
    const std::uint32_t links = links_read_[sample];
    tracer.counters.skipped_negligible += links < hemispheres_->link_count(records_[sample]) ? 1 : 0;
    incoming_[sample] = hemispheres_->gather(records_[sample], radiosity_, links);
  });
  block_ = end;
  if (block_ >= blocks_->count()) {
    block_ = 0;
    ++bounces_;
    end_bounce();
    stats_.shots += surface->patch_count();
  }
}

}  // namespace radvor
