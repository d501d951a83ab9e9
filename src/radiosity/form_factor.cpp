#include "radiosity/form_factor.h"

#include <algorithm>
#include <cmath>

namespace radvor {

namespace {

constexpr double k_pi = 3.14159265358979323846;

// The term of one edge from a to b (relative to the receiver): angle times (unit normal of the plane) . n.
double edge_term(const Vec3& a, const Vec3& b, const Vec3& n) {
  const Vec3 normal = glm::cross(a, b);
  const double length = glm::length(normal);
  if (length == 0) {
    return 0;  // the edge points at the receiver: its plane is not defined and its angle 0, or the receiver is on it
  }
  return std::atan2(length, glm::dot(a, b)) * glm::dot(normal, n) / length;
}

}  // namespace

double polygon_form_factor(const Vec3& x, const Vec3& n, std::span<const Vec3> polygon, const Vec3& polygon_normal) {
  const std::size_t size = polygon.size();
  if (size < 3 || glm::dot(x - polygon[0], polygon_normal) <= 0) {
    return 0;
  }
  // Clip to the horizon edge by edge: the edges above are summed as they come; leaving and entering points are
  // joined along the horizon when the next part begins, and the last with the first.
  double sum = 0;
  Vec3 first{0.0}, last{0.0};
  bool open = false;
  const auto append = [&](const Vec3& from, const Vec3& to) {
    if (open) {
      if (from != last) {
        sum += edge_term(last, from, n);
      }
    } else {
      first = from;
      open = true;
    }
    sum += edge_term(from, to, n);
    last = to;
  };
  Vec3 a = polygon[size - 1] - x;
  double height_a = glm::dot(a, n);
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 b = polygon[i] - x;
    const double height_b = glm::dot(b, n);
    if (height_a >= 0 && height_b >= 0) {
      append(a, b);
    } else if (height_a >= 0) {
      append(a, a + (b - a) * (height_a / (height_a - height_b)));
    } else if (height_b >= 0) {
      append(a + (b - a) * (height_a / (height_a - height_b)), b);
    }
    a = b;
    height_a = height_b;
  }
  if (!open) {
    return 0;
  }
  if (last != first) {
    sum += edge_term(last, first, n);
  }
  // Counter-clockwise about a front that faces the receiver is clockwise about the direction of sight: hence the sign.
  return std::clamp(-sum / (2 * k_pi), 0.0, 1.0);
}

PlanePiece measure_polygon(std::span<const Vec3> polygon, const Vec3& u, const Vec3& v, const Vec3& normal) {
  PlanePiece piece;
  piece.normal = normal;
  piece.u = u;
  piece.v = v;
  if (polygon.empty()) {
    return piece;
  }
  // Fan about the first corner; signed, so that reflex corners cancel.
  const Vec3 base = polygon[0];
  double area = 0, s_u = 0, s_v = 0, s_uu = 0, s_uv = 0, s_vv = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 p = polygon[i - 1] - base;
    const Vec3 q = polygon[i] - base;
    const Vec2 a(glm::dot(p, u), glm::dot(p, v));
    const Vec2 b(glm::dot(q, u), glm::dot(q, v));
    const double twice = cross(a, b);
    // Exact integrals over the triangle (0, a, b): area 1/2, first moments 1/6, second 1/12, times `twice`.
    area += twice / 2;
    s_u += twice * (a.x + b.x) / 6;
    s_v += twice * (a.y + b.y) / 6;
    s_uu += twice * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
    s_vv += twice * (a.y * a.y + a.y * b.y + b.y * b.y) / 12;
    s_uv += twice * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y) / 24;
  }
  piece.area = std::abs(area);
  if (area == 0) {
    piece.centroid = base;
    return piece;
  }
  const Vec2 mean(s_u / area, s_v / area);
  piece.centroid = base + mean.x * u + mean.y * v;
  piece.uu = s_uu / area - mean.x * mean.x;
  piece.uv = s_uv / area - mean.x * mean.y;
  piece.vv = s_vv / area - mean.y * mean.y;
  return piece;
}

PlanePiece join(const PlanePiece& a, const PlanePiece& b) {
  PlanePiece whole = a;
  whole.area = a.area + b.area;
  if (whole.area == 0) {
    return whole;
  }
  const double part_a = a.area / whole.area;
  const double part_b = b.area / whole.area;
  whole.centroid = part_a * a.centroid + part_b * b.centroid;
  const Vec3 apart = b.centroid - a.centroid;
  const double du = glm::dot(apart, a.u);
  const double dv = glm::dot(apart, a.v);
  const double both = part_a * part_b;
  whole.uu = part_a * a.uu + part_b * b.uu + both * du * du;
  whole.uv = part_a * a.uv + part_b * b.uv + both * du * dv;
  whole.vv = part_a * a.vv + part_b * b.vv + both * dv * dv;
  return whole;
}

double kernel_form_factor(const Vec3& x, const Vec3& n, const PlanePiece& piece) {
  // With w from x to a point c + t of the piece, the kernel is H (n . w) / (pi |w|^4), H = -m . w the same all over the
  // plane. The mean over t to second order, with <t> = 0 and <t t^T> = M:
  //   H / (pi s^2) * (a - 4 n^T M w / s - 2 a tr M / s + 12 a w^T M w / s^2),   a = n . w, s = |w|^2 at c.
  const Vec3 w = piece.centroid - x;
  const double height = -glm::dot(piece.normal, w);
  const double a = glm::dot(n, w);
  if (height <= 0 || a <= 0) {
    return 0;
  }
  const double s = glm::dot(w, w);
  const double inverse = 1 / s;
  const double wu = glm::dot(w, piece.u), wv = glm::dot(w, piece.v);
  const double nu = glm::dot(n, piece.u), nv = glm::dot(n, piece.v);
  const double n_m_w = nu * (piece.uu * wu + piece.uv * wv) + nv * (piece.uv * wu + piece.vv * wv);
  const double w_m_w = piece.uu * wu * wu + 2 * piece.uv * wu * wv + piece.vv * wv * wv;
  const double mean = a + inverse * (12 * a * w_m_w * inverse - 4 * n_m_w - 2 * a * (piece.uu + piece.vv));
  return std::max(0.0, height * mean * piece.area * inverse * inverse / k_pi);
}

}  // namespace radvor
