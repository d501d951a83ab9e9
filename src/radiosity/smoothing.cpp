#include "radiosity/smoothing.h"

#include <algorithm>
#include <cmath>

#include "base/raw_vector.h"
#include "radiosity/method.h"
#include "radiosity/strata.h"

namespace radvor {

namespace {

constexpr int k_passes = 3;
constexpr int k_rings = 2;            // of neighbours that are asked what noise there is
constexpr double k_explained = 3.5;   // standard errors
constexpr double k_bend = 10;         // of the value, where a neighbour is as far away as what is seen
constexpr double k_alike_bend = 0.1;  // to this bend neighbours see the same, and know what noise there is
constexpr std::size_t k_block = 512;

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

  // By Cramer's rule; false where the points lie on a line, or nearly. variance: of the value, where that of each point
  // is one over its weight.
  bool centre(Color& value, double& variance) const {
    const double a = xx * yy - xy * xy, b = xy * y - x * yy, c = x * xy - xx * y;
    const double determinant = w * a + x * b + y * c;
    if (!(determinant > 1e-3 * w * xx * yy)) {
      return false;
    }
    value = (a * v + b * vx + c * vy) / determinant;
    variance = a / determinant;
    return true;
  }
};

class Smoother {
 public:
  Smoother(const Surface& surface, const SampleNeighbours& neighbours, std::span<const Certainty> certain,
           std::span<Color> values, Host& host)
      : sites_(surface.sites()),
        samples_(surface.samples()),
        certain_(certain),
        values_(values),
        neighbours_(neighbours),
        original_(values.size(), &host.memory),
        before_(values.size(), &host.memory),
        edges_(neighbours.size(), &host.memory),
        pooled_(values.size(), &host.memory),
        noise_(values.size(), &host.memory),
        noise_before_(values.size(), &host.memory),
        host_(host) {
    for_each_sample([&](std::uint32_t i) { original_[i] = values_[i]; });
  }

  Steps run(Pace& pace) {
    measure_edges();
    co_await pace;
    pool_noise();
    co_await pace;
    for_each_sample([&](std::uint32_t i) { noise_[i] = pooled_[i]; });
    for (int pass = 0; pass < k_passes; ++pass) {
      for_each_sample([&](std::uint32_t i) {
        before_[i] = values_[i];
        noise_before_[i] = noise_[i];
      });
      for_each_sample([&](std::uint32_t i) {
        if (!certain_[i].settled && pooled_[i] > 0) {
          move(i);
        }
      });
      co_await pace;
    }
  }

 private:
  struct Edge {
    Vec2 way;  // in the sample's plane
    double bend;
  };

  template <class OnSample>
  void for_each_sample(OnSample&& on_sample) {
    host_.jobs.for_ranges(values_.size(), k_block, [&](std::size_t begin, std::size_t end) {
      for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
        on_sample(i);
      }
    });
  }

  // How neighbours lie to a sample, which every pass asks anew.
  void measure_edges() {
    for_each_sample([&](std::uint32_t i) {
      const Basis basis(samples_[i].normal);
      const Vec3 from = sites_[samples_[i].site].position;
      Edge* edge = edges_.data() + neighbours_.first(i);
      for (const auto& [other, triangles] : neighbours_.of(i)) {
        const Vec3 way = sites_[samples_[other].site].position - from;
        *edge++ = {{glm::dot(way, basis.x), glm::dot(way, basis.y)}, bend(i, other, glm::length(way))};
      }
    });
  }

  // How far light may be from linear between two samples, of the brighter one's value.
  double bend(std::uint32_t a, std::uint32_t b, double distance) const {
    const double steps = 0.5 * (certain_[a].nearness + certain_[b].nearness) * distance;
    const double brighter = std::max({sum(original_[a]), sum(original_[b]), 1e-300});
    const double by_mesh = std::max(certain_[a].most_bend, certain_[b].most_bend) / brighter;
    return std::min(k_bend * steps * steps, by_mesh) + (1 - glm::dot(samples_[a].normal, samples_[b].normal));
  }

  // Relative standard errors by what samples and those around them say of theirs.
  void pool_noise() {
    struct Said {
      double value, variance;
    };
    RawVector<Said> said(values_.size(), &host_.memory), before(values_.size(), &host_.memory);
    for_each_sample([&](std::uint32_t i) {
      const double value = sum(values_[i]), error = certain_[i].noise * value;
      said[i] = {value, error * error};
    });
    for (int ring = 0; ring < k_rings; ++ring) {
      before.swap(said);
      for_each_sample([&](std::uint32_t i) {
        Said all = before[i];
        double weights = 1;
        const Edge* edge = edges_.data() + neighbours_.first(i);
        for (const auto& [other, triangles] : neighbours_.of(i)) {
          const double bent = (edge++)->bend / k_alike_bend, weight = 0.5 * triangles / (1 + bent * bent);
          weights += weight;
          all.value += weight * before[other].value;
          all.variance += weight * before[other].variance;
        }
        said[i] = {all.value / weights, all.variance / weights};
      });
    }
    for_each_sample(
        [&](std::uint32_t i) { pooled_[i] = said[i].value > 0 ? std::sqrt(said[i].variance) / said[i].value : 0; });
  }

  void move(std::uint32_t i) {
    const double own = noise_before_[i] * noise_before_[i];
    const Edge* edge = edges_.data() + neighbours_.first(i);
    Fit fit;
    fit.add(1, Vec2(0.0), before_[i]);
    for (const auto& [other, triangles] : neighbours_.of(i)) {
      const double noise = noise_before_[other];
      const double weight = std::min(own / (noise * noise + edge->bend * edge->bend), 1.0);
      fit.add(0.5 * triangles * weight, edge->way, before_[other]);
      ++edge;
    }
    Color value;
    double variance = 1;
    if (!fit.centre(value, variance)) {
      return;
    }
    value = glm::max(value, Color(0.0));
    const double most = k_explained * pooled_[i] * std::max(sum(original_[i]), sum(value));
    const Color moved = glm::abs(value - original_[i]);
    if (std::max({moved.r, moved.g, moved.b, std::abs(sum(value) - sum(original_[i]))}) <= most) {
      values_[i] = value;
      noise_[i] = noise_before_[i] * std::sqrt(std::min(1.0, variance));
    }
  }

  std::span<const Site> sites_;
  std::span<const Sample> samples_;
  std::span<const Certainty> certain_;
  std::span<Color> values_;
  const SampleNeighbours& neighbours_;
  RawVector<Color> original_, before_;
  RawVector<Edge> edges_;  // as neighbours_ has them
  RawVector<double> pooled_, noise_, noise_before_;
  Host& host_;
};

}  // namespace

Steps smooth(const Surface& surface, const SampleNeighbours& neighbours, std::span<const Certainty> certain,
             std::span<Color> values, Host& host, Pace& pace) {
  Smoother smoother(surface, neighbours, certain, values, host);
  co_await smoother.run(pace);
}

}  // namespace radvor
