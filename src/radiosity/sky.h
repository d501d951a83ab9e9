// The sky: constant radiance from every direction that leads out of the scene.
#pragma once

#include <memory_resource>
#include <vector>

#include "radiosity/receiver.h"
#include "radiosity/tracer.h"

namespace radvor {

class Sky {
 public:
  /// tolerance sets the number of strata: 32 x 32 at 0.02, enough that a window of a thousandth of the hemisphere is
  /// not missed.
  Sky(double tolerance, std::pmr::memory_resource* memory);

  /// The cosine-weighted share of the hemisphere that is open, 0..1: irradiance is pi * radiance * this. Strata of
  /// equal share, refined where neighbours disagree. far: a length that leads out of the scene.
  double open_share(const Receiver& receiver, Tracer& tracer, double far) const;

  int side() const { return side_; }

 private:
  int side_;
  std::pmr::vector<Vec2> coarse_;  ///< points of the unit disk, side * side, row by row
  std::pmr::vector<Vec2> fine_;    ///< 4 a stratum
};

}  // namespace radvor
