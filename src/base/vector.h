// Vectors are GLM's, in double precision; `float` only where measured to be enough (rays, stored results).
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace radvor {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Color = glm::dvec3;  ///< linear RGB

/// Rec. 709 luminance of a linear colour.
inline double luminance(const Color& color) {
  return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
}

inline double cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace radvor
