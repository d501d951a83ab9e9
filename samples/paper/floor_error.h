// Error of a baked floor against the exact one, at random points: over the floor, and within one coarse cell of the
// shadow's edge.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "floor_bake.h"

namespace paper {

struct FloorError {
  std::size_t sites = 0;
  double floor = 0;      ///< rms over the mean irradiance of the floor
  double near_edge = 0;  ///< the same of the points within one coarse cell of the edge, over the same mean
  double largest = 0;    ///< over the same mean
};

class FloorPoints {
 public:
  FloorPoints(const Experiment& experiment, std::size_t count, double edge_distance);
  FloorError error_of(const FloorBake& bake) const;

 private:
  std::vector<glm::dvec2> points_;
  std::vector<double> exact_;
  std::vector<bool> near_edge_;
  double mean_ = 0;
};

}  // namespace paper
