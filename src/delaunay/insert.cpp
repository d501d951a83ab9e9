// Insertion after Bowyer and Watson: the triangles whose circles hold the new point (the cavity; never beyond a
// constraint edge) are replaced by a fan around it. Finding the cavity may run out of memory but changes nothing;
// filling it changes everything but allocates nothing.
#include <cmath>
#include <limits>

#include "base/error.h"
#include "delaunay/conflict.h"
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
  Location location;
  if (vertex_count_ >= 2) {
    location = locate_from(point, start_near(point, hint), lattice_);
  } else if (vertex_count_ == 1) {
    location = locate(point);
  }
  if (location.where == Where::vertex) {
    changed_.clear();
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
  changed_.reserve(changed_.size() + cavity_.border_size + 3);
  if (!mesh_.in_transaction()) {
    changed_.clear();  // the report before: from here on nothing fails
  }
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
    cavity_.border_size = 0;
    return;
  }
  const bool cross = location.where == Where::edge && constraint_flags(h) != 0;
  collect_cavity(point, triangle_of(h), cross ? twin(h) : k_none, lattice_, cavity_);
}

// p is a vertex without triangles; the cavity has been collected, or p extends the chain.
void Triangulation::place(VertexId p, const Location& location) {
  last_ = p;
  if (vertex_count_ == 1) {
    return;
  }
  if (cavity_.border_size == 0) {
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

// Depth first with the edges in order, so that the border of the cavity comes out counter-clockwise. No vertex is
// inside of a cavity: its triangles form a tree and need no marks; n of them have a border of n + 2 edges, and at most
// as many wait.
void Triangulation::collect_cavity(Vec2 point, TriangleId start, HalfEdge crossed, const Lattice& lattice,
                                   Cavity& cavity) const {
  if (cavity.slots.empty()) {
    cavity.grow();
  }
  Cavity::Slot* slots = cavity.slots.data();
  std::uint32_t room = static_cast<std::uint32_t>(cavity.slots.size()) - 2;
  std::uint32_t triangle_count = 0, border_size = 0, waiting = 0;
  slots[triangle_count++].triangle = start;
  for (std::uint32_t corner = 3; corner-- > 0;) {
    slots[waiting++].stacked = mesh_.triangle(start).twin[corner];
  }
  const bool marked = marked_;
  while (waiting > 0) {
    const HalfEdge h = slots[--waiting].stacked;
    if ((mesh_.constraint(h) == 0 || h == crossed) && conflicts(h, point, lattice)) {
      if (triangle_count == room) [[unlikely]] {
        cavity.grow();
        slots = cavity.slots.data();
        room = static_cast<std::uint32_t>(cavity.slots.size()) - 2;
      }
      const Triangle& record = mesh_.triangle(triangle_of(h));
      const std::uint32_t corner = corner_of(h);
      slots[triangle_count++].triangle = triangle_of(h);
      slots[waiting++].stacked = record.twin[corner == 0 ? 2 : corner - 1];
      slots[waiting++].stacked = record.twin[corner == 2 ? 0 : corner + 1];
    } else {
      slots[border_size].outer = h;
      slots[border_size++].state = marked ? mesh_.state(triangle_of(twin(h))) : std::uint8_t{0};
    }
  }
  cavity.triangle_count = triangle_count;
  cavity.border_size = border_size;
}

//        a <--outer-- b       each border edge of the cavity and p make a triangle (p, b, a), seen from p:
//          \        /         its edge 0 is p-b, edge 1 is b-a, edge 2 is a-p and twin to edge 0 of the next
//           \      /
//            \    /
//              p
void Triangulation::fill_cavity(VertexId p) {
  const std::uint32_t size = cavity_.border_size;
  TriangleId before = k_none;
  const TriangleId first = cavity_.slots[0].triangle;
  for (std::uint32_t i = 0; i < size; ++i) {
    const Cavity::Slot& slot = cavity_.slots[i];
    const TriangleId t = i < cavity_.triangle_count ? slot.triangle : mesh_.allocate();
    mesh_.set_fan_triangle(t, p, slot.outer, slot.state);
    if (i > 0) {
      mesh_.link(half_edge(before, 2), half_edge(t, 0));
    }
    before = t;
  }
  mesh_.link(half_edge(before, 2), half_edge(first, 0));
  mesh_.set_out(p, half_edge(before, 0));
}

}  // namespace radvor::delaunay
