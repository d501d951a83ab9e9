// Insertion after Bowyer and Watson: the triangles whose circles hold the new point (the cavity; never beyond a
// constraint edge) are replaced by a fan around it. Finding the cavity may run out of memory but changes nothing;
// filling it changes everything but allocates nothing.
#include <cmath>
#include <limits>

#include "base/error.h"
#include "delaunay/transaction.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

namespace {

template <class Vector>
void grow_by_one(Vector& vector) {
  if (vector.size() == vector.capacity()) {
    vector.reserve(vector.size() + vector.size() / 2 + 16);
  }
}

}  // namespace

void Triangulation::check(Vec2 point) {
  for (int axis = 0; axis < 2; ++axis) {
    const double magnitude = std::fabs(point[axis]);
    if (!(magnitude <= std::numeric_limits<double>::max())) {
      throw Error(ErrorCode::invalid_geometry, "point (%g, %g) is not finite", point.x, point.y);
    }
    if (magnitude != 0 && !(magnitude >= k_least_coordinate && magnitude <= k_greatest_coordinate)) {
      throw Error(ErrorCode::limit, "point (%g, %g): coordinates are 0 or 2^-142 to 2^200 in magnitude", point.x,
                  point.y);
    }
  }
}

VertexId Triangulation::insert(Vec2 point, VertexId hint) {
  check(point);
  reserve_one();
  lattice_.include(point);
  changed_.clear();
  Location location;
  if (vertex_count_ >= 2) {
    location = locate_from(point, start_near(point, hint), lattice_);
  } else if (vertex_count_ == 1) {
    location = locate(point);
  }
  if (location.where == Where::vertex) {
    last_ = location.vertices[0];
    return last_;
  }
  if (!steered_) {
    return insert_new(point, location);
  }
  VertexId p = k_none;
  transact([&] { p = insert_new(point, location); });
  return p;
}

VertexId Triangulation::insert_new(Vec2 point, const Location& location) {
  const VertexId other = vertex_count_ == 1 ? only_vertex() : k_none;
  if (vertex_count_ >= 2) {
    prepare(point, location);
  }
  changed_.reserve(changed_.size() + boundary_.size() + 3);
  const VertexId p = add_vertex(point);
  if (other != k_none) {
    start_chain(other, p);
  } else {
    place(p, location);
  }
  report_star(p);
  note_for_hints(p);
  return p;
}

// Collects the cavity; where the point joins a chain there is none.
void Triangulation::prepare(Vec2 point, const Location& location) {
  const HalfEdge h = location.edge;
  if (flat_ && orientation(positions_[origin(h)], positions_[target(h)], point, lattice_) == 0) {
    boundary_.clear();
    return;
  }
  const bool cross = location.where == Where::edge && constraint_flags(h) != 0;
  collect_cavity(point, triangle_of(h), cross ? twin(h) : k_none, lattice_, boundary_, cavity_, stack_);
}

// p is a vertex without triangles; the cavity has been collected, or p extends the chain.
void Triangulation::place(VertexId p, const Location& location) {
  last_ = p;
  if (vertex_count_ == 1) {
    return;
  }
  if (boundary_.empty()) {
    if (location.where == Where::edge) {
      split_chain(p, location.edge);
    } else {
      extend_chain(p, location.edge);
    }
    return;
  }
  std::uint8_t split_flags = 0;
  VertexId ends[2] = {k_none, k_none};
  if (location.where == Where::edge) {
    split_flags = constraint_flags(location.edge);
    ends[0] = origin(location.edge);
    ends[1] = target(location.edge);
  } else if (location.where == Where::outside) {
    flat_ = false;
  }
  fill_cavity(p);
  if (split_flags != 0) {
    HalfEdge h = mesh_.out(p);
    const HalfEdge first = h;
    do {
      if (target(h) == ends[0] || target(h) == ends[1]) {
        mesh_.set_constraint(h, split_flags);
      }
      h = rotate_ccw(h);
    } while (h != first);
  }
}

void Triangulation::reserve_one() {
  grow_by_one(positions_);
  if (!values_.empty()) {
    grow_by_one(values_);
  }
  mesh_.reserve_vertex();
  mesh_.reserve_triangles(2);
}

VertexId Triangulation::add_vertex(Vec2 point) {
  VertexId p = free_vertex_;
  if (p != k_none) {
    if (mesh_.in_transaction()) {
      reused_.push_back(p);
    }
    free_vertex_ = mesh_.out(p);
    mesh_.set_out(p, k_none);
    positions_[p] = point;
  } else {
    p = vertex_bound();
    positions_.push_back(point);
    mesh_.append_vertex();
    if (!values_.empty()) {
      values_.push_back(std::numeric_limits<double>::quiet_NaN());
    }
  }
  ++vertex_count_;
  return p;
}

void Triangulation::report_star(VertexId vertex) {
  changed_.push_back(vertex);
  for_each_neighbour(vertex, [&](VertexId neighbour) { changed_.push_back(neighbour); });
}

// Does the triangle lose against the point? entry: its edge towards the cavity, with the point beyond it. A ghost does
// where the point is strictly beyond its hull edge, or within that edge. On the circle exactly the rule is that of a
// circle test on points lifted to the paraboloid whose lexicographically least one is lowered a little: every
// cocircular polygon becomes the fan of its least vertex, in whatever order its points come.
bool Triangulation::conflicts(HalfEdge entry, Vec2 point, const Lattice& lattice) const {
  const Triangle& record = mesh_.triangle(triangle_of(entry));
  const std::uint32_t corner = corner_of(entry);
  const VertexId a = record.vertex[corner];
  const VertexId b = record.vertex[corner == 2 ? 0 : corner + 1];
  const VertexId c = record.vertex[corner == 0 ? 2 : corner - 1];
  if (a == k_infinite || b == k_infinite || c == k_infinite) {
    const Vec2 from = positions_[a == k_infinite ? b : b == k_infinite ? c : a];
    const Vec2 to = positions_[a == k_infinite ? c : b == k_infinite ? a : b];
    const int side = orientation(from, to, point, lattice);
    return side > 0 || (side == 0 && lexicographically_less(from, point) == lexicographically_less(point, to));
  }
  const int side = in_circle(positions_[a], positions_[b], positions_[c], point, lattice);
  if (side != 0) {
    return side > 0;
  }
  const Vec2 inner = lexicographically_less(positions_[c], point) ? positions_[c] : point;
  return lexicographically_less(inner, positions_[a]) && lexicographically_less(inner, positions_[b]);
}

// Depth first with the edges in order, so that the border of the cavity comes out counter-clockwise. No vertex is
// inside of a cavity: its triangles form a tree and need no marks.
void Triangulation::collect_cavity(Vec2 point, TriangleId start, HalfEdge crossed, const Lattice& lattice,
                                   std::pmr::vector<BoundaryEdge>& boundary, std::pmr::vector<TriangleId>& cavity,
                                   std::pmr::vector<HalfEdge>& stack) const {
  boundary.clear();
  cavity.clear();
  stack.clear();
  cavity.push_back(start);
  for (std::uint32_t corner = 3; corner-- > 0;) {
    stack.push_back(mesh_.triangle(start).twin[corner]);
  }
  while (!stack.empty()) {
    const HalfEdge h = stack.back();
    stack.pop_back();
    if ((mesh_.constraint(h) == 0 || h == crossed) && conflicts(h, point, lattice)) {
      cavity.push_back(triangle_of(h));
      stack.push_back(twin(previous(h)));
      stack.push_back(twin(next(h)));
    } else {
      boundary.push_back({h, mesh_.state(triangle_of(twin(h)))});
    }
  }
}

//        a <--outer-- b       each border edge of the cavity and p make a triangle (p, b, a), seen from p:
//          \        /         its edge 0 is p-b, edge 1 is b-a, edge 2 is a-p and twin to edge 0 of the next
//           \      /
//            \    /
//              p
void Triangulation::fill_cavity(VertexId p) {
  const std::size_t size = boundary_.size();
  TriangleId before = k_none;
  const TriangleId first = cavity_[0];
  for (std::size_t i = 0; i < size; ++i) {
    const TriangleId t = i < cavity_.size() ? cavity_[i] : mesh_.allocate();
    mesh_.set_fan_triangle(t, p, boundary_[i].outer, boundary_[i].state);
    if (i > 0) {
      mesh_.link(half_edge(before, 2), half_edge(t, 0));
    }
    before = t;
  }
  mesh_.link(half_edge(before, 2), half_edge(first, 0));
  mesh_.set_out(p, half_edge(before, 0));
}

}  // namespace radvor::delaunay
