// Which mesh vertices are the same point of the world, and how precisely each point is known.
#pragma once

#include <algorithm>
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

/// A triangle no higher than this over its longest side has no plane, as rounding the input may tilt it by ten degrees.
/// A vertex no farther than this from a segment lies on it. One bound for both, so that dropping a sliver leaves a
/// T-junction where the sliver's apex lies on its longest side, and never a crack. Takes the sum of the precisions of
/// the three positions; what is closer than weld_distance touches anyway.
inline double touching_distance(double precisions, double weld_distance) {
  constexpr double k_roundings = 4;  // three exact corners take 1; the rest is for tools that compute in float
  return std::max(k_roundings * precisions, weld_distance);
}

/// Positions equal to the bit (0 and -0 are equal) become one. Where weld_distance > 0 so do those no farther apart,
/// transitively. So do, even without it, the ends of sides of triangles that are shorter than touching: slivers all,
/// which would leave edges too short to mean anything. Of such a cluster the position first in x, then y, then z stands
/// for all, whatever their order. Points number in the order of their first mesh vertex.
WeldedPositions weld_positions(const Scene& scene, double weld_distance, std::pmr::memory_resource* memory);

/// Orders points by x, then y, then z.
inline bool lies_before(const Vec3& a, const Vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

}  // namespace radvor
