// Point sets that are hard in their own ways, and a form in which triangulations can be compared.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "delaunay/triangulation.h"

namespace radvor::delaunay::testing {

struct PointSet {
  const char* name;
  std::vector<Vec2> (*make)(std::size_t count, std::uint32_t seed);
};

/// Uniform, lattices, circles, collinear runs, one-ulp jitter, clusters, huge and tiny, duplicates.
std::vector<PointSet> point_sets();

/// Positions of the corners of all real triangles, sorted: the same for the same triangulation.
std::vector<std::array<double, 6>> canonical_triangles(const Triangulation& triangulation);

}  // namespace radvor::delaunay::testing
