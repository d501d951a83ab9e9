#include "radiosity/refinement_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/sort.h"
#include "radiosity/facet_ranges.h"

namespace radvor {

namespace {

constexpr double k_step = 0.3;      // RMS of a step's linear interpolation, about 1 / sqrt(12)
constexpr double k_bent = 0.2;      // of how far the edge's difference is from what its ends' gradients say
constexpr double k_unknown = 0.1;   // of the difference, in facets too small to have gradients that say anything
constexpr std::size_t k_small = 4;  // triangles

double mean(const Color& color) {
  return (color.r + color.g + color.b) / 3;
}

struct EdgeError {
  float score;         // squared error over the area, in units of the goal's
  std::uint32_t a, b;  // sites
};

// Both sides of a facet's triangles are looked at; shares are those of one side.
class FacetErrors {
 public:
  FacetErrors(const Surface& surface, const SampledLight& light, const RefinementGoal& goal,
              std::pmr::memory_resource* memory)
      : surface_(surface), light_(light), goal_(goal), gradients_(memory), areas_(memory) {}

  void find(std::uint32_t facet, std::pmr::vector<EdgeError>& errors) {
    const auto triangles = surface_.triangles(facet);
    if (triangles.empty()) {
      return;
    }
    estimate(facet, triangles, false, errors);
    if (surface_.shares()[triangles[0][0]].other_side != k_none) {
      estimate(facet, triangles, true, errors);
    }
  }

 private:
  void estimate(std::uint32_t facet, std::span<const ShareTriangle> triangles, bool back,
                std::pmr::vector<EdgeError>& errors) {
    const auto shares = surface_.shares();
    const auto samples = surface_.samples();
    const auto sites = surface_.sites();
    const Vec3& normal = surface_.facets().facets[facet].frame.normal;
    std::uint32_t first = triangles[0][0], last = first;
    for (const ShareTriangle& triangle : triangles) {
      for (const std::uint32_t share : triangle) {
        first = std::min(first, share);
        last = std::max(last, share);
      }
    }
    gradients_.assign(last - first + 1, Vec3(0.0));
    areas_.assign(last - first + 1, 0.0);
    struct Corner {
      Vec3 position;
      double value;
      std::uint32_t sample;
    };
    const auto corner = [&](std::uint32_t share) {
      const std::uint32_t sample = shares[back ? shares[share].other_side : share].sample;
      return Corner{sites[samples[sample].site].position, mean(light_.irradiance[sample]), sample};
    };
    const auto doubled_area = [&](const std::array<Corner, 3>& c) {
      return glm::dot(normal, glm::cross(c[1].position - c[0].position, c[2].position - c[0].position));
    };
    const auto at = [&](const ShareTriangle& t) { return std::array{corner(t[0]), corner(t[1]), corner(t[2])}; };
    for (const ShareTriangle& triangle : triangles) {
      const auto c = at(triangle);
      const double area = doubled_area(c);
      if (!(area > 0)) {
        continue;
      }
      // Times the area: sum over corners of value times the opposite side, turned.
      Vec3 gradient(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        gradient += c[k].value * glm::cross(normal, c[(k + 2) % 3].position - c[(k + 1) % 3].position);
      }
      for (const std::uint32_t share : triangle) {
        gradients_[share - first] += gradient;
        areas_[share - first] += area;
      }
    }
    for (const ShareTriangle& triangle : triangles) {
      const auto c = at(triangle);
      const double area = doubled_area(c);
      if (!(area > 0)) {
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const Vec3 along = c[next].position - c[k].position;
        const double difference = c[next].value - c[k].value;
        const auto foreseen = [&](std::size_t end) {
          return glm::dot(gradients_[triangle[end] - first], along) / areas_[triangle[end] - first];
        };
        double error = k_bent * (std::abs(difference - foreseen(k)) + std::abs(difference - foreseen(next)));
        if (triangles.size() <= k_small) {
          error = std::max(error, k_unknown * std::abs(difference));
        }
        if (light_.sights[c[k].sample] != light_.sights[c[next].sample]) {
          error = std::max(error, k_step * std::abs(difference));
        }
        const double relative = error / (goal_.tolerance * goal_.mean_irradiance);
        const double score = relative * relative * area / 6;
        if (score > 0) {
          errors.push_back({static_cast<float>(score), samples[c[k].sample].site, samples[c[next].sample].site});
        }
      }
    }
  }

  const Surface& surface_;
  const SampledLight& light_;
  const RefinementGoal& goal_;
  std::pmr::vector<Vec3> gradients_;  // of the facet's shares, times areas_
  std::pmr::vector<double> areas_;
};

}  // namespace

Steps plan_refinement(const Surface& surface, SampledLight light, RefinementGoal goal, Host& host,
                      std::pmr::vector<std::uint32_t>& raised, Pace& pace) {
  std::pmr::memory_resource* memory = &host.memory;
  const EvenRanges ranges = ranges_by_triangles(surface, host);
  std::pmr::vector<std::pmr::vector<EdgeError>> found(ranges.size(), memory);
  const auto estimate = [&](std::uint32_t range, std::uint32_t begin, std::uint32_t end) {
    FacetErrors errors(surface, light, goal, memory);
    for (std::uint32_t facet = begin; facet < end; ++facet) {
      errors.find(facet, found[range]);
    }
  };
  co_await ranges.for_each(host.jobs, estimate, pace);

  // The goal is met where the mean of the scores is 1.
  double area = 0;
  for (const Sample& sample : surface.samples()) {
    area += sample.area;
  }
  std::size_t count = 0;
  for (const auto& errors : found) {
    count += errors.size();
  }
  // Together those below this are worth a tenth of the goal: they need no sorting.
  const double least = 0.1 * area / static_cast<double>(std::max<std::size_t>(count, 1));
  std::pmr::vector<EdgeError> errors(memory);
  double left = 0;
  const std::uint32_t highest = surface.max_level();
  for (const auto& of_task : found) {
    for (const EdgeError& error : of_task) {
      if (surface.level_of(error.a) >= highest && surface.level_of(error.b) >= highest) {
        continue;
      }
      left += error.score;
      if (error.score > least) {
        errors.push_back(error);
      }
    }
    co_await pace;
  }
  sort_side_by_side(errors, host.jobs, [](const EdgeError& x, const EdgeError& y) {
    return x.score != y.score ? x.score > y.score : x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  co_await pace;

  std::pmr::vector<double> at_stake(surface.sites().size(), 0.0, memory);
  for (const EdgeError& error : errors) {
    at_stake[error.a] += error.score;
    at_stake[error.b] += error.score;
  }
  co_await pace;
  std::pmr::vector<std::uint8_t> is_raised(surface.sites().size(), 0, memory);
  for (const EdgeError& error : errors) {
    if (left <= area) {
      break;
    }
    left -= error.score;
    if (is_raised[error.a] || is_raised[error.b]) {
      continue;
    }
    // The end that more is gained at; the lower level first, as an edge is halved by its coarser end.
    const std::uint32_t level_a = surface.level_of(error.a), level_b = surface.level_of(error.b);
    const bool first = level_a != level_b                       ? level_a < level_b
                       : at_stake[error.a] != at_stake[error.b] ? at_stake[error.a] > at_stake[error.b]
                                                                : error.a < error.b;
    const std::uint32_t site = first ? error.a : error.b;
    is_raised[site] = 1;
    raised.push_back(site);
  }
}

}  // namespace radvor
