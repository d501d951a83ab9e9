// The state of a bake and the steps of its loop. Each step is a unit of work whose order is fixed, small enough for a
// time slice.
//
//   direct -> hemispheres -> account -> standouts -> bounces -> done
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <optional>
#include <vector>

#include "radiosity/bake.h"
#include "radiosity/direct_light.h"
#include "radiosity/gather.h"
#include "radiosity/occluder_tree.h"
#include "radiosity/receiver.h"
#include "radiosity/receiver_blocks.h"
#include "radiosity/tracer.h"

namespace radvor {

class Solver {
 public:
  Solver(Scene given, const BakeOptions& wanted, const VisibilityMaker& maker, Host& lender);

  enum class Stage { direct, hemispheres, account, standouts, bounces, done };
  Stage stage() const { return stage_; }
  void step();

  BakeStats stats() const;

  Host& host;
  const BakeOptions options;
  const Scene scene;
  std::optional<WeldedScene> welded;
  std::optional<Facets> facets;
  std::optional<Surface> surface;
  std::pmr::vector<Color> direct, indirect;  ///< irradiance of each sample
  double seconds = 0;                        ///< spent since the beginning
  double converged = 0;                      ///< 0..1, never falls
  double seconds_direct = 0, seconds_indirect = 0;
  const BakeStats& counters() const { return stats_; }

 private:
  void shine();
  void look_around();
  void account();
  void shoot_standout();
  void lose(std::uint32_t share, const Color& radiosity);
  bool begin_bounce();
  void bounce();

  template <class Work>
  void over_blocks(std::uint32_t begin, std::uint32_t end, Work&& work);
  std::uint32_t next_blocks(std::uint32_t per_thread) const;
  double unshot_luminance() const;
  void report_convergence();

  std::pmr::vector<std::uint32_t> occluders_;  // welded triangle of each triangle that blocks
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
  std::optional<ReceiverBlocks> blocks_;
  std::pmr::vector<std::uint32_t> records_;   // of each sample, in hemispheres_
  std::pmr::vector<Color> unshot_;            // irradiance that each share has not reflected yet
  std::pmr::vector<glm::vec3> radiosity_;     // of each share: what is being shot
  std::pmr::vector<Color> incoming_;          // irradiance of the bounce under way, each sample
  std::pmr::vector<std::uint8_t> stood_out_;  // patches that have shot by themselves

  Stage stage_ = Stage::direct;
  std::uint32_t source_ = 0;  // of the direct stage
  std::uint32_t block_ = 0;   // next block of what is under way
  std::uint32_t bounces_ = 0;
  double previous_unshot_ = 0, first_unshot_ = 0;
  BakeStats stats_;
};

}  // namespace radvor
