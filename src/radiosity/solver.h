// The state of a bake and the steps of its loop. Each step is a unit of work whose order is fixed, small enough for a
// time slice or, like what plans and makes the mesh, such that it can be left off in between.
//
//   (glimpse, where there is a sky);
//   direct -> refinement, remake -> (once) silhouettes -> shadows -> probes, again while they raise sites;
//   hemispheres -> first bounce -> refinement, remake -> probes, with direct before, again while they raise sites;
//   fit -> account -> standouts -> bounces -> finish
//
// Light of sources that have a place or a direction is exact at every sample, and the mesh follows it, level by level,
// or two levels where few sites are left. Then samples look around for sky and the other surfaces. What comes from all
// around is smooth but near other surfaces: finer samples take it from the coarser ones that they lie between, unless
// something is near. The mesh follows again.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <optional>
#include <vector>

#include "base/steps.h"
#include "radiosity/bake.h"
#include "radiosity/direct_light.h"
#include "radiosity/gather.h"
#include "radiosity/occluder_tree.h"
#include "radiosity/probes.h"
#include "radiosity/receiver.h"
#include "radiosity/receiver_blocks.h"
#include "radiosity/silhouettes.h"
#include "radiosity/tracer.h"

namespace radvor {

/// Of a task that does little to each sample.
inline constexpr std::size_t k_samples_a_task = 4096;

class Solver {
 public:
  Solver(Scene given, const BakeOptions& wanted, const VisibilityMaker& maker, Host& lender);

  enum class Stage {
    glimpse,
    direct,
    refinement,
    remake,
    silhouettes,
    shadows,
    probes,
    hemispheres,
    first_bounce,
    fit,
    account,
    standouts,
    bounces,
    finish,
    done
  };
  Stage stage() const { return stage_; }
  /// Light of sources with a place or a direction is done.
  bool looks_around() const { return looking_; }
  void step();

  /// For a bake that is shown between slices: whether there is a guess to make at what it shows until the sources have
  /// shone on the first samples, and a unit of work on it. It goes nowhere else, and its rays are not counted.
  bool guesses() const;
  void guess();

  /// What direct_meanwhile() gives from now on; for as long as there is no other step.
  void show();
  void show_no_more();
  std::span<const Color> direct_meanwhile() const;

  BakeStats stats() const;

  Host& host;
  const BakeOptions options;
  const Scene scene;
  std::optional<WeldedScene> welded;
  std::optional<Facets> facets;
  std::optional<Surface> surface;
  std::pmr::vector<Color> direct, indirect;  ///< irradiance of each sample
  std::pmr::vector<Color> fit;               ///< added to direct where triangles interpolate; empty: nothing
  Pace slice;  ///< where step() pauses; then its units of work are smaller, though more threads wait at their ends
  double seconds = 0;    ///< spent since the beginning
  double converged = 0;  ///< 0..1, never falls
  double seconds_direct = 0, seconds_indirect = 0;
  const BakeStats& counters() const { return stats_; }

 private:
  /// What does not come back of a shot, W.
  struct Lost {
    double escaped = 0, on_backs = 0;
    void operator+=(const Lost& other) {
      escaped += other.escaped;
      on_backs += other.on_backs;
    }
  };

  void glimpse();
  void shine();
  void begin_step();
  Steps refine(Pace& pace);
  void end_refinement();
  Steps remake(Pace& pace);
  void end_remake();
  void cast_shadows();
  void judge_shadows();
  double score_of(double found, double expected, double mean, double area) const;
  void probe();
  void end_probes();
  std::uint32_t probe_rays() const;
  void place_probes_due();
  std::pmr::vector<std::uint32_t> wrong_between() const;
  void begin_looking();
  Steps follow(const std::optional<SharesBefore>& before, std::span<const SampleOrigin> origins, Pace& pace);
  // function(sample) for what guess() does in one of its blocks.
  template <class Function>
  void for_each_to_guess(std::uint32_t block, Function&& function) const;
  template <class Value>
  void renumber(std::pmr::vector<Value>& values, std::span<const SampleOrigin> origins, const Value& unknown);
  void keep_interpolated(std::span<const std::uint32_t> now);
  void begin_level();
  bool differ(const SampleOrigin& anchor) const;
  void share_out_rays(double scale);
  std::uint32_t rays_for(std::uint32_t sample) const;
  void look_from(std::uint32_t sample, std::uint32_t rays, Tracer& tracer);
  std::uint32_t rays_by_sky(std::span<const std::uint32_t, 3> around, float glimpsed) const;
  Steps look_around(Pace& pace);
  void see_first_bounce();
  bool catch_up();
  void reflect_direct();
  void sound_out_noise();
  void interpolate(std::span<const std::uint32_t> samples, std::pmr::vector<Color>& values) const;
  Steps account(Pace& pace);
  Steps shoot_standout(Pace& pace);
  Lost lost_of(std::uint32_t share, const Color& radiosity) const;
  void lose(const Lost& lost);
  bool begin_bounce();
  void add_series(double ratio_of_all);
  void choose_links(std::uint32_t sample);
  void bounce();
  void end_bounce();
  double noise_of(std::uint32_t record, double spread) const;
  void measure_spreads();
  double noise_of_sky(std::uint32_t sample) const;
  Steps free_of_noise(std::pmr::vector<Color>& reflected, std::pmr::vector<Color>& sky, double bend, Pace& pace) const;
  Steps settle_surroundings(Pace& pace);
  std::pmr::vector<Color> sky_light() const;
  Steps settle_noise(Pace& pace);
  Steps finish(Pace& pace);
  Steps align_ties(Pace& pace);
  void place_fit_probes();
  Steps fit_between(Pace& pace);
  Color punctual_light(const Receiver& receiver, Tracer& tracer) const;

  // Runs work(sample, tracer) for a range of blocks of receivers, as so many tasks a block: where a block is much work,
  // threads wait for the last one.
  template <class Work>
  void over_blocks(std::uint32_t begin, std::uint32_t end, Work&& work, std::uint32_t tasks = 1);
  // Runs work(index, tracer) in parallel and sums up what was done.
  template <class Work>
  void over(std::uint32_t begin, std::uint32_t end, Work&& work);
  // Runs work(probe's index, tracer) for the next probes; whether that was all of them.
  template <class Work>
  bool over_probes(Work&& work);
  void count(const TransportCounters& counters);
  double mean_of(std::span<const Color> irradiance) const;
  double receiving_area() const;
  std::uint32_t sample_of(std::uint32_t front_share, bool back) const;
  double seconds_of_pass() const { return k_seconds_of_pass * static_cast<double>(direct.size()); }
  std::uint32_t next_blocks(std::uint32_t per_thread) const;
  double unshot_luminance() const;
  void place_receivers(std::span<const std::uint32_t> samples);
  void move_to_lookouts(std::span<const std::uint32_t> samples);
  void follow_receivers(std::span<const SampleOrigin> origins);
  std::uint64_t move_into_slots(std::span<const std::uint32_t> samples);
  Vec3 way_inside(std::uint32_t sample) const;
  double leeway_of(double area) const;
  Receiver receiver_at(std::uint32_t sample, const Vec3& point) const;
  void report_convergence();

  std::pmr::vector<std::uint32_t> occluders_;  // welded triangle of each triangle that blocks
  const Skips skips_;
  std::optional<OccluderTree> occluder_tree_;  // absent where it is turned off
  struct Unmake {
    VisibilityMaker maker;
    Host& host;
    void operator()(Visibility* made) const { maker.destroy(maker.user, made, host); }
  };
  std::unique_ptr<Visibility, Unmake> visibility_;
  std::optional<DirectLight> light_;
  std::optional<Gather> hemispheres_;

  std::pmr::vector<Receiver> receivers_;
  double mean_area_ = 0;                    // of samples, when receivers were placed last
  double mean_light_ = 0;                   // of all receiving sides, three channels as one, sounded out
  std::pmr::vector<std::uint8_t> in_slot_;  // of each sample: it looks from where a slot's light is its mean
  std::optional<ReceiverBlocks> blocks_;
  std::pmr::vector<std::uint64_t> sights_;        // of each sample: what it sees of the sources
  std::pmr::vector<SampleOrigin> anchors_;        // of each sample that refinement made: the samples it lies between
  std::pmr::vector<std::uint32_t> records_;       // of each sample, in hemispheres_; k_none: takes it from its anchors
  std::uint32_t first_record_ = 0;                // of the level under way
  std::pmr::vector<std::uint32_t> ray_counts_;    // of its records
  std::pmr::vector<std::uint8_t> known_;          // of each sample: whether its outlook is
  std::pmr::vector<Outlook> outlooks_;            // of each sample
  std::pmr::vector<Color> first_bounce_;          // irradiance of each sample, for the mesh to follow
  std::size_t seen_by_all_ = 0;                   // samples that there were when all links were asked for it
  std::pmr::vector<float> spreads_;               // of each record: how its rays differ in what they bring
  std::pmr::vector<std::uint32_t> pending_;       // samples whose light is under way
  std::pmr::vector<std::uint32_t> interpolated_;  // samples without a record, anchors first
  std::pmr::vector<Color> unshot_;                // irradiance that each share has not reflected yet
  std::pmr::vector<glm::vec3> radiosity_;         // of each share: what is being shot
  std::pmr::vector<Color> incoming_;              // irradiance of the bounce under way, each sample
  std::pmr::vector<Color> incoming_before_;       // of the one before
  std::pmr::vector<std::uint32_t> links_read_;    // of each sample's record, by it
  std::pmr::vector<Color> settled_;               // of each sample: from all around, freed of noise; for the mesh
  std::pmr::vector<Color> shot_alone_;            // radiosity of each share that shot in a standout; may be empty
  std::pmr::vector<Color> from_standouts_;        // irradiance of each sample by them; may be empty
  std::pmr::vector<float> glimpsed_;              // of each sample: share of its view that is sky, a guess
  std::pmr::vector<Color> guessed_;               // of the first samples: light of all sources; in guess()'s blocks
  struct DueAgain {
    std::uint32_t sample;
    Color before;
  };
  std::pmr::vector<DueAgain> due_again_;      // of pending samples: direct light, shown until there is the new
  std::pmr::vector<Color> shown_;             // between slices; empty: direct as it is
  std::pmr::vector<std::uint8_t> stood_out_;  // patches that have shot by themselves

  Stage stage_ = Stage::direct;
  std::uint32_t source_ = 0;                // of the direct stage
  std::uint32_t round_ = 0;                 // of refinement
  std::optional<Silhouettes> silhouettes_;  // until they are cast
  std::pmr::vector<std::uint32_t> raised_;  // sites, by the refinement that is planned
  bool raised_by_probes_ = false;           // else by the light at samples: what comes next differs
  std::pmr::vector<CastShadow> casts_;      // to be judged
  std::pmr::vector<Shadowed> shadowed_;
  std::pmr::vector<Probe> probes_;
  std::pmr::vector<Color> probed_;           // irradiance at each probe
  std::pmr::vector<std::uint8_t> unprobed_;  // of each sample: no probe was near it
  double rays_per_length_ = 0;
  bool looking_ = false;              // around: direct light alone has its mesh
  bool sounded_out_ = false;          // how many rays the scene is worth
  std::uint32_t level_ = 0;           // of the hemispheres
  std::uint32_t block_ = 0;           // next block of what is under way
  std::uint32_t guessed_blocks_ = 0;  // of twice all: see for_each_to_guess()
  bool may_guess_ = true;             // memory has not run out over it
  std::uint32_t bounces_ = 0;
  double previous_unshot_ = 0, first_unshot_ = 0;
  std::uint64_t idle_rays_ = 0, rays_before_standouts_ = 0;  // the latter without the former
  BakeStats stats_;
  Steps under_way_;  // works on all of this
};

// What is known of samples, under their new numbers after a refinement.
template <class Value>
void Solver::renumber(std::pmr::vector<Value>& values, std::span<const SampleOrigin> origins, const Value& unknown) {
  std::pmr::vector<Value> now(origins.size(), unknown, values.get_allocator());
  host.jobs.for_ranges(origins.size(), k_samples_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (origins[i].kept) {
        now[i] = values[origins[i].samples[0]];
      }
    }
  });
  values.swap(now);
}

template <class Work>
void Solver::over_blocks(std::uint32_t begin, std::uint32_t end, Work&& work, std::uint32_t tasks) {
  const std::uint32_t size = (ReceiverBlocks::k_size + tasks - 1) / tasks;
  over(tasks * begin, tasks * end, [&](std::uint32_t task, Tracer& tracer) {
    const auto block = blocks_->block(task / tasks);
    const std::size_t first = std::min<std::size_t>(block.size(), std::size_t{task % tasks} * size);
    for (const std::uint32_t sample : block.subspan(first, std::min<std::size_t>(size, block.size() - first))) {
      work(sample, tracer);
    }
  });
}

template <class Work>
void Solver::over(std::uint32_t begin, std::uint32_t end, Work&& work) {
  std::pmr::vector<TransportCounters> counters(end - begin, &host.memory);
  host.jobs.for_each_in_parts(end - begin, [&](std::uint32_t index) {
    Tracer tracer(*visibility_, skips_);
    work(begin + index, tracer);
    counters[index] = tracer.counters;
  });
  for (const TransportCounters& counter : counters) {
    count(counter);
  }
}

template <class Work>
bool Solver::over_probes(Work&& work) {
  constexpr std::uint32_t k_size = ReceiverBlocks::k_size;
  const auto count = static_cast<std::uint32_t>((probes_.size() + k_size - 1) / k_size);
  const std::uint32_t end = std::min(count, block_ + (slice.pauses() ? 1 : 4) * host.jobs.thread_count());
  over(block_, end, [&](std::uint32_t block, Tracer& tracer) {
    const std::size_t stop = std::min<std::size_t>(probes_.size(), std::size_t{block + 1} * k_size);
    for (std::size_t k = std::size_t{block} * k_size; k < stop; ++k) {
      work(k, tracer);
    }
  });
  block_ = end < count ? end : 0;
  return end == count;
}

}  // namespace radvor
