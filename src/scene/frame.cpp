// Coordinates in the plane of a facet.
#include <cmath>

#include "scene/facets.h"

namespace radvor {

Vec2 Frame::to_plane(const Vec3& p) const {
  const Vec3 offset = p - origin;
  return snapped({dot(offset, u), dot(offset, v)});
}

Vec2 Frame::snapped(const Vec2& p) const {
  // unit is a power of two: dividing and multiplying by it is exact.
  return {std::nearbyint(p.x / unit) * unit, std::nearbyint(p.y / unit) * unit};
}

}  // namespace radvor
