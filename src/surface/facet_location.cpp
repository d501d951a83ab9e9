#include "surface/facet_location.h"

#include <algorithm>
#include <limits>

#include "surface/triangle_cells.h"

namespace radvor {

namespace {

// Corner weights of the nearest sensible point in the triangle: negative ones are cut off.
std::array<double, 3> clamped_weights(const std::array<Vec2, 3>& corners, const Vec2& point) {
  std::array<double, 3> weights;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] = std::max(doubled_area(point, corners[(k + 1) % 3], corners[(k + 2) % 3]), 0.0);
    sum += weights[k];
  }
  for (double& weight : weights) {
    weight = sum > 0 ? weight / sum : 1.0 / 3;
  }
  return weights;
}

// Relative to the triangle's size: negative outside.
double depth_inside(const std::array<Vec2, 3>& corners, const Vec2& point) {
  const double area = doubled_area(corners[0], corners[1], corners[2]);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    least = std::min(least, doubled_area(point, corners[(k + 1) % 3], corners[(k + 2) % 3]));
  }
  return area > 0 ? least / area : -std::numeric_limits<double>::infinity();
}

}  // namespace

std::array<Vec2, 3> LocatedFacet::corners(const ShareTriangle& triangle) const {
  std::array<Vec2, 3> points;
  for (std::size_t k = 0; k < 3; ++k) {
    points[k] = frame.to_plane(sites[samples[shares[triangle[k]].sample].site].position);
  }
  return points;
}

// The one that the point is farthest inside of, or least outside.
std::size_t LocatedFacet::best_triangle(const Vec2& point) const {
  std::size_t best = 0;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; triangles.size() > 1 && k < triangles.size(); ++k) {
    const double depth = depth_inside(corners(triangles[k]), point);
    if (depth > deepest) {
      deepest = depth;
      best = k;
    }
  }
  return best;
}

// Only the plain triangulation can be asked that.
std::optional<FacetPoint> LocatedFacet::find_roughly(const Vec2& point) const {
  if (!mesh || mesh->ties_are_aligned()) {
    return {};
  }
  FacetPoint rough;
  const std::uint32_t found = mesh->locate_roughly(point, rough.weights);
  if (found == k_none) {
    return {};
  }
  rough.shares = triangles[found];
  return rough;
}

FacetPoint LocatedFacet::locate_exactly(const Vec2& point) const {
  std::size_t best = mesh ? mesh->locate(point) : best_triangle(point);
  if (mesh && mesh->ties_are_aligned()) {
    const auto first = static_cast<std::uint32_t>(best);
    double deepest = depth_inside(corners(triangles[first]), point);
    for (std::uint32_t k = mesh->next_in_polygon(first); k != first; k = mesh->next_in_polygon(k)) {
      const double depth = depth_inside(corners(triangles[k]), point);
      best = depth > deepest ? k : best;
      deepest = std::max(depth, deepest);
    }
  }
  const ShareTriangle& found = triangles[best];
  return {found, clamped_weights(corners(found), point)};
}

FacetPoint LocatedFacet::locate(const Vec2& point) const {
  const std::optional<FacetPoint> rough = find_roughly(point);
  return rough ? *rough : locate_exactly(point);
}

std::optional<FacetPoint> LocatedFacet::find(const Vec2& point) const {
  if (mesh && !mesh->ties_are_aligned()) {
    return find_roughly(point);
  }
  const FacetPoint nearest = locate_exactly(point);
  const bool inside = depth_inside(corners(nearest.shares), point) >= 0;
  return inside ? std::optional(nearest) : std::nullopt;
}

}  // namespace radvor
