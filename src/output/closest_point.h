// Where on the surfaces is the point nearest to this one, on a side that faces its way?
#pragma once

#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>

#include "base/vector.h"
#include "scene/box_tree.h"
#include "scene/closest_weights.h"

namespace radvor {

struct ClosestPoint {
  static constexpr std::uint32_t k_nothing = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t triangle = k_nothing;
  bool back = false;    ///< found on the side where the corners run clockwise
  Vec3 weights{0.0};    ///< barycentric, of the triangle's corners; none negative, they sum to 1 within rounding
  double distance = 0;  ///< scene units
};

class ClosestPoints {
 public:
  /// corners: 3 a triangle, indices into positions, counter-clockwise about the front; two_sided: 1 a triangle, not 0
  /// where its back counts too. The arrays must outlive this. Triangles without area are never found.
  ClosestPoints(std::span<const Vec3> positions, std::span<const std::uint32_t> corners,
                std::span<const std::uint8_t> two_sided, std::pmr::memory_resource* memory);

  /// The nearest point no farther than max_distance (>= 0, may be infinite) on a side whose normal makes an acute angle
  /// with `normal` (any length; zero finds nothing); sides within a millionth of perpendicular don't face it. Positions
  /// are often floats: of the sides whose distance exceeds the least by no more than float rounding of the position's
  /// coordinates, the one best aligned with the normal wins, then the nearer, then the first. May run on many threads.
  ClosestPoint find(const Vec3& position, const Vec3& normal, double max_distance) const;

 private:
  /// A triangle's nearest point, if a side of it faces the normal.
  struct Candidate {
    ClosestPoint point;
    double alignment;  ///< cosine of the angle between the normals
  };
  bool candidate(std::uint32_t triangle, const Vec3& position, const Vec3& direction, Candidate& result) const;

  std::span<const Vec3> positions_;
  std::span<const std::uint32_t> corners_;
  std::span<const std::uint8_t> two_sided_;
  BoxTree tree_;
};

}  // namespace radvor
