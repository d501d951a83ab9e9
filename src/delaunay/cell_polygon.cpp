#include "delaunay/cell_polygon.h"

#include <algorithm>

#include "delaunay/circumcentre.h"

namespace radvor::delaunay {

// ---- Half-planes

double CellPolygon::value(const CellSide& side, Vec2 point) const {
  switch (side.kind) {
    case CellSide::Kind::bisector: {
      const Vec2 to = position(side.a) - at_;
      return glm::dot(at_ + 0.5 * to - point, to);
    }
    case CellSide::Kind::line:
      return cross(position(side.b) - position(side.a), point - position(side.a));
    case CellSide::Kind::window:
      return cross(window_[side.b] - window_[side.a], point - window_[side.a]);
  }
  return 0;
}

bool CellPolygon::cuts(Vec2 a, Vec2 b) const {
  bool left = false, right = false;
  for (const CellSide& side : sides_) {
    const double at = cross(b - a, side.end - a);
    left |= at > 0;
    right |= at < 0;
  }
  if (!left || !right) {
    return false;
  }
  double from = 0, to = 1;
  for (const CellSide& side : sides_) {
    const double at_a = value(side, a);
    const double at_b = value(side, b);
    if (at_a <= 0 && at_b <= 0) {
      return false;
    }
    if (at_a < 0) {
      from = std::max(from, at_a / (at_a - at_b));
    } else if (at_b < 0) {
      to = std::min(to, at_a / (at_a - at_b));
    }
  }
  return from < to;
}

// Sutherland and Hodgman, for one half-plane and a convex polygon.
void CellPolygon::clip(CellSide by) {
  if (sides_.empty() || (by.kind == CellSide::Kind::bisector && is_side(by.a))) {
    return;
  }
  clipped_.clear();
  double before = value(by, sides_.back().end);
  bool cut = false;
  for (const CellSide& side : sides_) {
    const double after = value(by, side.end);
    if (before < 0 && after >= 0) {
      by.end = meet(by, side);
      clipped_.push_back(by);
    }
    if (before >= 0 || after >= 0) {
      clipped_.push_back(side);
      if (after < 0) {
        clipped_.back().end = meet(side, by);
      }
    }
    cut |= after < 0;
    before = after;
  }
  if (cut) {
    sides_.swap(clipped_);
  }
}

// ---- Corners

Vec2 CellPolygon::corner(VertexId a, VertexId b) const {
  VertexId v[3] = {site_, a, b};
  std::sort(v, v + 3);
  return circumcentre(position(v[0]), position(v[1]), position(v[2]));
}

Vec2 CellPolygon::meet(const CellSide& one, const CellSide& other) const {
  if (one.kind == CellSide::Kind::bisector && other.kind == CellSide::Kind::bisector) {
    return corner(one.a, other.a);
  }
  const CellSide& bisector = one.kind == CellSide::Kind::bisector ? one : other;
  const CellSide& line = one.kind == CellSide::Kind::bisector ? other : one;
  if (bisector.kind != CellSide::Kind::bisector) {
    return meet_lines(one, other);
  }
  const Vec2 s = position(std::min(site_, bisector.a));
  const Vec2 n = position(std::max(site_, bisector.a));
  const Vec2 u = line.kind == CellSide::Kind::window ? window_[line.a] : position(std::min(line.a, line.b));
  const Vec2 v = line.kind == CellSide::Kind::window ? window_[line.b] : position(std::max(line.a, line.b));
  const double share = glm::dot(0.5 * ((s - u) + (n - u)), n - s) / glm::dot(v - u, n - s);
  return u + share * (v - u);
}

// Two lines: constraint edges that meet only within rounding.
Vec2 CellPolygon::meet_lines(const CellSide& one, const CellSide& other) const {
  const Vec2 u = position(one.a), along = position(one.b) - u;
  const Vec2 w = position(other.a), across = position(other.b) - w;
  return u + cross(w - u, across) / cross(along, across) * along;
}

void CellPolygon::close_wedge(CellSide low, CellSide high) {
  std::size_t begin = 0;
  std::size_t end = sides_.size();  // the last corner of the chain is that of end - 2
  while (begin + 1 < end && value(low, sides_[begin].end) <= 0) {
    ++begin;
  }
  while (begin + 1 < end && value(high, sides_[end - 2].end) <= 0) {
    --end;
  }
  low.end = meet(low, sides_[begin]);
  sides_[end - 1].end = meet(sides_[end - 1], high);
  clipped_.clear();
  clipped_.push_back(low);
  clipped_.insert(clipped_.end(), sides_.begin() + static_cast<std::ptrdiff_t>(begin),
                  sides_.begin() + static_cast<std::ptrdiff_t>(end));
  clipped_.push_back(high);
  sides_.swap(clipped_);
}

bool CellPolygon::is_side(VertexId site) const {
  return std::any_of(sides_.begin(), sides_.end(),
                     [&](const CellSide& side) { return side.kind == CellSide::Kind::bisector && side.a == site; });
}

bool CellPolygon::meets_a_circle(Vec2 a, Vec2 b) const {
  const Vec2 along = b - a;
  for (const CellSide& side : sides_) {
    const double share = std::clamp(glm::dot(side.end - a, along) / glm::dot(along, along), 0.0, 1.0);
    const Vec2 nearest = a + share * along - side.end;
    const Vec2 radius = at_ - side.end;
    if (glm::dot(nearest, nearest) <= glm::dot(radius, radius)) {
      return true;
    }
  }
  return false;
}

}  // namespace radvor::delaunay
