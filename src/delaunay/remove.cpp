// Removal, where close_hole.cpp does not do it. Edges of the vertex are flipped away while that leaves an ear of its
// star behind; then three triangles become one, or, on the hull, what is left of the star turns into ghosts. The ears'
// new edges are made locally Delaunay.
#include <limits>
#include <vector>

#include "base/error.h"
#include "delaunay/transaction.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

void Triangulation::remove(VertexId vertex) {
  require_vertex(vertex);
  if (flat_ || steered_ || !close_hole(vertex)) {
    transact([&] {
      if (flat_) {
        remove_from_chain(vertex);
      } else {
        remove_from_plane(vertex);
      }
      std::erase(changed_, vertex);
    });
  }
  free_again(vertex);
  --vertex_count_;
}

void Triangulation::free_again(VertexId vertex) {
  positions_[vertex].x = std::numeric_limits<double>::quiet_NaN();
  if (!values_.empty()) {
    values_[vertex] = std::numeric_limits<double>::quiet_NaN();
  }
  mesh_.set_out(vertex, free_vertex_);
  free_vertex_ = vertex;
}

void Triangulation::remove_from_plane(VertexId v) {
  // Its constraint edges go, or become one.
  VertexId ends[2] = {k_none, k_none};
  std::uint8_t flags[2] = {0, 0};
  int constraint_count = 0;
  stack_.clear();
  HalfEdge h = mesh_.out(v);
  const HalfEdge first = h;
  do {
    if (mesh_.constraint(h) != 0) {
      if (constraint_count < 2) {
        ends[constraint_count] = target(h);
        flags[constraint_count] = mesh_.constraint(h);
      }
      ++constraint_count;
      stack_.push_back(h);
    }
    if (target(h) != k_infinite) {
      report(target(h));
    }
    h = rotate_ccw(h);
  } while (h != first);
  const bool rejoin = constraint_count == 2 && flags[0] == flags[1] &&
                      orientation(positions_[ends[0]], positions_[v], positions_[ends[1]], lattice_) == 0 &&
                      lexicographically_less(positions_[ends[0]], positions_[v]) ==
                          lexicographically_less(positions_[v], positions_[ends[1]]);
  const bool marked = marked_;
  for (const HalfEdge edge : stack_) {
    free_edge(edge);
  }
  legalize();
  shrink_star(v);
  last_ = k_none;
  for_each_neighbour(v, [&](VertexId neighbour) { last_ = neighbour; });
  bool on_hull = false;
  h = mesh_.out(v);
  for (const HalfEdge start = h;;) {
    on_hull |= target(h) == k_infinite;
    h = rotate_ccw(h);
    if (h == start) {
      break;
    }
  }
  if (on_hull) {
    close_hull(v);
  } else {
    close_inner(v);
  }
  legalize();
  if (rejoin) {
    constrain_along(ends[0], ends[1], flags[0], Crossing::refuse);
    if (marked && !marked_) {
      mark_domain();
    }
  }
}

// Cuts off the ears a b c of the star of v that v is not inside of; their new edges go to stack_.
void Triangulation::shrink_star(VertexId v) {
  stack_.clear();
  HalfEdge h = mesh_.out(v);
  std::uint32_t degree = 0;
  for (const HalfEdge first = h; degree == 0 || h != first; h = rotate_ccw(h)) {
    ++degree;
  }
  for (std::uint32_t failures = 0; failures < degree && degree > 3;) {
    const VertexId a = target(rotate_cw(h));
    const VertexId b = target(h);
    const VertexId c = apex(h);
    if (a != k_infinite && b != k_infinite && c != k_infinite &&
        orientation(positions_[a], positions_[b], positions_[c], lattice_) > 0 &&
        orientation(positions_[a], positions_[c], positions_[v], lattice_) >= 0) {
      const HalfEdge diagonal = mesh_.flip(h);  // c -> a, of the ear
      stack_.push_back(diagonal);
      h = previous(twin(diagonal));  // a -> c, c -> v, v -> a of what is left
      --degree;
      failures = 0;
    } else {
      h = rotate_ccw(h);
      ++failures;
    }
  }
}

// v has three neighbours and is inside of their triangle, or on its border.
void Triangulation::close_inner(VertexId v) {
  const HalfEdge first = mesh_.out(v);
  const HalfEdge second = rotate_ccw(first);
  const HalfEdge third = rotate_ccw(second);
  if (rotate_ccw(third) != first) {
    throw Error(ErrorCode::internal, "the star of vertex %u does not shrink to a triangle", v);
  }
  const VertexId a = target(first), b = target(second), c = target(third);
  const HalfEdge outer[3] = {twin(next(first)), twin(next(second)), twin(next(third))};
  const TriangleId t = triangle_of(first);
  mesh_.release(triangle_of(second));
  mesh_.release(triangle_of(third));
  mesh_.set_triangle(t, a, b, c, mesh_.state(t));
  for (std::uint32_t corner = 0; corner < 3; ++corner) {
    mesh_.link(half_edge(t, corner), outer[corner]);
    mesh_.write(t).constraint[corner] = mesh_.constraint(outer[corner]);
  }
}

// v on the hull: its real triangles (v, x, y) turn into ghosts (infinite, x, y) and its two ghosts go.
void Triangulation::close_hull(VertexId v) {
  HalfEdge first = mesh_.out(v);
  while (target(first) != k_infinite) {
    first = rotate_ccw(first);
  }
  // Counter-clockwise: (v, infinite, x1), (v, x1, x2) ... (v, xm, infinite).
  const std::uint8_t state = mesh_.state(triangle_of(first));
  bool flat = stack_.empty();
  HalfEdge before = twin(next(first));  // x1 -> infinite, beyond
  HalfEdge h = rotate_ccw(first);
  const TriangleId gone_first = triangle_of(first);
  while (apex(h) != k_infinite) {
    const HalfEdge following = rotate_ccw(h);
    const TriangleId t = triangle_of(h);
    const HalfEdge outer = twin(next(h));
    const VertexId x = target(h), y = apex(h);
    mesh_.set_triangle(t, k_infinite, x, y, state);
    mesh_.write(t).constraint[1] = mesh_.constraint(outer);
    mesh_.link(half_edge(t, 1), outer);
    mesh_.link(half_edge(t, 0), before);
    before = half_edge(t, 2);
    flat = flat && is_ghost(triangle_of(outer));
    h = following;
  }
  mesh_.link(before, twin(next(h)));
  mesh_.release(gone_first);
  mesh_.release(triangle_of(h));
  flat_ = flat;
}

}  // namespace radvor::delaunay
