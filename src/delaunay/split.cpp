// A point that replaces a constraint edge by two, also where rounding put it beside the edge.
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
  const VertexId a = origin(h);
  const VertexId b = target(h);
  const auto refuse = [&] {
    throw Error(ErrorCode::constraint, "(%.17g, %.17g) cannot split the constraint from vertex %u to %u", point.x,
                point.y, a, b);
  };
  const auto side_of = [&](HalfEdge e) {
    return orientation(positions_[origin(e)], positions_[target(e)], point, lattice_);
  };
  const int side = side_of(h);
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
  }
  if (!is_ghost(triangle_of(h))) {
    const int right = side_of(next(h));
    const int left = side_of(previous(h));
    if (right < 0 || left < 0 || (right == 0 && left == 0) || (right == 0 && mesh_.constraint(next(h)) != 0) ||
        (left == 0 && mesh_.constraint(previous(h)) != 0)) {
      refuse();
    }
  }
  collect_cavity(point, triangle_of(h), k_none, lattice_, boundary_, cavity_, stack_);
  const VertexId p = add_vertex(point);
  flat_ = false;
  last_ = p;
  fill_cavity(p);
  report_star(p);
  const HalfEdge to_a = find_edge(p, a);
  const HalfEdge to_b = find_edge(p, b);
  const HalfEdge base = next(apex(to_a) == b ? to_a : to_b);  // of the sliver
  mesh_.set_state(triangle_of(base), mesh_.state(triangle_of(twin(base))));
  mesh_.set_constraint(base, 0);
  mesh_.set_constraint(to_a, flags);
  mesh_.set_constraint(to_b, flags);
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
