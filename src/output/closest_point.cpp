#include "output/closest_point.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radvor {
namespace {

constexpr double k_least_facing = 0.01;  // cosine

std::pmr::vector<Box> boxes_of(const std::pmr::vector<ClosestPoint::Triangle>& triangles,
                               std::pmr::memory_resource* memory) {
  std::pmr::vector<Box> boxes(triangles.size(), memory);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const Vec3& corner : triangles[i].corners) {
      boxes[i].add(corner);
    }
  }
  return boxes;
}

double squared_distance(const Vec3& a, const Vec3& b) {
  return dot(a - b, a - b);
}

}  // namespace

Vec3 closest_point_of_triangle(const Vec3& point, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double ab_a = dot(ab, point - a);
  const double ac_a = dot(ac, point - a);
  if (ab_a <= 0 && ac_a <= 0) {
    return a;
  }
  const double ab_b = dot(ab, point - b);
  const double ac_b = dot(ac, point - b);
  if (ab_b >= 0 && ac_b <= ab_b) {
    return b;
  }
  const double ab_c = dot(ab, point - c);
  const double ac_c = dot(ac, point - c);
  if (ac_c >= 0 && ab_c <= ac_c) {
    return c;
  }
  // Twice the signed areas that the point's projection makes with the edges, up to a common factor.
  const double of_c = ab_a * ac_b - ab_b * ac_a;
  if (of_c <= 0 && ab_a >= 0 && ab_b <= 0) {
    return a + ab_a / (ab_a - ab_b) * ab;
  }
  const double of_b = ab_c * ac_a - ab_a * ac_c;
  if (of_b <= 0 && ac_a >= 0 && ac_c <= 0) {
    return a + ac_a / (ac_a - ac_c) * ac;
  }
  const double of_a = ab_b * ac_c - ab_c * ac_b;
  if (of_a <= 0 && ac_b - ab_b >= 0 && ab_c - ac_c >= 0) {
    return b + (ac_b - ab_b) / ((ac_b - ab_b) + (ab_c - ac_c)) * (c - b);
  }
  const double sum = of_a + of_b + of_c;
  return a + of_b / sum * ab + of_c / sum * ac;
}

ClosestPoint::ClosestPoint(std::pmr::vector<Triangle> triangles, std::pmr::memory_resource* memory)
    : triangles_(std::move(triangles)), tree_(boxes_of(triangles_, memory), memory) {}

double ClosestPoint::facing(std::uint32_t triangle, const Vec3& normal) const {
  const double cosine = dot(triangles_[triangle].normal, normal);
  return triangles_[triangle].two_sided ? std::abs(cosine) : cosine;
}

std::optional<double> ClosestPoint::nearest_distance(const Vec3& point, const Vec3& normal, double max_distance) const {
  double nearest = max_distance * max_distance;
  bool found = false;
  tree_.walk_nearest(
      point, [&] { return nearest; },
      [&](std::uint32_t i) {
        if (!(facing(i, normal) > k_least_facing)) {
          return;
        }
        const double distance = squared_distance(point, closest_point_of_triangle(point, triangles_[i].corners));
        if (distance <= nearest) {
          nearest = distance;
          found = true;
        }
      });
  return found ? std::optional(std::sqrt(nearest)) : std::nullopt;
}

std::optional<ClosestPoint::Found> ClosestPoint::find(const Vec3& point, const Vec3& normal,
                                                      double max_distance) const {
  const double size = length(normal);
  if (!(size > 0 && max_distance >= 0)) {
    return std::nullopt;
  }
  const Vec3 direction = normal / size;
  const auto distance = nearest_distance(point, direction, max_distance);
  if (!distance) {
    return std::nullopt;
  }
  // Two sides of an edge are equally near to what lies on it, give or take the rounding of the question.
  const double reach = *distance + 0x1p-40 * (*distance + std::abs(point.x) + std::abs(point.y) + std::abs(point.z));
  std::optional<Found> best;
  double best_facing = k_least_facing;
  tree_.walk([&](const Box& box) { return box.squared_distance(point) <= reach * reach; },
             [&](std::uint32_t i) {
               const double cosine = facing(i, direction);
               if (!(cosine > best_facing || (best && cosine == best_facing && i < best->triangle))) {
                 return;
               }
               const Vec3 candidate = closest_point_of_triangle(point, triangles_[i].corners);
               if (squared_distance(point, candidate) <= reach * reach) {
                 best = Found{i, candidate, dot(triangles_[i].normal, direction) < 0};
                 best_facing = cosine;
               }
             });
  return best;
}

}  // namespace radvor
