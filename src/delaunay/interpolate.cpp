// Values between the vertices: linear over triangles, and R. Sibson's natural-neighbour coordinates ("A brief
// description of natural neighbour interpolation", 1981): what each cell would lose to the point's own.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "delaunay/triangulation.h"

namespace radvor::delaunay {

namespace {

constexpr double k_unset = std::numeric_limits<double>::quiet_NaN();

// Relative to an origin of the caller's.
Vec2 circumcentre(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 p = b - a, q = c - a;
  const double pp = glm::dot(p, p), qq = glm::dot(q, q);
  const double scale = 0.5 / cross(p, q);
  return a + scale * Vec2(q.y * pp - p.y * qq, p.x * qq - q.x * pp);
}

double along_edge(Vec2 a, Vec2 b, double at_a, double at_b, Vec2 point) {
  const Vec2 edge = b - a;
  const double share = glm::dot(point - a, edge) / glm::dot(edge, edge);
  return at_a + share * (at_b - at_a);
}

}  // namespace

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
  const TriangleId t = triangle_of(at.edge);
  const std::array<double, 3> weights = barycentric(t, point);
  const auto& corners = mesh_.triangle(t).vertex;
  return weights[0] * value(corners[0]) + weights[1] * value(corners[1]) + weights[2] * value(corners[2]);
}

// The cavity that the point would make is bounded by its natural neighbours b. The part of a neighbour's cell that
// falls to the point has as corners the circumcentres of the old triangles around b and of the two new ones at b.
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
  std::array<std::byte, 4096> room;
  std::pmr::monotonic_buffer_resource scratch(room.data(), room.size(), memory_);
  Cavity cavity(&scratch);
  Lattice lattice = lattice_;
  lattice.include(point);
  collect_cavity(point, triangle_of(at.edge), k_none, lattice, cavity);
  const std::span<const Cavity::Slot> border(cavity.slots.data(), cavity.border_size);

  for (const Cavity::Slot& edge : border) {
    __builtin_prefetch(&values_[target(edge.outer)]);
  }
  const auto offset = [&](VertexId v) { return positions_[v] - point; };
  const auto compute_old_centre = [&](TriangleId t) {
    const auto& v = mesh_.triangle(t).vertex;
    return circumcentre(offset(v[0]), offset(v[1]), offset(v[2]));
  };
  // A centre is asked for about three times: the first few of the cavity are remembered in the order of its list.
  std::array<Vec2, 16> centres;
  const auto remembered = std::min(cavity.triangle_count, static_cast<std::uint32_t>(centres.size()));
  for (std::uint32_t i = 0; i < remembered; ++i) {
    centres[i] = compute_old_centre(cavity.slots[i].triangle);
  }
  const auto old_centre = [&](TriangleId t) {
    for (std::uint32_t i = 0; i < remembered; ++i) {
      if (cavity.slots[i].triangle == t) {
        return centres[i];
      }
    }
    return compute_old_centre(t);
  };
  double weights = 0;
  double sum = 0;
  HalfEdge outer_before = border.back().outer;
  Vec2 centre_before = circumcentre(Vec2(0.0), offset(target(outer_before)), offset(origin(outer_before)));
  for (const Cavity::Slot& edge : border) {
    const VertexId b = target(edge.outer);
    const Vec2 centre = circumcentre(Vec2(0.0), offset(b), offset(origin(edge.outer)));
    Vec2 corner = centre;
    double twice_area = cross(centre_before, centre);
    // Around b, from the triangle at this side of the cavity to that at the side before.
    for (HalfEdge h = twin(edge.outer);;) {
      const Vec2 following = old_centre(triangle_of(h));
      twice_area += cross(corner, following);
      corner = following;
      h = twin(previous(h));
      if (h == outer_before) {
        break;
      }
    }
    twice_area += cross(corner, centre_before);
    weights += twice_area;
    sum += twice_area * values_[b];
    centre_before = centre;
    outer_before = edge.outer;
  }
  return sum / weights;
}

}  // namespace radvor::delaunay
