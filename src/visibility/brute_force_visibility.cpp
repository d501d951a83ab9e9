#include "visibility/brute_force_visibility.h"

#include <algorithm>
#include <cmath>

namespace radvor {
namespace {

// Sign of the determinant of two vectors of the plane, exact while no product underflows: rounding keeps the order of
// the products, and where they round to the same number their rounding errors decide.
int side(const Vec2& p, const Vec2& q) {
  const double left = p.x * q.y;
  const double right = p.y * q.x;
  if (left != right) {
    return left > right ? 1 : -1;
  }
  const double left_error = std::fma(p.x, q.y, -left);
  const double right_error = std::fma(p.y, q.x, -right);
  return (left_error > right_error) - (left_error < right_error);
}

// The plane that a line pierces at 0, after Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013).
// A point is sheared into it by itself, whatever triangle it is a corner of, and there everything is exact: nothing
// slips through between triangles, neither at edges nor at corners.
class PiercedPlane {
 public:
  PiercedPlane(const Vec3& from, const Vec3& direction) : from_(from) {
    const Vec3 size = glm::abs(direction);
    z_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    slope_ = Vec2(direction[x_], direction[y_]) / direction[z_];
  }

  /// A line on an edge or corner pierces too.
  bool is_pierced_in(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec2 p = sheared(a);
    const Vec2 q = sheared(b);
    const Vec2 r = sheared(c);
    const int pq = side(p, q);
    const int qr = side(q, r);
    const int rp = side(r, p);
    return (pq >= 0 && qr >= 0 && rp >= 0) || (pq <= 0 && qr <= 0 && rp <= 0);
  }

 private:
  Vec2 sheared(const Vec3& point) const {
    const Vec3 relative = point - from_;
    return Vec2(relative[x_], relative[y_]) - slope_ * relative[z_];
  }

  Vec3 from_;
  int x_, y_, z_;
  Vec2 slope_;
};

}  // namespace

BruteForceVisibility::BruteForceVisibility(const Occluders& occluders, std::pmr::memory_resource* memory)
    : triangles_(memory) {
  triangles_.reserve(occluders.corners.size() / 3);
  Vec3 farthest(0);
  for (std::size_t corner = 0; corner + 2 < occluders.corners.size(); corner += 3) {
    const Vec3& a = occluders.positions[occluders.corners[corner]];
    const Vec3& b = occluders.positions[occluders.corners[corner + 1]];
    const Vec3& c = occluders.positions[occluders.corners[corner + 2]];
    triangles_.push_back({a, b, c, glm::cross(b - a, c - a)});
    farthest = glm::max(farthest, glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c))));
  }
  // 2^-40 is 8192 roundings of a double: room for needles whose computed normals are off by as much.
  lift_ = 0x1p-40 * std::max({farthest.x, farthest.y, farthest.z});
}

bool BruteForceVisibility::is_blocked(const Vec3& from, const Vec3& to) const {
  const PiercedPlane plane(from, to - from);
  return std::any_of(triangles_.begin(), triangles_.end(), [&](const Triangle& t) {
    const double from_side = glm::dot(t.normal, t.a - from);
    const double to_side = glm::dot(t.normal, t.a - to);
    // Ends in the plane of a triangle are not blocked by it, nor by one without area, whose normal is 0.
    const bool crosses = (from_side < 0 && to_side > 0) || (from_side > 0 && to_side < 0);
    return crosses && plane.is_pierced_in(t.a, t.b, t.c);
  });
}

void BruteForceVisibility::blocked_from(const Vec3& from, std::span<const Vec3> to, std::uint8_t* blocked) const {
  std::transform(to.begin(), to.end(), blocked, [&](const Vec3& end) { return is_blocked(from, end); });
}

void BruteForceVisibility::blocked(std::span<const Sightline> segments, std::uint8_t* blocked) const {
  std::transform(segments.begin(), segments.end(), blocked,
                 [&](const Sightline& segment) { return is_blocked(segment.from, segment.to); });
}

FirstHit BruteForceVisibility::first_hit(const Vec3& from, const Vec3& direction) const {
  const PiercedPlane plane(from, direction);
  FirstHit nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  for (std::size_t index = 0; index < triangles_.size(); ++index) {
    const Triangle& t = triangles_[index];
    const double slope = glm::dot(t.normal, direction);
    const double distance = glm::dot(t.normal, t.a - from) / slope;
    if (slope != 0 && distance > 0 && distance < nearest.distance && plane.is_pierced_in(t.a, t.b, t.c)) {
      nearest = {static_cast<std::uint32_t>(index), slope < 0, distance};
    }
  }
  return nearest.triangle == FirstHit::k_miss ? FirstHit{} : nearest;
}

void BruteForceVisibility::first_hits(const Vec3& from, std::span<const Vec3> directions, FirstHit* hits) const {
  std::transform(directions.begin(), directions.end(), hits,
                 [&](const Vec3& direction) { return first_hit(from, direction); });
}

double BruteForceVisibility::lift() const {
  return lift_;
}

}  // namespace radvor
