// Where a sample takes the light of sources, unless its cell lies in a slot (Solver::place_receivers): moved from its
// site into its cell, because a site on a border lies on its neighbour's plane, where form factors are singular.
#pragma once

#include <span>

#include "base/vector.h"

namespace radvor {

/// How far, of the way to a point in the middle of the cell.
inline constexpr double k_nudge = 1.0 / 32;

/// Inside the cell and off every border. cell: counter-clockwise, star-shaped about the site, which is one of its
/// corners; centroid: the cell's.
Vec2 receiver_point(const Vec2& site, std::span<const Vec2> cell, const Vec2& centroid);

}  // namespace radvor
