// Coordinates in the plane of a facet.
#include <cmath>

#include "scene/facets.h"

namespace radvor {

Vec2 Frame::to_plane(const Vec3& p) const {
  const Vec3 offset = p - origin;
  // unit is a power of two: dividing and multiplying by it is exact.
  return {std::nearbyint(dot(offset, u) / unit) * unit, std::nearbyint(dot(offset, v) / unit) * unit};
}

}  // namespace radvor
