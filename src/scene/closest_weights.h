// The point of a triangle nearest to a point in space.
#pragma once

#include "base/vector.h"

namespace radvor {

/// Barycentric coordinates of the point of a triangle nearest to p, degenerate triangles included (Ericson, Real-Time
/// Collision Detection, 5.1.5).
Vec3 closest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace radvor
