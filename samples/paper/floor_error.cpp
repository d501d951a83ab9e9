#include "floor_error.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace paper {

FloorPoints::FloorPoints(const Experiment& experiment, std::size_t count, double edge_distance) {
  std::mt19937_64 random(1992);
  const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (std::size_t i = 0; i < count; ++i) {
    const double x = unit();
    const glm::dvec2 point(x, unit());
    points_.push_back(point);
    exact_.push_back(experiment.irradiance(point));
    near_edge_.push_back(experiment.distance_to_shadow_edge(point) < edge_distance);
    mean_ += exact_.back() / static_cast<double>(count);
  }
}

FloorError FloorPoints::error_of(const FloorBake& bake) const {
  const std::vector<double> baked = bake.measure(points_);
  FloorError error;
  error.sites = bake.floor().sites.size();
  double squares = 0, edge_squares = 0;
  std::size_t edge_count = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double difference = std::abs(baked[i] - exact_[i]) / mean_;
    squares += difference * difference;
    error.largest = std::max(error.largest, difference);
    if (near_edge_[i]) {
      edge_squares += difference * difference;
      ++edge_count;
    }
  }
  error.floor = std::sqrt(squares / static_cast<double>(points_.size()));
  error.near_edge = std::sqrt(edge_squares / static_cast<double>(std::max<std::size_t>(1, edge_count)));
  return error;
}

}  // namespace paper
