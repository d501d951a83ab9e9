#include "radiosity/smoothing.h"

#include <array>
#include <cmath>
#include <vector>

namespace radvor {

namespace {

constexpr double k_explained = 2.5;  // standard errors

// Sums for the plane value + a x + b y through points about (0, 0), weighted.
struct Fit {
  double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  Color v{0.0}, vx{0.0}, vy{0.0};

  void add(double weight, const Vec2& at, const Color& value) {
    w += weight;
    x += weight * at.x;
    y += weight * at.y;
    xx += weight * at.x * at.x;
    xy += weight * at.x * at.y;
    yy += weight * at.y * at.y;
    v += weight * value;
    vx += weight * at.x * value;
    vy += weight * at.y * value;
  }

  // By Cramer's rule; false where the points lie on a line, or nearly.
  bool centre(Color& value) const {
    const double a = xx * yy - xy * xy, b = xy * y - x * yy, c = x * xy - xx * y;
    const double determinant = w * a + x * b + y * c;
    if (!(determinant > 1e-3 * w * xx * yy)) {
      return false;
    }
    value = (a * v + b * vx + c * vy) / determinant;
    return true;
  }
};

class FacetSmoother {
 public:
  FacetSmoother(const Surface& surface, std::span<const Certainty> certain, std::span<const Color> values,
                std::span<Color> smoothed, std::pmr::memory_resource* memory)
      : surface_(surface), certain_(certain), values_(values), smoothed_(smoothed), fits_(memory) {}

  void smooth(std::uint32_t facet, bool back) {
    const auto triangles = surface_.triangles(facet);
    const auto shares = surface_.shares();
    const auto samples = surface_.samples();
    const auto sites = surface_.sites();
    const Frame& frame = surface_.facets().facets[facet].frame;
    if (triangles.empty() || (back && shares[triangles[0][0]].other_side == k_none)) {
      return;
    }
    std::uint32_t first = triangles[0][0], last = first;
    for (const ShareTriangle& triangle : triangles) {
      for (const std::uint32_t share : triangle) {
        first = std::min(first, share);
        last = std::max(last, share);
      }
    }
    fits_.assign(last - first + 1, Fit{});
    const auto sample_of = [&](std::uint32_t share) { return shares[back ? shares[share].other_side : share].sample; };
    for (const ShareTriangle& triangle : triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t own = sample_of(triangle[k]);
        const Vec3& here = sites[samples[own].site].position;
        for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3}) {
          const std::uint32_t neighbour = sample_of(triangle[other]);
          const Vec3 apart = sites[samples[neighbour].site].position - here;
          const double reach = std::min(certain_[own].reach, certain_[neighbour].reach);
          const double weight = 1 - glm::length(apart) / std::max(reach, 1e-300);
          if (weight > 0) {  // interior edges come twice: half a weight each
            fits_[triangle[k] - first].add(0.5 * weight, {glm::dot(apart, frame.u), glm::dot(apart, frame.v)},
                                           values_[neighbour]);
          }
        }
      }
    }
    for (std::uint32_t share = first; share <= last; ++share) {
      const std::uint32_t sample = sample_of(share);
      Fit& fit = fits_[share - first];
      const bool shared = shares[samples[sample].first_share].next_in_sample != k_none;
      if (fit.w == 0 || shared || certain_[sample].noise <= 0) {
        continue;
      }
      fit.add(1, Vec2(0.0), values_[sample]);
      Color value;
      if (!fit.centre(value)) {
        continue;
      }
      for (int channel = 0; channel < 3; ++channel) {
        const double own = values_[sample][channel];
        if (std::abs(value[channel] - own) <= k_explained * certain_[sample].noise * std::max(own, value[channel])) {
          smoothed_[sample][channel] = std::max(0.0, value[channel]);
        }
      }
    }
  }

 private:
  const Surface& surface_;
  std::span<const Certainty> certain_;
  std::span<const Color> values_;
  std::span<Color> smoothed_;
  std::pmr::vector<Fit> fits_;  // of the facet's shares
};

}  // namespace

void smooth(const Surface& surface, std::span<const Certainty> certain, std::span<Color> values, Host& host) {
  const std::pmr::vector<Color> before(values.begin(), values.end(), &host.memory);
  const auto count = static_cast<std::uint32_t>(surface.facets().facets.size());
  constexpr std::uint32_t k_task = 64;
  host.jobs.for_each((count + k_task - 1) / k_task, [&](std::uint32_t task) {
    FacetSmoother smoother(surface, certain, before, values, &host.memory);
    for (std::uint32_t facet = task * k_task; facet < std::min(count, (task + 1) * k_task); ++facet) {
      smoother.smooth(facet, false);
      smoother.smooth(facet, true);
    }
  });
}

}  // namespace radvor
