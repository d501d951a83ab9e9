#include "polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

namespace bake {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Twice the vector area (Newell): normal to the plane that fits the polygon best, whatever its shape.
glm::dvec3 vector_area(std::span<const glm::dvec3> corners) {
  glm::dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {  // about a corner: far from the origin nothing cancels
    sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return sum;
}

/// Drops the coordinate along which the polygon is seen largest, and mirrors where needed so that it winds
/// counter-clockwise. Nothing is rounded.
std::vector<glm::dvec2> projected(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int u = (drop + 1) % 3;
  const int v = (drop + 2) % 3;
  const double sign = normal[drop] < 0 ? -1 : 1;
  std::vector<glm::dvec2> points;
  points.reserve(corners.size());
  for (const glm::dvec3& corner : corners) {
    points.emplace_back(sign * corner[u], corner[v]);
  }
  return points;
}

/// Twice the signed area of abc; what rounding may have made of 0 is 0.
double doubled_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y);
  const double right = (b.y - a.y) * (c.x - a.x);
  const double area = left - right;
  return std::abs(area) <= 8e-16 * (std::abs(left) + std::abs(right)) ? 0 : area;
}

bool cut_quad(std::span<const glm::dvec3> corners, const std::vector<glm::dvec2>& p, std::vector<Triangle>& triangles) {
  const double s012 = doubled_area(p[0], p[1], p[2]);
  const double s023 = doubled_area(p[0], p[2], p[3]);
  const double s013 = doubled_area(p[0], p[1], p[3]);
  const double s123 = doubled_area(p[1], p[2], p[3]);
  const bool first = s012 > 0 && s023 > 0;
  const bool second = s013 > 0 && s123 > 0;
  const bool shorter = glm::length(corners[2] - corners[0]) <= glm::length(corners[3] - corners[1]);
  const bool along_02 = first == second ? shorter : first;
  triangles.push_back(along_02 ? Triangle{0, 1, 2} : Triangle{0, 1, 3});
  triangles.push_back(along_02 ? Triangle{0, 2, 3} : Triangle{1, 2, 3});
  return first || second;
}

/// Clips ears off the ring of corners that are left.
class EarClipper {
 public:
  EarClipper(const std::vector<glm::dvec2>& points, std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles), ring_(points.size()) {
    std::iota(ring_.begin(), ring_.end(), 0u);
  }

  bool clip_all() {
    bool simple = true;
    std::size_t at = 0;
    std::size_t tried = 0;
    while (ring_.size() > 3) {
      if (tried < ring_.size() && !is_ear(at)) {
        ++tried;
        at = (at + 1) % ring_.size();
        continue;
      }
      if (tried == ring_.size()) {  // none is one: not a simple polygon
        simple = false;
        at = largest();
      }
      emit(at);
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(at));
      at %= ring_.size();  // on to the next corner: fans would leave needles
      tried = 0;
    }
    emit(1);
    return simple && area(1) > 0;
  }

 private:
  std::uint32_t corner(std::size_t at) const { return ring_[at % ring_.size()]; }
  std::uint32_t before(std::size_t at) const { return ring_[(at + ring_.size() - 1) % ring_.size()]; }

  double area(std::size_t at) const {
    return doubled_area(points_[before(at)], points_[corner(at)], points_[corner(at + 1)]);
  }

  void emit(std::size_t at) {
    if (area(at) != 0) {
      triangles_.push_back({before(at), corner(at), corner(at + 1)});
    }
  }

  bool is_ear(std::size_t at) const {
    if (area(at) <= 0) {
      return false;
    }
    const glm::dvec2& a = points_[before(at)];
    const glm::dvec2& b = points_[corner(at)];
    const glm::dvec2& c = points_[corner(at + 1)];
    return std::none_of(ring_.begin(), ring_.end(), [&](std::uint32_t other) {
      const glm::dvec2& p = points_[other];
      if (p == a || p == b || p == c) {  // repeated corners: bridges to holes touch the ear there, and may
        return false;
      }
      return doubled_area(a, b, p) >= 0 && doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0;
    });
  }

  std::size_t largest() const {
    std::size_t best = 0;
    for (std::size_t at = 1; at < ring_.size(); ++at) {
      if (area(at) > area(best)) {
        best = at;
      }
    }
    return best;
  }

  const std::vector<glm::dvec2>& points_;
  std::vector<Triangle>& triangles_;
  std::vector<std::uint32_t> ring_;
};

}  // namespace

bool triangulate(std::span<const glm::dvec3> corners, std::vector<Triangle>& triangles) {
  triangles.clear();
  if (corners.size() < 3) {
    return false;
  }
  if (corners.size() == 3) {
    triangles.push_back({0, 1, 2});  // even without area: whoever takes it counts what they drop
    return true;
  }
  const std::vector<glm::dvec2> points = projected(corners, vector_area(corners));
  return corners.size() == 4 ? cut_quad(corners, points, triangles) : EarClipper(points, triangles).clip_all();
}

}  // namespace bake
