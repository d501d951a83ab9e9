// Light at points near the surface.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "output/quantity.h"

namespace radvor {

/// The index that point queries need, built once for a bake: it knows where the surface is, but no light.
class PointIndex {
 public:
  explicit PointIndex(const LitSurface& lit);
  ~PointIndex();
  PointIndex(const PointIndex&) = delete;
  PointIndex& operator=(const PointIndex&) = delete;

  /// The light on the nearest surface that faces along the normal (either side of two-sided ones), at most
  /// max_distance (scene units) away, interpolated linearly over the adaptive mesh. positions, normals and rgb hold 3
  /// a point; found (or null) gets 1 where there is one, else 0 and rgb is 0. Parallel over points.
  void sample(const LitSurface& lit, Quantity quantity, std::uint32_t count, const double* positions,
              const float* normals, double max_distance, float* rgb, std::uint8_t* found) const;

 private:
  struct State;
  State* state_;
  std::pmr::memory_resource* memory_;
};

}  // namespace radvor
