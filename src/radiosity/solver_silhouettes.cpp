// Shadows that no sample and no probe meets: found by rays from the sources, and kept until the mesh tells of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "radiosity/method.h"
#include "radiosity/solver.h"

namespace radvor {

namespace {

constexpr double k_noticed = 1e-4;  // of the goal: a shadow's share of the squared error that is worth keeping

}  // namespace

void Solver::cast_shadows() {
  const std::uint32_t count = silhouettes_->block_count();
  const std::uint32_t end = std::min(count, block_ + 16 * host.jobs.thread_count());
  std::pmr::vector<std::optional<CastShadow>> shadows(std::size_t{end - block_} * Silhouettes::k_block, &host.memory);
  over(block_, end, [&](std::uint32_t block, Tracer& tracer) {
    silhouettes_->cast(
        block, tracer,
        std::span(shadows).subspan(std::size_t{block - block_} * Silhouettes::k_block, Silhouettes::k_block));
  });
  silhouettes_->keep(shadows);
  block_ = end;
  if (block_ == count) {
    block_ = 0;
    casts_ = silhouettes_->largest_of_each();
    silhouettes_.reset();
    stage_ = Stage::shadows;
  }
}

// Where the corners of a shadow's triangle do not tell of it by themselves. No shadow takes more than the mesh has
// there: that alone, without a ray, settles most.
void Solver::judge_shadows() {
  const double mean = mean_of(direct);
  const double noticed = k_noticed * receiving_area();
  const auto judge = [&](const CastShadow& cast, Tracer& tracer) -> std::optional<Shadowed> {
    const FacetPoint point = surface->locate(cast.facet, cast.at);
    std::array<std::uint32_t, 3> around;
    std::array<Vec3, 3> corners;
    double lit = 0;  // by all sources
    for (std::size_t i = 0; i < 3; ++i) {
      around[i] = sample_of(point.shares[i], cast.back);
      corners[i] = surface->sites()[surface->samples()[around[i]].site].position;
      lit += point.weights[i] * sum(direct[around[i]]) / 3;
    }
    const double area =
        std::min(cast.area, 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])));
    // A shadow is darker than the mesh has it: what is brighter than that is not for shadows to tell.
    const auto matters = [&](double found, double expected) {
      return expected > found && score_of(found, expected, mean, area) > noticed;
    };
    const auto from_source = [&](const Receiver& to) {
      Sight sight;
      return sum(light_->irradiance(cast.source, to, tracer, sight)) / 3;
    };
    if (!matters(0, lit)) {
      return {};
    }
    Receiver receiver = cast.receiver;
    receiver.leeway = leeway_of(area);
    const double found = from_source(receiver);
    if (!matters(found, lit)) {
      return {};
    }
    if (light_->source_count() > 1) {
      double expected = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        expected += point.weights[i] * from_source(receivers_[around[i]]);
      }
      if (!matters(found, expected)) {
        return {};
      }
    }
    return Shadowed{cast.facet, cast.back, cast.at, area, punctual_light(receiver, tracer)};
  };
  constexpr std::uint32_t k_block = 64;
  const auto count = static_cast<std::uint32_t>((casts_.size() + k_block - 1) / k_block);
  const std::uint32_t end = slice.pauses() ? std::min(count, block_ + 4 * host.jobs.thread_count()) : count;
  const std::size_t first = std::size_t{block_} * k_block;
  std::pmr::vector<std::optional<Shadowed>> judged(std::min(casts_.size(), std::size_t{end} * k_block) - first,
                                                   &host.memory);
  over(block_, end, [&](std::uint32_t block, Tracer& tracer) {
    const std::size_t stop = std::min<std::size_t>(casts_.size(), std::size_t{block + 1} * k_block);
    for (std::size_t k = std::size_t{block} * k_block; k < stop; ++k) {
      judged[k - first] = judge(casts_[k], tracer);
    }
  });
  for (const std::optional<Shadowed>& place : judged) {
    if (place) {
      shadowed_.push_back(*place);
    }
  }
  block_ = end;
  if (block_ == count) {
    block_ = 0;
    casts_ = std::pmr::vector<CastShadow>(&host.memory);
    stage_ = Stage::probes;
  }
}

// Squared error over an area, in units of the goal's.
double Solver::score_of(double found, double expected, double mean, double area) const {
  const double relative = mean > 0 ? (found - expected) / (k_share_of_mesh * options.tolerance * mean) : 0;
  return relative * relative * area;
}

}  // namespace radvor
