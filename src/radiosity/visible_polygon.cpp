#include "radiosity/visible_polygon.h"

#include <algorithm>
#include <cmath>

#include "radiosity/form_factor.h"

namespace radvor {

namespace {

// Of the sum of products that a distance is: a corner nearer to a cut than this lies on it, so that triangles which
// share an edge leave no splinters along it.
constexpr double k_rounding = 0x1p-50;

}  // namespace

VisiblePolygon::VisiblePolygon(const Vec3& eye, std::span<const Vec3> polygon, const Vec3& normal, double lift)
    : eye_(eye), normal_(normal), origin_(polygon[0] - eye), reach_(0), lift_(lift) {
  // The longest side from the first corner gives the best direction in the plane.
  Vec3 along(0.0);
  for (const Vec3& corner : polygon) {
    const Vec3 side = corner - polygon[0];
    along = glm::dot(side, side) > glm::dot(along, along) ? side : along;
  }
  u_ = along / std::max(glm::length(along), 1e-300);
  v_ = glm::cross(normal, u_);
  pieces_[0].size = polygon.size();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 p = polygon[i] - polygon[0];
    pieces_[0].corners[i] = {glm::dot(p, u_), glm::dot(p, v_)};
    reach_ = std::max(reach_, glm::length(polygon[i] - eye));
  }
}

// Where a plane cuts that of the polygon; points y relative to the eye with normal . y > offset are inside.
VisiblePolygon::HalfPlane VisiblePolygon::trace(const Vec3& normal, double offset, double rounding) const {
  return {glm::dot(normal, u_), glm::dot(normal, v_), glm::dot(normal, origin_) - offset, rounding * reach_};
}

bool VisiblePolygon::subtract(const std::array<Vec3, 3>& triangle) {
  const Vec3 a = triangle[0] - eye_, b = triangle[1] - eye_, c = triangle[2] - eye_;
  const Vec3 ab = glm::cross(a, b), bc = glm::cross(b, c), ca = glm::cross(c, a);
  const double volume = glm::dot(ab, c);
  const double length_a = glm::length(a), length_b = glm::length(b), length_c = glm::length(c);
  if (std::abs(volume) <= k_rounding * length_a * length_b * length_c) {
    return true;
  }
  const double sign = volume > 0 ? 1 : -1;
  const Vec3 plane = sign * glm::normalize(glm::cross(b - a, c - a));  // away from the eye
  const std::array<HalfPlane, 4> shadow = {
      trace(plane, glm::dot(plane, a) + lift_, k_rounding), trace(sign * ab, 0, k_rounding * length_a * length_b),
      trace(sign * bc, 0, k_rounding * length_b * length_c), trace(sign * ca, 0, k_rounding * length_c * length_a)};
  // From the last piece down: pieces that are added lie outside the shadow, and the one that fills a gap has been seen.
  for (std::size_t i = piece_count_; i-- > 0;) {
    if (!subtract(shadow, i)) {
      return false;
    }
  }
  return true;
}

// One piece: cut along one side of the shadow after the other, what is outside becomes a new piece, what is inside of
// all of them is hidden.
bool VisiblePolygon::subtract(std::span<const HalfPlane> shadow, std::size_t index) {
  const Piece& piece = pieces_[index];
  std::array<const HalfPlane*, 4> cutting;
  std::size_t cuts = 0;
  for (const HalfPlane& half : shadow) {
    double low = half.rounding, high = -half.rounding;
    for (std::size_t i = 0; i < piece.size; ++i) {
      const double distance = half.u * piece.corners[i].x + half.v * piece.corners[i].y + half.w;
      low = std::min(low, distance);
      high = std::max(high, distance);
    }
    if (high <= half.rounding) {
      return true;
    }
    if (low < -half.rounding) {
      cutting[cuts++] = &half;
    }
  }
  // No side of the shadow passes by all of the piece, but a corner of the two may still: keep the piece until it is
  // known that something of it is hidden.
  const std::size_t before = piece_count_;
  std::array<Piece, 2> inside;
  std::size_t next = 0;  // of the two: not the one that is being cut
  const Piece* rest = &piece;
  for (std::size_t k = 0; k < cuts; ++k) {
    if (piece_count_ == k_max_pieces) {
      return false;
    }
    switch (cut(*cutting[k], *rest, inside[next], pieces_[piece_count_])) {
      case Cut::full:
        return false;
      case Cut::outside:
        piece_count_ = before;
        return true;
      case Cut::inside:
        continue;
      case Cut::both:
        ++piece_count_;
        rest = &inside[next];
        next = 1 - next;
        break;
    }
  }
  untouched_ = false;
  --piece_count_;
  if (index != piece_count_) {
    pieces_[index] = pieces_[piece_count_];
  }
  return true;
}

VisiblePolygon::Cut VisiblePolygon::cut(const HalfPlane& half, const Piece& piece, Piece& inside, Piece& outside) {
  std::array<double, k_capacity> distance;
  double low = 0, high = 0;
  for (std::size_t i = 0; i < piece.size; ++i) {
    distance[i] = half.u * piece.corners[i].x + half.v * piece.corners[i].y + half.w;
    low = std::min(low, distance[i]);
    high = std::max(high, distance[i]);
  }
  if (high <= half.rounding) {
    return Cut::outside;
  }
  if (low >= -half.rounding) {
    return Cut::inside;
  }
  inside.size = outside.size = 0;
  std::size_t last = piece.size - 1;
  for (std::size_t i = 0; i < piece.size; last = i++) {
    if (std::max(inside.size, outside.size) + 2 > k_capacity) {
      return Cut::full;
    }
    const double from = distance[last], to = distance[i];
    if ((from > half.rounding && to < -half.rounding) || (from < -half.rounding && to > half.rounding)) {
      const Vec2 p = piece.corners[last], q = piece.corners[i];
      const Vec2 crossing = p + (q - p) * (from / (from - to));
      inside.corners[inside.size++] = crossing;
      outside.corners[outside.size++] = crossing;
    }
    if (to >= -half.rounding) {
      inside.corners[inside.size++] = piece.corners[i];
    }
    if (to <= half.rounding) {
      outside.corners[outside.size++] = piece.corners[i];
    }
  }
  return Cut::both;
}

double VisiblePolygon::form_factor(const Vec3& x, const Vec3& n) const {
  double sum = 0;
  std::array<Vec3, k_capacity> corners;
  for (std::size_t i = 0; i < piece_count_; ++i) {
    const Piece& piece = pieces_[i];
    for (std::size_t k = 0; k < piece.size; ++k) {
      corners[k] = eye_ + to_space(piece.corners[k]);
    }
    sum += polygon_form_factor(x, n, std::span(corners.data(), piece.size), normal_);
  }
  return sum;
}

}  // namespace radvor
