// A point that replaces a constraint edge by two, also where rounding put it beside the edge, and beyond unconstrained
// slivers there.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "delaunay/transaction.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

VertexId Triangulation::split(VertexId a, VertexId b, Vec2 point) {
  require_vertex(a);
  require_vertex(b);
  check(point);
  const HalfEdge h = a == b ? k_none : find_edge(a, b);
  if (h == k_none || mesh_.constraint(h) == 0) {
    throw Error(ErrorCode::constraint, "there is no constraint from vertex %u to %u", a, b);
  }
  VertexId p = k_none;
  transact([&] { p = split_edge(h, point); });
  return p;
}

// The triangle between edge and point has to be empty, so that no vertex changes sides: the edges between them then cut
// it from side to side, one after another. edge: the point is left of it. False where a vertex or a constraint is in
// the way.
//
//          p                e1-e2: the edge crossed last, at first a-b. Its next apex c is in the triangle a b p (or on
//         / \               its border), or beyond a-p, where c-e2 is crossed next, or beyond b-p
//    e1 -/---\---- e2
//       /     \   /
//      a ===== b
bool Triangulation::find_beside(HalfEdge edge, Vec2 point, Location& location) const {
  const Vec2 a = positions_[origin(edge)];
  const Vec2 b = positions_[target(edge)];
  const auto side_of = [&](HalfEdge e) {
    return orientation(positions_[origin(e)], positions_[target(e)], point, lattice_);
  };
  HalfEdge h = edge;
  while (!is_ghost(triangle_of(h))) {
    const Vec2 c = positions_[apex(h)];
    const bool beyond_a = orientation(point, a, c, lattice_) < 0;
    if (!beyond_a && orientation(b, point, c, lattice_) >= 0) {
      return false;
    }
    const int right = side_of(next(h));
    const int left = side_of(previous(h));
    if (right > 0 && left > 0) {
      location = describe(Where::triangle, h);
      return true;
    }
    if (right >= 0 && left >= 0) {
      location = describe(Where::edge, right == 0 ? next(h) : previous(h));
      return mesh_.constraint(location.edge) == 0;
    }
    h = twin(beyond_a ? next(h) : previous(h));
    if (mesh_.constraint(h) != 0) {
      return false;
    }
  }
  location = describe(Where::outside, h);
  return true;
}

//          c                    c
//         / \                  /|\.
//        /   \                / | \.
//       /  p  \     ->       /  p  \         the sliver a b p belongs to what is beyond a-b from now on, where
//      /       \            / .' '. \        a-b is an ordinary edge, flipped if it is not locally Delaunay
//     a ======= b          a --------- b
VertexId Triangulation::split_edge(HalfEdge edge, Vec2 point) {
  lattice_.include(point);
  reserve_one();
  HalfEdge h = edge;
  const std::uint8_t flags = mesh_.constraint(h);
  VertexId a = origin(h);
  VertexId b = target(h);
  const auto refuse = [&] {
    throw Error(ErrorCode::constraint, "(%.17g, %.17g) cannot split the constraint from vertex %u to %u", point.x,
                point.y, a, b);
  };
  const int side = orientation(positions_[a], positions_[b], point, lattice_);
  if (side == 0) {
    if (lexicographically_less(positions_[a], point) != lexicographically_less(point, positions_[b]) ||
        point == positions_[a] || point == positions_[b]) {
      refuse();
    }
    if (!flat_ && is_ghost(triangle_of(h))) {
      h = twin(h);
    }
    return insert_new(point, describe(Where::edge, h));
  }
  if (side < 0) {
    h = twin(h);
    std::swap(a, b);
  }
  Location location;
  if (!find_beside(h, point, location)) {
    refuse();
  }
  const VertexId p = insert_new(point, location);
  constrain_along(a, p, flags, Crossing::refuse);
  constrain_along(p, b, flags, Crossing::refuse);
  const HalfEdge base = find_edge(a, b);  // of the sliver
  mesh_.set_state(triangle_of(base), mesh_.state(triangle_of(twin(base))));
  mesh_.set_constraint(base, 0);
  stack_.clear();
  stack_.push_back(base);
  legalize();
  return p;
}

// The rounded crossing of a-b with a constraint edge, as a vertex of that edge.
VertexId Triangulation::split_crossing(VertexId a, VertexId b, Pair edge) {
  const Vec2 u = positions_[edge[0]];
  const Vec2 along = positions_[edge[1]] - u;
  const Vec2 direction = positions_[b] - positions_[a];
  const double share = std::clamp(cross(positions_[a] - u, direction) / cross(along, direction), 0.0, 1.0);
  Vec2 point = u + share * along;
  for (int axis = 0; axis < 2; ++axis) {
    if (std::fabs(point[axis]) < k_least_coordinate) {
      point[axis] = 0;
    }
  }
  if (point == u) {
    return edge[0];
  }
  if (point == positions_[edge[1]]) {
    return edge[1];
  }
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
    throw Error(ErrorCode::constraint, "the constraint from vertex %u to %u is all but parallel to that from %u to %u",
                a, b, edge[0], edge[1]);
  }
  return split_edge(find_edge(edge[0], edge[1]), point);
}

}  // namespace radvor::delaunay
