#include "surface/receiver_point.h"

#include <algorithm>
#include <cmath>

namespace radvor {

namespace {

constexpr double k_pi = 3.14159265358979324;

// Of the boundary in a direction (unit) from the site; 0 where rounding hides it.
double distance_to_boundary(const Vec2& site, std::span<const Vec2> cell, const Vec2& direction) {
  double nearest = 0;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Vec2 from = cell[k] - site;
    const Vec2 side = cell[(k + 1) % cell.size()] - cell[k];
    const double slope = cross(direction, side);
    if (slope > 0) {  // the boundary runs counter-clockwise: it is met from inside
      const double distance = cross(from, side) / slope;
      const double along = cross(from, direction) / slope;
      if (distance > 0 && along >= 0 && along <= 1) {
        nearest = nearest > 0 ? std::min(nearest, distance) : distance;
      }
    }
  }
  return nearest;
}

}  // namespace

Vec2 receiver_point(const Vec2& site, std::span<const Vec2> cell, const Vec2& centroid) {
  const auto at = static_cast<std::size_t>(std::find(cell.begin(), cell.end(), site) - cell.begin());
  if (at == cell.size()) {
    return site;  // not a corner: inside, where nothing is singular
  }
  // The angle between the cell's two sides at the site.
  double angle = 0;
  const Vec2 first = cell[(at + 1) % cell.size()] - site;
  for (std::size_t k = 1; k + 1 < cell.size(); ++k) {
    const Vec2 from = cell[(at + k) % cell.size()] - site;
    const Vec2 to = cell[(at + k + 1) % cell.size()] - site;
    angle += std::atan2(cross(from, to), glm::dot(from, to));
  }
  Vec2 middle = centroid;
  if (angle > k_pi * (1 + 1e-9)) {
    // At a reflex corner, or the tip of a slit, the centroid may lie on a border or beyond it: take the bisector.
    const double length = glm::length(first);
    const Vec2 unit = length > 0 ? first / length : Vec2(1, 0);
    const double half = 0.5 * angle;
    const Vec2 bisector(unit.x * std::cos(half) - unit.y * std::sin(half),
                        unit.x * std::sin(half) + unit.y * std::cos(half));
    middle = site + 0.5 * distance_to_boundary(site, cell, bisector) * bisector;
  }
  return site + k_nudge * (middle - site);
}

}  // namespace radvor
