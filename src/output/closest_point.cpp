#include "output/closest_point.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radvor {
namespace {

std::pmr::vector<Box> boxes_of(std::span<const Vec3> positions, std::span<const std::uint32_t> corners,
                               std::pmr::memory_resource* memory) {
  std::pmr::vector<Box> boxes(corners.size() / 3, memory);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    boxes[i / 3].add(positions[corners[i]]);
  }
  return boxes;
}

double largest(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

ClosestPoints::ClosestPoints(std::span<const Vec3> positions, std::span<const std::uint32_t> corners,
                             std::span<const std::uint8_t> two_sided, std::pmr::memory_resource* memory)
    : positions_(positions),
      corners_(corners),
      two_sided_(two_sided),
      tree_(boxes_of(positions, corners, memory), memory) {}

bool ClosestPoints::candidate(std::uint32_t triangle, const Vec3& position, const Vec3& direction,
                              Candidate& result) const {
  const std::size_t first = std::size_t{3} * triangle;
  const Vec3& a = positions_[corners_[first]];
  const Vec3& b = positions_[corners_[first + 1]];
  const Vec3& c = positions_[corners_[first + 2]];
  const Vec3 normal = cross(b - a, c - a);
  const double alignment = dot(normal, direction);
  const bool back = alignment < 0;
  constexpr double k_acute = 1e-6;
  const double size = length(normal);
  if (!(std::abs(alignment) > k_acute * size) || (back && two_sided_[triangle] == 0)) {
    return false;
  }
  const Vec3 weights = closest_weights(position, a, b, c);
  const double distance = length(weights.y * (b - a) + weights.z * (c - a) - (position - a));
  result = {{triangle, back, weights, distance}, std::abs(alignment) / size};
  return true;
}

ClosestPoint ClosestPoints::find(const Vec3& position, const Vec3& normal, double max_distance) const {
  const double size = largest(normal);
  if (!(size > 0)) {
    return {};
  }
  const Vec3 direction = normalize(normal / size);

  // A hair over the squared bound, so that rounding of squares cannot hide what is exactly that far.
  const auto squared = [](double distance) { return distance * distance * (1 + 0x1p-40); };
  double least = max_distance;
  bool found = false;
  Candidate one;
  tree_.walk_nearest(
      position, [&] { return squared(least); },
      [&](std::uint32_t triangle) {
        if (candidate(triangle, position, direction, one) && one.point.distance <= least) {
          least = one.point.distance;
          found = true;
        }
      });
  if (!found) {
    return {};
  }
  const double within = std::min(max_distance, least + 0x1p-22 * largest(position));
  Candidate best{{}, -1};
  tree_.walk_nearest(
      position, [&] { return squared(within); },
      [&](std::uint32_t triangle) {
        if (!candidate(triangle, position, direction, one) || one.point.distance > within) {
          return;
        }
        const auto ranks_before = [](const Candidate& x, const Candidate& y) {
          if (x.alignment != y.alignment) {
            return x.alignment > y.alignment;
          }
          return x.point.distance != y.point.distance ? x.point.distance < y.point.distance
                                                      : x.point.triangle < y.point.triangle;
        };
        if (best.point.triangle == ClosestPoint::k_nothing || ranks_before(one, best)) {
          best = one;
        }
      });
  return best.point;
}

}  // namespace radvor
