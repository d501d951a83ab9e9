// Occluders for tests of transport: triangles and quadrilaterals, answered for by brute force.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "radiosity/receiver.h"
#include "radiosity/tracer.h"
#include "visibility/brute_force_visibility.h"

namespace radvor {

struct Plates {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> corners;

  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) {
      corners.push_back(first + corner);
    }
  }

  BruteForceVisibility visibility() const {
    return BruteForceVisibility({positions, corners}, std::pmr::get_default_resource());
  }
};

inline Receiver receiver_at(const Vec3& point, const Vec3& normal, const Visibility& visibility) {
  return {point, point + normal * visibility.lift(), normal};
}

}  // namespace radvor
