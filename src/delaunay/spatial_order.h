// An order of points in which neighbours come one after another, for insertion.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/vector.h"

namespace radvor::delaunay {

/// A permutation of the points: rounds chosen by a hash, each several times as large as all before, and each along a
/// Hilbert curve. A function of the points and their order alone.
void spatial_order(std::span<const Vec2> points, std::pmr::vector<std::uint32_t>& order,
                   std::pmr::memory_resource* memory);

}  // namespace radvor::delaunay
