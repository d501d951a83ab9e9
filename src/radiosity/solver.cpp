// Progressive refinement after Cohen et al. (1988), the paper's [5].
#include "radiosity/solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/hash.h"
#include "radiosity/fate.h"
#include "radiosity/links.h"
#include "radiosity/refinement_plan.h"
#include "radiosity/shooting_tree.h"
#include "radiosity/smoothing.h"
#include "scene/find_contacts.h"
#include "surface/near_contacts.h"

namespace radvor {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double k_pi = 3.14159265358979323846;

// A patch shoots by itself, once, while it has this share of all unshot power, and so many times its even share. In a
// room of few patches none stands out, and links make every later bounce cheaper than one such shot.
constexpr double k_stands_out = 0.02;
constexpr double k_times_even_share = 16;
constexpr double k_share_of_mesh = 0.5;  // of the tolerance: what the mesh may get wrong of direct light
constexpr double k_probed = 0.1;         // of the squared tolerance: share of the area that a triangle is probed from
constexpr double k_noise = 2;            // standard errors of a hemisphere of one ray; they fall by N^(-3/4)
constexpr double k_local = 5;            // tolerances that a place may be off relative to its own light
constexpr double k_reach = 3;            // times the root of the tolerance: how far light is taken, over what is near
constexpr double k_same_way = 0.95;      // cosine between normals of which one may take the other's light
constexpr double k_share_left_unshot = 0.01;  // of the tolerance: may be missing when the bake has converged

double sum(const Color& color) {
  return color.r + color.g + color.b;
}

constexpr SampleOrigin k_unanchored = {{k_none, k_none, k_none}, {0, 0, 0}, false};

constexpr double k_rays = 4;  // over the tolerance, where all samples have the same area
constexpr double k_least_rays = 48, k_most_rays = 8192;

}  // namespace

Solver::Solver(Scene given, const BakeOptions& wanted, const VisibilityMaker& maker, Host& lender)
    : host(lender),
      options(wanted),
      scene(std::move(given)),
      direct(&host.memory),
      indirect(&host.memory),
      occluders_(&host.memory),
      visibility_(nullptr, Unmake{maker, host}),
      receivers_(&host.memory),
      sights_(&host.memory),
      anchors_(&host.memory),
      records_(&host.memory),
      outlooks_(&host.memory),
      first_bounce_(&host.memory),
      pending_(&host.memory),
      interpolated_(&host.memory),
      unshot_(&host.memory),
      radiosity_(&host.memory),
      incoming_(&host.memory),
      stood_out_(&host.memory),
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
  resolve_gaps(*surface, spacing, options.spacing.max_sites, &host.memory);

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
  place_receivers();
  records_.assign(samples.size(), k_none);
  outlooks_.assign(samples.size(), Outlook{});
  first_bounce_.assign(samples.size(), Color(0.0));
  unprobed_.assign(samples.size(), 1);
  pending_.resize(samples.size());
  std::iota(pending_.begin(), pending_.end(), 0u);
  blocks_.emplace(*surface, receivers_, pending_, host);
  hemispheres_.emplace(scene, *facets, occluders_, sum(light_->sky_radiance()) > 0, host);
  stats_.seconds_setup = std::chrono::duration<double>(Clock::now() - begin).count();
  seconds = stats_.seconds_setup;
}

void Solver::step() {
  switch (stage_) {
    case Stage::direct:
      shine();
      break;
    case Stage::refinement:
      refine();
      break;
    case Stage::probes:
      probe();
      break;
    case Stage::hemispheres:
      look_around();
      break;
    case Stage::account:
      account();
      break;
    case Stage::standouts:
      shoot_standout();
      break;
    case Stage::bounces:
      bounce();
      break;
    case Stage::finish:
      finish();
      break;
    case Stage::done:
      break;
  }
  report_convergence();
}

// Runs work(sample, tracer) for a range of blocks of receivers.
template <class Work>
void Solver::over_blocks(std::uint32_t begin, std::uint32_t end, Work&& work) {
  over(begin, end, [&](std::uint32_t block, Tracer& tracer) {
    for (const std::uint32_t sample : blocks_->block(block)) {
      work(sample, tracer);
    }
  });
}

// Runs work(index, tracer) in parallel and sums up what was done.
template <class Work>
void Solver::over(std::uint32_t begin, std::uint32_t end, Work&& work) {
  std::pmr::vector<TransportCounters> counters(end - begin, &host.memory);
  host.jobs.for_each(end - begin, [&](std::uint32_t index) {
    Tracer tracer(*visibility_);
    work(begin + index, tracer);
    counters[index] = tracer.counters;
  });
  for (const TransportCounters& counter : counters) {
    stats_.rays += counter.rays;
    stats_.form_factors += counter.form_factors;
    stats_.skipped_facing += counter.skipped_facing;
    stats_.skipped_negligible += counter.skipped_negligible;
    stats_.skipped_clear += counter.skipped_clear;
    stats_.seconds_rays += counter.ray_seconds;
  }
}

std::uint32_t Solver::next_blocks(std::uint32_t per_thread) const {
  return std::min(blocks_->count(), block_ + per_thread * host.jobs.thread_count());
}

void Solver::place_receivers() {
  receivers_.clear();
  receivers_.reserve(surface->samples().size());
  for (const Sample& sample : surface->samples()) {
    receivers_.push_back({sample.point, sample.point + sample.facet_normal * visibility_->lift(), sample.normal});
  }
}

// Direct light of one source on some blocks of receivers.
void Solver::shine() {
  if (source_ == light_->source_count()) {
    stage_ = looking_ ? Stage::hemispheres : Stage::refinement;
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

// Raises the mesh's level where the light so far demands it; the new samples' light is next. Where it demands nothing
// more, the next kind of light is due.
void Solver::refine() {
  std::pmr::vector<Color> light(direct, &host.memory);
  for (std::size_t i = 0; i < light.size(); ++i) {
    light[i] += first_bounce_[i];
  }
  if (options.spacing.refines && round_ < 2 * surface->max_level()) {
    const double mean = mean_of(light);
    const RefinementGoal goal{k_share_of_mesh * options.tolerance, k_local * options.tolerance, mean,
                              surface->sites().size()};
    if (mean > 0 && raise(plan_refinement(*surface, {light, sights_}, goal, host))) {
      return;
    }
  }
  if (options.spacing.refines) {
    stage_ = Stage::probes;
  } else if (looking_) {
    stage_ = Stage::account;
  } else {
    begin_looking();
  }
}

// The mean irradiance over all receiving sides, three channels as one.
double Solver::mean_of(std::span<const Color> irradiance) const {
  double received = 0, area = 0;
  const auto samples = surface->samples();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    received += samples[i].area * sum(irradiance[i]) / 3;
    area += samples[i].area;
  }
  return area > 0 ? received / area : 0;
}

// Whether there are new samples, whose direct light is then next.
bool Solver::raise(std::span<const std::uint32_t> raised) {
  const std::uint32_t most = options.spacing.max_sites;
  if (raised.empty() || (most != 0 && surface->sites().size() >= most)) {
    return false;
  }
  const std::pmr::vector<Share> before(surface->shares().begin(), surface->shares().end(), &host.memory);
  std::pmr::vector<std::uint32_t> before_sites(&host.memory);
  before_sites.reserve(direct.size());
  for (const Sample& sample : surface->samples()) {
    before_sites.push_back(sample.site);
  }
  const auto origins = surface->refine(raised, most);
  follow(before, before_sites, origins);
  if (pending_.empty()) {
    return false;
  }
  ++round_;
  source_ = 0;
  stage_ = Stage::direct;
  return true;
}

void Solver::begin_looking() {
  looking_ = true;
  round_ = 0;
  pending_.resize(direct.size());
  std::iota(pending_.begin(), pending_.end(), 0u);
  std::fill(unprobed_.begin(), unprobed_.end(), std::uint8_t{1});
  share_out_rays();
  stage_ = Stage::hemispheres;
}

// The light that is being followed, in the middle of triangles. A triangle that is wrong by the mean irradiance is
// worth its share of the area against the squared tolerance: smaller ones than a tenth of that are not looked into.
void Solver::probe() {
  if (block_ == 0) {
    place_probes_due();
  }
  const auto count = static_cast<std::uint32_t>((probes_.size() + ReceiverBlocks::k_size - 1) / ReceiverBlocks::k_size);
  const std::uint32_t end = std::min(count, block_ + 4 * host.jobs.thread_count());
  const Color sky = k_pi * light_->sky_radiance();
  over(block_, end, [&](std::uint32_t block, Tracer& tracer) {
    const std::size_t stop = std::min<std::size_t>(probes_.size(), std::size_t{block + 1} * ReceiverBlocks::k_size);
    for (std::size_t k = std::size_t{block} * ReceiverBlocks::k_size; k < stop; ++k) {
      const Probe& probe = probes_[k];
      if (looking_) {
        const std::uint64_t seed = hash(options.seed, std::uint64_t{round_} + 1, k);
        const Outlook outlook =
            hemispheres_->glance(probe.receiver, probe_rays(), seed, *surface, radiosity_, tracer, probed_[k]);
        probed_[k] += outlook.open * sky;
        continue;
      }
      for (std::uint32_t source = 0; source < light_->source_count(); ++source) {
        Sight sight;
        probed_[k] += light_->irradiance(source, probe.receiver, tracer, sight);
      }
    }
  });
  block_ = end;
  if (block_ < count) {
    return;
  }
  block_ = 0;
  if (round_ < 3 * surface->max_level() && raise(wrong_between())) {
    return;
  }
  if (looking_) {
    stage_ = Stage::account;
  } else {
    begin_looking();
  }
}

std::uint32_t Solver::probe_rays() const {
  return std::bit_ceil(
      static_cast<std::uint32_t>(std::clamp(k_rays / 2 / options.tolerance, k_least_rays, k_most_rays)));
}

void Solver::place_probes_due() {
  double area = 0;
  for (const Sample& sample : surface->samples()) {
    area += sample.area;
  }
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
  const Color sky = k_pi * light_->sky_radiance();
  const double noise = looking_ ? k_noise * std::pow(probe_rays(), -0.75) : 0;
  struct Wrong {
    double score;
    std::uint32_t probe;
  };
  std::pmr::vector<Wrong> wrong(&host.memory);
  double left = 0, area = 0;
  for (const Sample& sample : samples) {
    area += sample.area;
  }
  for (std::uint32_t k = 0; k < probes_.size() && mean > 0; ++k) {
    const Probe& probe = probes_[k];
    double expected = 0;
    for (const std::uint32_t sample : probe.samples) {
      expected += sum(looking_ ? outlooks_[sample].open * sky + first_bounce_[sample] : direct[sample]) / 9;
    }
    const double found = sum(probed_[k]) / 3;
    const double error = std::max(0.0, std::abs(found - expected) - noise * std::max(found, expected));
    const double relative = error / (k_share_of_mesh * options.tolerance * mean);
    const double score = relative * relative * probe.area;
    left += score;
    wrong.push_back({score, k});
  }
  std::sort(wrong.begin(), wrong.end(),
            [](const Wrong& a, const Wrong& b) { return a.score != b.score ? a.score > b.score : a.probe < b.probe; });
  std::pmr::vector<std::uint32_t> raised(&host.memory);
  std::pmr::vector<std::uint8_t> is_raised(surface->sites().size(), 0, &host.memory);
  for (const Wrong& of : wrong) {
    if (left <= area) {
      break;
    }
    left -= of.score;
    for (const std::uint32_t sample : probes_[of.probe].samples) {
      const std::uint32_t site = samples[sample].site;
      if (is_raised[site] == 0) {
        is_raised[site] = 1;
        raised.push_back(site);
      }
    }
  }
  return raised;
}

namespace {

template <class Value>
void renumber(std::pmr::vector<Value>& values, std::span<const SampleOrigin> origins, const Value& unknown) {
  std::pmr::vector<Value> now(origins.size(), unknown, values.get_allocator());
  for (std::size_t i = 0; i < origins.size(); ++i) {
    if (origins[i].kept) {
      now[i] = values[origins[i].samples[0]];
    }
  }
  values.swap(now);
}

}  // namespace

// Renumbers what is known of samples and shares after a refinement; new samples are pending.
void Solver::follow(std::span<const Share> before, std::span<const std::uint32_t> before_sites,
                    std::span<const SampleOrigin> origins) {
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
  for (const std::uint32_t sample : pending_) {
    anchors_[sample] = origins[sample];
  }
  for (SampleOrigin& anchor : anchors_) {
    bool all = anchor.samples[0] != k_none;
    for (std::size_t k = 0; all && k < 3; ++k) {
      anchor.samples[k] = now[anchor.samples[k]];
      all = anchor.samples[k] != k_none;
    }
    if (!all) {
      anchor = k_unanchored;
    }
  }
  renumber(direct, origins, Color(0.0));
  renumber(sights_, origins, std::uint64_t{0});
  renumber(records_, origins, k_none);
  renumber(outlooks_, origins, Outlook{});
  renumber(first_bounce_, origins, Color(0.0));
  renumber(unprobed_, origins, std::uint8_t{1});
  std::size_t still = 0;
  for (const std::uint32_t sample : interpolated_) {
    if (now[sample] != k_none) {
      interpolated_[still++] = now[sample];
    }
  }
  interpolated_.resize(still);
  indirect.assign(origins.size(), Color(0.0));

  hemispheres_->renumber(shares_now(before, before_sites, now));
  place_receivers();
  blocks_.emplace(*surface, receivers_, pending_, host);
}

// The number of each old share: the one of the same facet and side in its sample. Where a sample is no more (a facet
// too thin to be triangulated anew takes its sectors apart), one of the same facet and side at the same site.
std::pmr::vector<std::uint32_t> Solver::shares_now(std::span<const Share> before,
                                                   std::span<const std::uint32_t> before_sites,
                                                   std::span<const std::uint32_t> now) const {
  const auto shares = surface->shares();
  const auto samples = surface->samples();
  std::pmr::vector<std::uint32_t> share_now(before.size(), k_none, &host.memory);
  std::pmr::vector<std::uint32_t> orphans(&host.memory);
  for (std::uint32_t s = 0; s < before.size(); ++s) {
    std::uint32_t share = now[before[s].sample] == k_none ? k_none : samples[now[before[s].sample]].first_share;
    while (share != k_none && (shares[share].facet != before[s].facet || shares[share].back != before[s].back)) {
      share = shares[share].next_in_sample;
    }
    share_now[s] = share;
    if (share == k_none) {
      orphans.push_back(s);
    }
  }
  if (orphans.empty()) {
    return share_now;
  }
  std::pmr::vector<std::uint32_t> first_at_site(surface->sites().size(), k_none, &host.memory);
  std::pmr::vector<std::uint32_t> next_at_site(shares.size(), k_none, &host.memory);
  std::pmr::vector<std::uint32_t> any_of_facet(facets->facets.size(), k_none, &host.memory);
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    const std::uint32_t site = samples[shares[s].sample].site;
    next_at_site[s] = first_at_site[site];
    first_at_site[site] = s;
    any_of_facet[shares[s].facet] = s;
  }
  for (const std::uint32_t s : orphans) {
    std::uint32_t share = first_at_site[before_sites[before[s].sample]];
    while (share != k_none && (shares[share].facet != before[s].facet || shares[share].back != before[s].back)) {
      share = next_at_site[share];
    }
    share_now[s] = share != k_none ? share : any_of_facet[before[s].facet];
  }
  return share_now;
}

// Which pending samples of a level look around by themselves; the others take from their anchors. After Ward et al., A
// ray tracing solution for diffuse interreflection (1988): light from all around changes over the distance of what is
// seen.
void Solver::begin_level() {
  const auto samples = surface->samples();
  const auto sites = surface->sites();
  const bool lazy = (options.disable & Disable::lazy) == 0;
  const double most = k_reach * std::sqrt(options.tolerance);
  std::pmr::vector<std::uint32_t> looking(&host.memory);
  for (const std::uint32_t i : pending_) {
    if (sites[samples[i].site].level != level_) {
      continue;
    }
    const SampleOrigin& anchor = anchors_[i];
    bool looks = !lazy || anchor.samples[0] == k_none;
    for (std::size_t k = 0; !looks && k < 3; ++k) {
      const std::uint32_t other = anchor.samples[k];
      if (anchor.weights[k] > 0) {
        const double nearness = outlooks_[other].inverse_distance;
        looks = glm::distance(receivers_[i].point, receivers_[other].point) * nearness > most ||
                glm::dot(samples[i].normal, samples[other].normal) < k_same_way;
      }
    }
    if (looks) {
      looking.push_back(i);
      continue;
    }
    Outlook& own = outlooks_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const Outlook& other = outlooks_[anchor.samples[k]];
      const double weight = anchor.weights[k];
      own.open += weight * other.open;
      own.backs += weight * other.backs;
      own.inverse_distance += weight * other.inverse_distance;
    }
    interpolated_.push_back(i);
    ++stats_.skipped_lazy;
  }
  std::uint32_t record = hemispheres_->add(static_cast<std::uint32_t>(looking.size()));
  for (const std::uint32_t sample : looking) {
    records_[sample] = record++;
  }
  blocks_.emplace(*surface, receivers_, looking, host);
}

// How many rays a sample's hemisphere is worth: of all ways to spend them, in proportion to the root of the area leaves
// the least area-weighted squared error. As much of it is left as by k_rays / tolerance for each sample.
void Solver::share_out_rays() {
  double roots = 0, area = 0;
  for (const Sample& sample : surface->samples()) {
    roots += std::sqrt(sample.area);
    area += sample.area;
  }
  rays_per_length_ = area > 0 ? k_rays / options.tolerance * roots / area : 0;
}

// A power of two, so that they are a net.
std::uint32_t Solver::rays_for(double area) const {
  const double wanted = std::clamp(rays_per_length_ * std::sqrt(area), k_least_rays, k_most_rays);
  return std::bit_ceil(static_cast<std::uint32_t>(wanted));
}

// What some blocks of pending receivers see of their hemispheres.
void Solver::look_around() {
  if ((options.disable & Disable::indirect) != 0 && sum(light_->sky_radiance()) <= 0) {
    stage_ = Stage::account;
    return;
  }
  if (block_ == 0) {
    begin_level();
  }
  const std::uint32_t end = next_blocks(4);
  over_blocks(block_, end, [&](std::uint32_t sample, Tracer& tracer) {
    const std::uint32_t record = records_[sample];
    hemispheres_->trace(record, receivers_[sample], rays_for(surface->samples()[sample].area),
                        hash(options.seed, record), *surface, tracer);
    outlooks_[sample] = hemispheres_->outlook(record);
  });
  block_ = end;
  if (block_ < blocks_->count()) {
    return;
  }
  block_ = 0;
  if (++level_ <= surface->max_level()) {
    return;
  }
  level_ = 0;
  const Color sky = k_pi * light_->sky_radiance();
  for (const std::uint32_t i : pending_) {
    direct[i] += outlooks_[i].open * sky;
  }
  if ((options.disable & Disable::indirect) == 0) {
    see_first_bounce();
  }
  stage_ = Stage::refinement;
}

// What pending samples get by one reflection of direct light.
void Solver::see_first_bounce() {
  const auto shares = surface->shares();
  radiosity_.resize(shares.size());
  for (std::size_t s = 0; s < shares.size(); ++s) {
    radiosity_[s] = glm::vec3(shares[s].albedo * direct[shares[s].sample]);
  }
  constexpr std::uint32_t k_block = 256;
  const auto count = static_cast<std::uint32_t>(pending_.size());
  host.jobs.for_each((count + k_block - 1) / k_block, [&](std::uint32_t block) {
    for (std::uint32_t k = block * k_block; k < std::min(count, (block + 1) * k_block); ++k) {
      if (records_[pending_[k]] != k_none) {
        first_bounce_[pending_[k]] = hemispheres_->gather(records_[pending_[k]], radiosity_);
      }
    }
  });
  interpolate(interpolated_, first_bounce_);
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

// What the sources emitted and lost; what surfaces have to reflect.
void Solver::account() {
  const FateMeter meter(scene, *welded, *visibility_, occluders_, options.seed);
  const FateMeter::Powers powers = meter.of_sources(*light_, host);
  stats_.emitted_power = powers.emitted;
  stats_.escaped_power = powers.escaped;
  stats_.absorbed_back_power = powers.backs;
  stats_.rays += powers.rays;
  const auto shares = surface->shares();
  unshot_.reserve(shares.size());
  for (const Share& share : shares) {
    unshot_.push_back(direct[share.sample]);
  }
  incoming_.assign(receivers_.size(), Color(0.0));
  pending_.clear();
  for (std::uint32_t i = 0; i < records_.size(); ++i) {
    if (records_[i] != k_none) {
      pending_.push_back(i);
    }
  }
  blocks_.emplace(*surface, receivers_, pending_, host);
  radiosity_.assign(shares.size(), glm::vec3(0.0f));
  first_unshot_ = previous_unshot_ = unshot_luminance();
  if ((options.disable & Disable::indirect) != 0 || first_unshot_ <= 0) {
    stage_ = Stage::finish;
    return;
  }
  stood_out_.assign(surface->patch_count(), 0);
  stage_ = options.max_bounces == 0 ? Stage::standouts : Stage::bounces;
}

double Solver::unshot_luminance() const {
  double power = 0;
  const auto shares = surface->shares();
  for (std::size_t s = 0; s < shares.size(); ++s) {
    power += shares[s].area * luminance(shares[s].albedo * unshot_[s]);
  }
  return power;
}

// Shoots the patch of largest unshot power at all receivers, while one stands out: few rays would meet it.
void Solver::shoot_standout() {
  const auto shares = surface->shares();
  double total = 0, largest = 0;
  std::uint32_t patch = k_none;
  for (std::uint32_t p = 0; p < surface->patch_count(); ++p) {
    double power = 0;
    for (const std::uint32_t s : surface->patch(p)) {
      power += shares[s].area * luminance(shares[s].albedo * unshot_[s]);
    }
    total += power;
    if (power > largest && stood_out_[p] == 0) {
      largest = power;
      patch = p;
    }
  }
  const double even_share = 1.0 / std::max(1u, surface->patch_count());
  if (patch == k_none || largest < std::max(k_stands_out, k_times_even_share * even_share) * total) {
    stage_ = Stage::bounces;
    return;
  }
  stood_out_[patch] = 1;
  const ShootingTree tree(*surface, std::span(&patch, 1), host);
  std::pmr::vector<NodeLight> light(tree.nodes().size(), NodeLight{}, &host.memory);
  for (const Element& element : tree.elements()) {
    light[element.node].radiosity = shares[element.share].albedo * unshot_[element.share];
    lose(element.share, light[element.node].radiosity);
    unshot_[element.share] = Color(0.0);
  }
  tree.pull(light, host);

  LinkAccuracy accuracy;
  accuracy.least_rays = 8;
  over_blocks(0, blocks_->count(), [&](std::uint32_t sample, Tracer& tracer) {
    LinkMaker maker(tree, occluder_tree_ ? &*occluder_tree_ : nullptr, accuracy, &host.memory);
    std::pmr::vector<Link> links(&host.memory);
    maker.make(receivers_[sample], tree.roots(), {}, tracer, links);
    incoming_[sample] = Color(0.0);
    for (const Link& link : links) {
      incoming_[sample] += sent_along(link, light);
    }
  });
  interpolate(interpolated_, incoming_);
  for (std::size_t i = 0; i < incoming_.size(); ++i) {
    indirect[i] += incoming_[i];
  }
  for (std::size_t s = 0; s < shares.size(); ++s) {
    unshot_[s] += incoming_[shares[s].sample];
  }
  ++stats_.shots;
}

// What does not come back of a share's shot.
void Solver::lose(std::uint32_t share, const Color& radiosity) {
  const Share& shot = surface->shares()[share];
  const Outlook& outlook = outlooks_[shot.sample];
  stats_.escaped_power += shot.area * sum(radiosity) * outlook.open;
  stats_.absorbed_back_power += shot.area * sum(radiosity) * outlook.backs;
}

// Decides whether another bounce is due; takes what is unshot as what is shot.
bool Solver::begin_bounce() {
  const double left = unshot_luminance();
  const auto samples = surface->samples();
  double received = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    received += samples[i].area * luminance(direct[i] + indirect[i]);
  }
  // What is left goes on as a geometric series; its ratio is that of the last two bounces.
  const double ratio = bounces_ > 0 && previous_unshot_ > 0 ? std::min(0.99, left / previous_unshot_) : 0.5;
  previous_unshot_ = left;
  if (left <= 0 || left / (1 - ratio) <= k_share_left_unshot * options.tolerance * received ||
      (options.max_bounces != 0 && bounces_ >= options.max_bounces)) {
    return false;
  }
  const auto shares = surface->shares();
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    const Color sent = shares[s].albedo * unshot_[s];
    radiosity_[s] = glm::vec3(sent);
    lose(s, sent);
  }
  return true;
}

// All shares together, on some blocks of receivers.
void Solver::bounce() {
  if (block_ == 0 && !begin_bounce()) {
    stage_ = Stage::finish;
    return;
  }
  const std::uint32_t end = next_blocks(256);
  over_blocks(block_, end, [&](std::uint32_t sample, Tracer&) {
    incoming_[sample] = hemispheres_->gather(records_[sample], radiosity_);
  });
  block_ = end;
  if (block_ >= blocks_->count()) {
    block_ = 0;
    ++bounces_;
    interpolate(interpolated_, incoming_);
    for (std::size_t i = 0; i < incoming_.size(); ++i) {
      indirect[i] += incoming_[i];
    }
    const auto shares = surface->shares();
    for (std::size_t s = 0; s < shares.size(); ++s) {
      unshot_[s] = incoming_[shares[s].sample];
    }
    stats_.shots += surface->patch_count();
  }
}

// What hemispheres say of sky and surfaces is freed of noise. What was interpolated follows its anchors.
void Solver::settle_noise() {
  std::pmr::vector<Certainty> certain(direct.size(), Certainty{}, &host.memory);
  std::pmr::vector<Color> sky_light(direct.size(), Color(0.0), &host.memory);
  std::pmr::vector<Color> punctual(direct.size(), Color(0.0), &host.memory);
  const Color sky = k_pi * light_->sky_radiance();
  const double reach = k_reach * std::sqrt(options.tolerance);
  for (std::size_t i = 0; i < direct.size(); ++i) {
    const Outlook& outlook = outlooks_[i];
    sky_light[i] = outlook.open * sky;
    punctual[i] = direct[i] - sky_light[i];
    certain[i].reach = reach / std::max(outlook.inverse_distance, 1e-300);
    certain[i].noise = records_[i] == k_none ? 0 : std::pow(outlook.weight, 0.75);
  }
  smooth(*surface, certain, indirect, host);
  for (std::size_t i = 0; i < direct.size(); ++i) {  // a sky that is open, or hidden, is so for certain
    certain[i].noise *= outlooks_[i].open > 0 && outlooks_[i].open < 1 ? 1 : 0;
  }
  smooth(*surface, certain, sky_light, host);
  interpolate(interpolated_, indirect);
  interpolate(interpolated_, sky_light);
  for (std::size_t i = 0; i < direct.size(); ++i) {
    if (sky_light[i] != outlooks_[i].open * sky) {  // else to the bit as it was
      direct[i] = glm::max(punctual[i], Color(0.0)) + sky_light[i];
    }
  }
}

// Noise is settled, and where the triangulation is free its edges follow the light.
void Solver::finish() {
  stage_ = Stage::done;
  settle_noise();
  if ((options.disable & Disable::tie_alignment) != 0) {
    return;
  }
  std::pmr::vector<double> values(&host.memory);
  values.reserve(direct.size());
  for (std::size_t i = 0; i < direct.size(); ++i) {
    values.push_back(luminance(direct[i] + indirect[i]));
  }
  const Ties ties = surface->align_ties(values, options.tie_tolerance);
  stats_.ties = ties.count;
  stats_.realigned_ties = ties.realigned;
}

// Half of the way is direct light, a quarter the hemispheres; the rest is the logarithm of what is left.
void Solver::report_convergence() {
  double now = 0;
  const double part = static_cast<double>(block_) / std::max(1u, blocks_->count());
  switch (stage_) {
    case Stage::direct:
      now = 0.4 * (source_ + part) / std::max(1u, light_->source_count());
      break;
    case Stage::refinement:
    case Stage::probes:
      now = 0.4;
      break;
    case Stage::hemispheres:
      now = 0.4 + 0.4 * part;
      break;
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
