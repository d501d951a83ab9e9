// Which mesh vertices are the same point of the world, and how precisely each point is known.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/vector.h"
#include "scene/scene.h"

namespace radvor {

struct WeldedPositions {
  explicit WeldedPositions(std::pmr::memory_resource* memory)
      : positions(memory), precision(memory), vertex_of(memory) {}

  std::pmr::vector<Vec3> positions;
  std::pmr::vector<double> precision;  ///< how far rounding the input to float may have moved it, world units
  std::pmr::vector<std::pmr::vector<std::uint32_t>> vertex_of;  ///< per mesh, per mesh vertex
};

/// Positions equal to the bit (0 and -0 are equal) become one. Where weld_distance > 0 so do those no farther apart,
/// transitively; of such a cluster the position first in x, then y, then z stands for all, whatever their order.
/// Points number in the order of their first mesh vertex.
WeldedPositions weld_positions(const Scene& scene, double weld_distance, std::pmr::memory_resource* memory);

/// Orders points by x, then y, then z.
inline bool lies_before(const Vec3& a, const Vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

}  // namespace radvor
