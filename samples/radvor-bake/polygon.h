// Polygons to triangles, for faces as files have them: concave, not planar, with collinear or repeated corners.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace bake {

/// Triangles index corners and wind as the polygon does. A quad is cut along the diagonal inside it, and where both
/// are along the shorter one; larger polygons lose an ear at a time (Meisters 1975) in the projection along the axis
/// nearest to their normal. A vertex that is collinear with its neighbours stays a corner of a triangle, so that
/// faces beside this one still match.
///
/// Returns false where the polygon crosses itself or has no area: then triangles is the best that could be had, and
/// may be empty.
bool triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace bake
