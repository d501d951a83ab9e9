// Values between the vertices: linear over triangles, and R. Sibson's natural-neighbour coordinates ("A brief
// description of natural neighbour interpolation", 1981): what each cell would lose to the point's own.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "delaunay/circumcentre.h"
#include "delaunay/conflict.h"

namespace radvor::delaunay {

namespace {

constexpr double k_unset = std::numeric_limits<double>::quiet_NaN();

double along_edge(Vec2 a, Vec2 b, double at_a, double at_b, Vec2 point) {
  const Vec2 edge = b - a;
  const double share = glm::dot(point - a, edge) / glm::dot(edge, edge);
  return at_a + share * (at_b - at_a);
}

}  // namespace

std::array<double, 3> Triangulation::barycentric(TriangleId t, Vec2 point) const {
  const auto& v = mesh_.triangle(t).vertex;
  const Vec2 &a = positions_[v[0]], &b = positions_[v[1]], &c = positions_[v[2]];
  const double weight_a = twice_area(point, b, c), weight_b = twice_area(point, c, a),
               weight_c = twice_area(point, a, b);
  const double sum = weight_a + weight_b + weight_c;
  return {weight_a / sum, weight_b / sum, weight_c / sum};
}

double Triangulation::linear_in(TriangleId t, Vec2 point) const {
  const std::array<double, 3> weights = barycentric(t, point);
  const auto& corners = mesh_.triangle(t).vertex;
  return weights[0] * value(corners[0]) + weights[1] * value(corners[1]) + weights[2] * value(corners[2]);
}

double Triangulation::interpolate_linear(Vec2 point, VertexId* hint) const {
  const Location at = locate(point, hint);
  const auto& v = at.vertices;
  switch (at.where) {
    case Where::outside:
      return k_unset;
    case Where::vertex:
      return value(v[0]);
    case Where::edge:
      return along_edge(positions_[v[0]], positions_[v[1]], value(v[0]), value(v[1]), point);
    case Where::triangle:
      break;
  }
  return linear_in(triangle_of(at.edge), point);
}

// The cavity that the point would make is bounded by its natural neighbours. The part of a neighbour's cell that falls
// to the point has as corners circumcentres of old triangles in the cavity, and of the new ones that the point makes
// with the cavity's border. Its area is a sum over its sides, and every side but those between two new centres belongs
// to two neighbours, with opposite signs: it is dual to the edge between them. So one walk through the cavity adds up
// area times value, edge by edge, without a list of neighbours.
double Triangulation::interpolate_natural(Vec2 point, VertexId* hint) const {
  const Location at = locate(point, hint);
  if (at.where == Where::outside || values_.empty()) {
    return k_unset;
  }
  if (at.where == Where::vertex) {
    return value(at.vertices[0]);
  }
  if (at.where == Where::edge &&
      (constraint_flags(at.edge) != 0 || is_ghost(triangle_of(at.edge)) || is_ghost(triangle_of(twin(at.edge))))) {
    // The limit from the inside.
    const auto& v = at.vertices;
    return along_edge(positions_[v[0]], positions_[v[1]], value(v[0]), value(v[1]), point);
  }
  Lattice lattice = lattice_;
  lattice.include(point);
  const auto old_centre = [&](TriangleId t) {  // seen from the point, as all centres here
    const auto& v = mesh_.triangle(t).vertex;
    const Vec2 a = positions_[v[0]];
    return a - point + circumcentre_from(a, positions_[v[1]], positions_[v[2]]);
  };

  // As collect_cavity: depth first, so that the border comes in order.
  struct Side {
    HalfEdge beyond;
    Vec2 centre;  // of the triangle on this side
  };
  std::array<std::byte, 2048> room;
  std::pmr::monotonic_buffer_resource scratch(room.data(), room.size(), memory_);
  std::pmr::vector<Side> pending(&scratch);
  pending.reserve(64);
  // What lies beyond is wanted soon: neighbours in the plane may be far apart in memory.
  const auto push = [&](HalfEdge side, Vec2 centre) {
    const HalfEdge beyond = twin(side);
    const VertexId v = apex(beyond) == k_infinite ? 0 : apex(beyond);
    __builtin_prefetch(&positions_[v]);
    __builtin_prefetch(&values_[v]);
    pending.push_back({beyond, centre});
  };
  const TriangleId start = triangle_of(at.edge);
  const Vec2 start_centre = old_centre(start);
  for (std::uint32_t corner = 3; corner-- > 0;) {
    push(half_edge(start, corner), start_centre);
  }
  double weights = 0;
  double sum = 0;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  bool unset = false;
  Vec2 first(0.0), before(0.0);  // new centres
  double value_before = 0;
  bool any = false;
  while (!pending.empty()) {
    const auto [h, centre] = pending.back();
    pending.pop_back();
    const VertexId a = origin(h), b = target(h);
    Vec2 beyond;
    if (mesh_.constraint(h) == 0 && conflicts(h, point, lattice)) {
      beyond = old_centre(triangle_of(h));
      push(previous(h), beyond);
      push(next(h), beyond);
    } else {
      beyond = circumcentre_from(point, positions_[b], positions_[a]);
      if (any) {
        const double part = cross(before, beyond);
        weights += part;
        sum += part * values_[b];
      } else {
        first = beyond;
        any = true;
      }
      before = beyond;
      value_before = values_[a];
      unset |= std::isnan(value_before);
      least = std::min(least, value_before);
      greatest = std::max(greatest, value_before);
    }
    sum += cross(centre, beyond) * (values_[a] - values_[b]);
  }
  if (unset) {
    return k_unset;
  }
  const double part = cross(before, first);
  const double result = (sum + part * value_before) / (weights + part);
  // A mean with weights that are not negative; rounding knows that no longer where circumcentres are far away.
  return std::isfinite(result) ? std::clamp(result, least, greatest) : linear_in(start, point);
}

}  // namespace radvor::delaunay
