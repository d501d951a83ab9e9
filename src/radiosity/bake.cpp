// The loop: light sources first, then what stands out by its unshot power, then everything together, bounce by bounce
// over links that are made once. Progressive refinement after Cohen et al. (1988), the paper's [5].
#include "radiosity/bake.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "radiosity/direct_light.h"
#include "radiosity/fate.h"
#include "radiosity/links.h"
#include "radiosity/occluder_tree.h"
#include "radiosity/receiver.h"
#include "radiosity/receiver_blocks.h"
#include "radiosity/shooting_tree.h"
#include "radiosity/tracer.h"

namespace radvor {

namespace {

using Clock = std::chrono::steady_clock;

// A patch shoots by itself, once, while it has this share of all unshot power, and so many times its even share. In a
// room of few patches none stands out, and links make every later bounce cheaper than one such shot.
constexpr double k_stands_out = 0.02;
constexpr double k_times_even_share = 16;
constexpr double k_share_left_unshot = 0.1;  // of the tolerance: may be missing when the bake has converged

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double sum(const Color& color) {
  return color.r + color.g + color.b;
}

enum class Stage { direct, account, tree, standouts, bounces, done };

}  // namespace

struct Bake::State {
  State(Scene given, const BakeOptions& wanted, const VisibilityMaker& maker, Host& lender);

  Host& host;
  BakeOptions options;
  Scene scene;
  std::optional<WeldedScene> welded;
  std::optional<Facets> facets;
  std::optional<Surface> surface;
  std::pmr::vector<std::uint32_t> occluders;  // welded triangle of each triangle that blocks
  std::optional<OccluderTree> occluder_tree;  // absent where it is turned off
  struct Unmake {
    VisibilityMaker maker;
    Host& host;
    void operator()(Visibility* made) const { maker.destroy(maker.user, made, host); }
  };
  std::unique_ptr<Visibility, Unmake> visibility;
  std::optional<DirectLight> light;
  std::optional<ShootingTree> tree;

  std::pmr::vector<Receiver> receivers;
  std::optional<ReceiverBlocks> blocks;
  std::pmr::vector<Color> direct, indirect;
  std::pmr::vector<Color> unshot;             // irradiance that each share has not reflected yet
  std::pmr::vector<Color> incoming;           // irradiance of the bounce under way, each sample
  std::pmr::vector<NodeLight> radiosity;      // of the tree's nodes: what is being shot
  std::pmr::vector<Fate> fates;               // of the tree's roots
  std::pmr::vector<std::uint8_t> stood_out;   // patches that have shot by themselves
  std::pmr::vector<std::uint32_t> lit_roots;  // roots that reflect anything at all
  struct BlockLinks {
    explicit BlockLinks(std::pmr::memory_resource* memory) : links(memory), first(memory) {}
    std::pmr::vector<Link> links;
    std::pmr::vector<std::uint32_t> first;  // per receiver of the block, and one past the last
  };
  std::pmr::vector<BlockLinks> links;

  Stage stage = Stage::direct;
  std::uint32_t source = 0;  // of the direct stage
  std::uint32_t block = 0;   // next block of the source or bounce under way
  std::uint32_t bounces = 0;
  double previous_unshot = 0, first_unshot = 0;

  BakeStats stats;
  double seconds = 0;
  double converged = 0;

  std::uint32_t block_count() const { return blocks->count(); }

  void step();
  void shine();
  void account();
  void plant();
  void shoot_standout();
  bool begin_bounce();
  void bounce();

  template <class Work>
  void over_blocks(std::uint32_t begin, std::uint32_t end, Work&& work);
  double unshot_luminance() const;
  void report_convergence();
};

Bake::State::State(Scene given, const BakeOptions& wanted, const VisibilityMaker& maker, Host& lender)
    : host(lender),
      options(wanted),
      scene(std::move(given)),
      occluders(&host.memory),
      visibility(nullptr, Unmake{maker, host}),
      receivers(&host.memory),
      direct(&host.memory),
      indirect(&host.memory),
      unshot(&host.memory),
      incoming(&host.memory),
      radiosity(&host.memory),
      fates(&host.memory),
      stood_out(&host.memory),
      lit_roots(&host.memory),
      links(&host.memory) {
  const Clock::time_point begin = Clock::now();
  welded.emplace(weld(scene, options.weld_distance, host));
  facets.emplace(find_facets(scene, *welded, options.crease_angle, host));
  surface.emplace(scene, *welded, *facets, choose_spacing(scene, *welded, *facets, options.spacing), host);

  std::pmr::vector<std::uint32_t> corners(&host.memory);
  for (std::uint32_t t = 0; t < welded->triangles.size(); ++t) {
    const Triangle& triangle = welded->triangles[t];
    if (scene.meshes[triangle.mesh].casts) {
      occluders.push_back(t);
      corners.insert(corners.end(), triangle.vertices.begin(), triangle.vertices.end());
    }
  }
  if ((options.disable & Disable::clear_shafts) == 0) {
    occluder_tree.emplace(Occluders{welded->positions, corners}, &host.memory);
  }
  light.emplace(scene, *welded, *facets, occluder_tree ? &*occluder_tree : nullptr, options.tolerance, host);

  const auto samples = surface->samples();
  direct.assign(samples.size(), Color(0.0));
  indirect.assign(samples.size(), Color(0.0));
  incoming.assign(samples.size(), Color(0.0));
  unshot.assign(surface->shares().size(), Color(0.0));
  receivers.reserve(samples.size());
  visibility.reset(maker.make(maker.user, {welded->positions, corners}, host));
  for (const Sample& sample : samples) {
    receivers.push_back({sample.point, sample.point + sample.facet_normal * visibility->lift(), sample.normal});
  }
  blocks.emplace(*surface, receivers, host);
  stats.seconds_setup = seconds_since(begin);
  seconds = stats.seconds_setup;
}

// Runs work(block, tracer) for a range of blocks in parallel and sums up what was done.
template <class Work>
void Bake::State::over_blocks(std::uint32_t begin, std::uint32_t end, Work&& work) {
  std::pmr::vector<TransportCounters> counters(end - begin, &host.memory);
  host.jobs.for_each(end - begin, [&](std::uint32_t index) {
    Tracer tracer(*visibility);
    work(begin + index, tracer);
    counters[index] = tracer.counters;
  });
  for (const TransportCounters& counter : counters) {
    stats.rays += counter.rays;
    stats.form_factors += counter.form_factors;
    stats.skipped_facing += counter.skipped_facing;
    stats.skipped_negligible += counter.skipped_negligible;
    stats.skipped_clear += counter.skipped_clear;
    stats.seconds_rays += counter.ray_seconds;
  }
}

// One unit of work: small enough for a time slice, its order fixed.
void Bake::State::step() {
  switch (stage) {
    case Stage::direct:
      shine();
      break;
    case Stage::account:
      account();
      break;
    case Stage::tree:
      plant();
      break;
    case Stage::standouts:
      shoot_standout();
      break;
    case Stage::bounces:
      bounce();
      break;
    case Stage::done:
      break;
  }
  report_convergence();
}

// Direct light of one source on some blocks of receivers.
void Bake::State::shine() {
  if (source == light->source_count()) {
    stage = Stage::account;
    return;
  }
  const std::uint32_t end = std::min(block_count(), block + 4 * host.jobs.thread_count());
  over_blocks(block, end, [&](std::uint32_t at, Tracer& tracer) {
    for (const std::uint32_t r : blocks->block(at)) {
      direct[r] += light->irradiance(source, receivers[r], tracer);
    }
  });
  block = end;
  if (block == block_count()) {
    block = 0;
    ++source;
    ++stats.shots;
  }
}

// What the sources emitted and lost; what surfaces have to reflect.
void Bake::State::account() {
  const FateMeter meter(scene, *welded, *visibility, occluders, options.seed);
  const FateMeter::Powers powers = meter.of_sources(*light, host);
  stats.emitted_power = powers.emitted;
  stats.escaped_power = powers.escaped;
  stats.absorbed_back_power = powers.backs;
  stats.rays += powers.rays;
  const auto shares = surface->shares();
  for (std::size_t s = 0; s < shares.size(); ++s) {
    unshot[s] = direct[shares[s].sample];
  }
  first_unshot = previous_unshot = unshot_luminance();
  stage = (options.disable & Disable::indirect) != 0 || first_unshot <= 0 ? Stage::done : Stage::tree;
}

double Bake::State::unshot_luminance() const {
  double power = 0;
  const auto shares = surface->shares();
  for (std::size_t s = 0; s < shares.size(); ++s) {
    power += shares[s].area * luminance(shares[s].albedo * unshot[s]);
  }
  return power;
}

void Bake::State::plant() {
  tree.emplace(*surface, host);
  const auto shares = surface->shares();
  const auto elements = tree->elements();
  for (const std::uint32_t root : tree->roots()) {
    bool reflects = false;
    if (root != k_none) {
      const TreeNode& node = tree->nodes()[root];
      for (std::uint32_t e = node.first_element; e < node.first_element + node.element_count; ++e) {
        reflects = reflects || sum(shares[elements[e].share].albedo) > 0;
      }
    }
    lit_roots.push_back(reflects ? root : k_none);
  }
  stood_out.assign(tree->roots().size(), 0);
  fates.assign(tree->roots().size(), Fate{});
  FateMeter(scene, *welded, *visibility, occluders, options.seed).of_roots(*tree, fates, host);
  stats.rays += std::uint64_t{FateMeter::k_rays_per_root} * fates.size();
  radiosity.assign(tree->nodes().size(), NodeLight{});
  for (std::uint32_t i = 0; i < block_count(); ++i) {
    links.emplace_back(&host.memory);
  }
  stage = options.max_bounces == 0 ? Stage::standouts : Stage::bounces;
}

// Shoots the patch of largest unshot power at all receivers, while one stands out.
void Bake::State::shoot_standout() {
  const auto shares = surface->shares();
  double total = 0, largest = 0;
  std::uint32_t patch = k_none;
  for (std::uint32_t p = 0; p < surface->patch_count(); ++p) {
    double power = 0;
    for (const std::uint32_t s : surface->patch(p)) {
      power += shares[s].area * luminance(shares[s].albedo * unshot[s]);
    }
    total += power;
    if (power > largest && lit_roots[p] != k_none && stood_out[p] == 0) {
      largest = power;
      patch = p;
    }
  }
  const double even_share = 1.0 / std::max(1u, surface->patch_count());
  if (patch == k_none || largest < std::max(k_stands_out, k_times_even_share * even_share) * total) {
    stage = Stage::bounces;
    return;
  }
  stood_out[patch] = 1;
  const std::uint32_t root = lit_roots[patch];
  std::fill(radiosity.begin(), radiosity.end(), NodeLight{});
  const TreeNode& node = tree->nodes()[root];
  double power = 0;
  for (std::uint32_t e = node.first_element; e < node.first_element + node.element_count; ++e) {
    const Element& element = tree->elements()[e];
    radiosity[element.node].radiosity = shares[element.share].albedo * unshot[element.share];
    power += shares[element.share].area * sum(radiosity[element.node].radiosity);
    unshot[element.share] = Color(0.0);
  }
  tree->pull(radiosity, host);
  stats.escaped_power += power * fates[patch].escaped;
  stats.absorbed_back_power += power * fates[patch].backs;

  LinkAccuracy accuracy;
  accuracy.least_rays = 8;  // more is at stake than where everything shoots together
  over_blocks(0, block_count(), [&](std::uint32_t at, Tracer& tracer) {
    LinkMaker maker(*tree, occluder_tree ? &*occluder_tree : nullptr, accuracy, &host.memory);
    std::pmr::vector<Link> own(&host.memory);
    for (const std::uint32_t r : blocks->block(at)) {
      own.clear();
      maker.make(receivers[r], std::span(&root, 1), {}, tracer, own);
      incoming[r] = Color(0.0);
      for (const Link& link : own) {
        incoming[r] += sent_along(link, radiosity);
      }
      indirect[r] += incoming[r];
    }
  });
  for (std::size_t s = 0; s < shares.size(); ++s) {
    unshot[s] += incoming[shares[s].sample];
  }
  ++stats.shots;
}

// Decides whether another bounce is due; loads the tree with what it shoots.
bool Bake::State::begin_bounce() {
  const double left = unshot_luminance();
  const auto samples = surface->samples();
  double received = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    received += samples[i].area * luminance(direct[i] + indirect[i]);
  }
  // What is left goes on as a geometric series; its ratio is that of the last two bounces.
  const double ratio = bounces > 0 && previous_unshot > 0 ? std::min(0.99, left / previous_unshot) : 0.5;
  previous_unshot = left;
  if (left <= 0 || left / (1 - ratio) <= k_share_left_unshot * options.tolerance * received ||
      (options.max_bounces != 0 && bounces >= options.max_bounces)) {
    return false;
  }
  const auto shares = surface->shares();
  std::fill(radiosity.begin(), radiosity.end(), NodeLight{});
  for (std::uint32_t p = 0; p < surface->patch_count(); ++p) {
    if (tree->roots()[p] == k_none) {
      continue;
    }
    const TreeNode& root = tree->nodes()[tree->roots()[p]];
    double power = 0;
    for (std::uint32_t e = root.first_element; e < root.first_element + root.element_count; ++e) {
      const Element& element = tree->elements()[e];
      radiosity[element.node].radiosity = shares[element.share].albedo * unshot[element.share];
      power += shares[element.share].area * sum(radiosity[element.node].radiosity);
    }
    stats.escaped_power += power * fates[p].escaped;
    stats.absorbed_back_power += power * fates[p].backs;
  }
  tree->pull(radiosity, host);
  return true;
}

// All patches together, on some blocks of receivers. The first bounce makes the links.
void Bake::State::bounce() {
  if (block == 0 && !begin_bounce()) {
    stage = Stage::done;
    return;
  }
  const bool first = bounces == 0;
  const LinkAccuracy accuracy;
  const std::uint32_t end = std::min(block_count(), block + (first ? 1 : 256) * host.jobs.thread_count());
  over_blocks(block, end, [&](std::uint32_t at, Tracer& tracer) {
    BlockLinks& own = links[at];
    const auto block_receivers = blocks->block(at);
    if (first) {
      LinkMaker maker(*tree, occluder_tree ? &*occluder_tree : nullptr, accuracy, &host.memory);
      own.links.clear();
      own.first.assign(1, 0);
      std::pmr::vector<std::uint8_t> clear(&host.memory);
      if (occluder_tree) {
        blocks->find_clear_roots(at, *tree, lit_roots, *occluder_tree, visibility->lift(), clear);
      }
      for (const std::uint32_t r : block_receivers) {
        maker.make(receivers[r], lit_roots, clear, tracer, own.links);
        own.first.push_back(static_cast<std::uint32_t>(own.links.size()));
      }
      own.links.shrink_to_fit();
    }
    for (std::size_t k = 0; k < block_receivers.size(); ++k) {
      const std::uint32_t r = block_receivers[k];
      Color gathered(0.0);
      for (std::uint32_t i = own.first[k]; i < own.first[k + 1]; ++i) {
        gathered += sent_along(own.links[i], radiosity);
      }
      incoming[r] = gathered;
      indirect[r] += gathered;
    }
  });
  block = end;
  if (block == block_count()) {
    block = 0;
    ++bounces;
    const auto shares = surface->shares();
    for (std::size_t s = 0; s < shares.size(); ++s) {
      unshot[s] = incoming[shares[s].sample];
    }
    stats.shots += surface->patch_count();
  }
}

// Half of the way is direct light and the first bounce, by blocks done; the rest is the logarithm of what is left.
void Bake::State::report_convergence() {
  double now = 0;
  const double all = std::max(1u, block_count());
  if (stage == Stage::done) {
    now = 1;
  } else if (stage == Stage::direct) {
    now = 0.2 * (source + block / all) / std::max(1u, light->source_count());
  } else if (stage == Stage::bounces && bounces == 0) {
    now = 0.25 + 0.5 * block / all;
  } else if (stage == Stage::bounces) {
    const double goal = std::log(k_share_left_unshot * options.tolerance);
    const double made = first_unshot > 0 ? std::log(std::max(previous_unshot / first_unshot, 1e-300)) : goal;
    now = 0.75 + 0.25 * std::clamp(made / goal, 0.0, 0.99);
  } else {
    now = 0.2;
  }
  converged = std::max(converged, now);
}

Bake::Bake(Scene scene, const BakeOptions& options, const VisibilityMaker& visibility, Host& host) {
  void* storage = host.memory.allocate(sizeof(State), alignof(State));
  try {
    state_ = new (storage) State(std::move(scene), options, visibility, host);
  } catch (...) {
    host.memory.deallocate(storage, sizeof(State), alignof(State));
    throw;
  }
}

Bake::~Bake() {
  Host& lender = state_->host;
  state_->~State();
  lender.memory.deallocate(state_, sizeof(State), alignof(State));
}

BakeStatus Bake::advance(double seconds, const ProgressCallback& callback) {
  const Clock::time_point begin = Clock::now();
  const double before = state_->seconds;
  BakeStatus status = BakeStatus::converged;
  bool moved = false;  // every slice does a unit of work, however short it is: a sequence of them comes to its end
  while (state_->stage != Stage::done) {
    const Clock::time_point unit = Clock::now();
    const bool on_direct = state_->stage == Stage::direct || state_->stage == Stage::account;
    if (callback.call && callback.call(callback.user, progress())) {
      status = BakeStatus::cancelled;
      break;
    }
    const double spent = seconds_since(begin);
    if ((seconds > 0 && moved && spent >= seconds) ||
        (state_->options.max_seconds > 0 && before + spent >= state_->options.max_seconds)) {
      status = BakeStatus::time_spent;
      break;
    }
    state_->step();
    moved = true;
    (on_direct ? state_->stats.seconds_direct : state_->stats.seconds_indirect) += seconds_since(unit);
    state_->seconds = before + seconds_since(begin);
  }
  if (status == BakeStatus::converged && callback.call) {
    callback.call(callback.user, progress());
  }
  return status;
}

const Scene& Bake::scene() const {
  return state_->scene;
}
const WeldedScene& Bake::welded() const {
  return *state_->welded;
}
const Facets& Bake::facets() const {
  return *state_->facets;
}
const Surface& Bake::surface() const {
  return *state_->surface;
}
const BakeOptions& Bake::options() const {
  return state_->options;
}
Host& Bake::host() const {
  return state_->host;
}
std::span<const Color> Bake::direct() const {
  return state_->direct;
}
std::span<const Color> Bake::indirect() const {
  return state_->indirect;
}

BakeProgress Bake::progress() const {
  return {static_cast<std::uint32_t>(state_->surface->sites().size()), state_->stats.shots, state_->stats.rays,
          state_->seconds, state_->converged};
}

BakeStats Bake::stats() const {
  BakeStats stats = state_->stats;
  const auto shares = state_->surface->shares();
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const Share& share = shares[s];
    const Color received = state_->direct[share.sample] + state_->indirect[share.sample];
    stats.absorbed_power += share.area * sum((1.0 - share.albedo) * received);
    stats.unshot_power += share.area * sum(share.albedo * state_->unshot[s]);
  }
  return stats;
}

}  // namespace radvor
