// Do the triangles of a would-be facet cover some place twice?
#pragma once

#include <array>
#include <memory_resource>
#include <span>

#include "base/vector.h"

namespace radvor {

/// Triangles counter-clockwise. Overlaps no deeper than `tolerance` (T-junctions are joined to within it) don't count.
bool triangles_overlap(std::span<const std::array<Vec2, 3>> triangles, double tolerance,
                       std::pmr::memory_resource* memory);

}  // namespace radvor
