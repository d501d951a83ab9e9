// Vertices that are all on one line: a chain of edges, each with a ghost on either side; at its two ends the ghosts of
// both sides meet. Ghosts of one edge may be neighbours twice, so that none of the general surgery applies.
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

// The second vertex: one edge with a ghost on either side.
void Triangulation::start_chain(VertexId a, VertexId p) {
  const TriangleId left = mesh_.allocate();
  const TriangleId right = mesh_.allocate();
  const std::uint8_t state = marked_ ? Triangle::k_outside : std::uint8_t{0};
  mesh_.set_triangle(left, a, p, k_infinite, state);
  mesh_.set_triangle(right, p, a, k_infinite, state);
  mesh_.link(half_edge(left, 0), half_edge(right, 0));
  mesh_.link(half_edge(left, 1), half_edge(right, 2));
  mesh_.link(half_edge(left, 2), half_edge(right, 1));
  last_ = p;
}

// A new end of the chain: two more ghosts between the two at the old end e. `end` leads from e back along the chain.
void Triangulation::extend_chain(VertexId p, HalfEdge end) {
  const VertexId e = origin(end);
  const HalfEdge in = previous(end);  // infinite -> e, left of the chain
  const HalfEdge out = twin(in);      // e -> infinite
  const std::uint8_t state = mesh_.state(triangle_of(end));
  const TriangleId left = mesh_.allocate();
  const TriangleId right = mesh_.allocate();
  mesh_.set_triangle(left, p, e, k_infinite, state);
  mesh_.set_triangle(right, e, p, k_infinite, state);
  mesh_.link(half_edge(left, 0), half_edge(right, 0));
  mesh_.link(half_edge(left, 1), in);
  mesh_.link(half_edge(right, 2), out);
  mesh_.link(half_edge(left, 2), half_edge(right, 1));
}

//   --- u ======== v ---         above: (u, v, infinite) becomes (u, p, infinite), and (p, v, infinite) is new;
//   --- u == p === v ---         below: (v, u, infinite) becomes (v, p, infinite), and (p, u, infinite) is new
void Triangulation::split_chain(VertexId p, HalfEdge uv) {
  const HalfEdge vu = twin(uv);
  const VertexId u = origin(uv), v = origin(vu);
  const std::uint8_t flags = mesh_.constraint(uv);
  const HalfEdge above_v = twin(next(uv)), below_u = twin(next(vu));
  const TriangleId above = mesh_.allocate();
  const TriangleId below = mesh_.allocate();
  mesh_.set_triangle(above, p, v, k_infinite, mesh_.state(triangle_of(uv)));
  mesh_.set_triangle(below, p, u, k_infinite, mesh_.state(triangle_of(vu)));
  mesh_.replace_corner(next(uv), p);
  mesh_.replace_corner(next(vu), p);
  mesh_.link(half_edge(above, 1), above_v);
  mesh_.link(half_edge(below, 1), below_u);
  mesh_.link(half_edge(above, 2), next(uv));
  mesh_.link(half_edge(below, 2), next(vu));
  mesh_.link(uv, half_edge(below, 0));
  mesh_.link(vu, half_edge(above, 0));
  mesh_.set_constraint(uv, flags);
  mesh_.set_constraint(vu, flags);
  mesh_.set_out(u, uv);
  mesh_.set_out(v, vu);
}

void Triangulation::remove_from_chain(VertexId v) {
  if (vertex_count_ == 1) {
    last_ = k_none;
    return;
  }
  VertexId neighbours[2] = {k_none, k_none};
  HalfEdge outs[2] = {k_none, k_none};
  int count = 0;
  HalfEdge h = mesh_.out(v);
  const HalfEdge first = h;
  do {
    if (target(h) != k_infinite) {
      neighbours[count] = target(h);
      outs[count++] = h;
    }
    h = rotate_ccw(h);
  } while (h != first);
  last_ = neighbours[0];
  for (int i = 0; i < count; ++i) {
    report(neighbours[i]);
  }
  if (vertex_count_ == 2) {
    mesh_.release(triangle_of(outs[0]));
    mesh_.release(triangle_of(twin(outs[0])));
    mesh_.set_out(neighbours[0], k_none);
    return;
  }
  if (count == 1) {
    const TriangleId left = triangle_of(outs[0]);         // (v, e, infinite)
    const TriangleId right = triangle_of(twin(outs[0]));  // (e, v, infinite)
    const HalfEdge in = twin(next(outs[0]));              // infinite -> e
    const HalfEdge out = twin(previous(twin(outs[0])));   // e -> infinite
    mesh_.link(in, out);
    mesh_.set_out(neighbours[0], out);
    mesh_.release(left);
    mesh_.release(right);
    return;
  }
  // What split_chain does, backwards: a = neighbours[0], b = neighbours[1].
  const HalfEdge va = outs[0], vb = outs[1], av = twin(va), bv = twin(vb);
  const std::uint8_t flags = mesh_.constraint(va) == mesh_.constraint(vb) ? mesh_.constraint(va) : std::uint8_t{0};
  const HalfEdge above_b = twin(next(vb));  // of (v, b, infinite), which goes, as does (v, a, infinite)
  const HalfEdge below_a = twin(next(va));
  mesh_.replace_corner(next(av), neighbours[1]);
  mesh_.replace_corner(next(bv), neighbours[0]);
  mesh_.link(next(av), above_b);
  mesh_.link(next(bv), below_a);
  mesh_.link(av, bv);
  mesh_.set_constraint(av, flags);
  mesh_.set_out(neighbours[0], av);
  mesh_.set_out(neighbours[1], bv);
  mesh_.release(triangle_of(va));
  mesh_.release(triangle_of(vb));
}

}  // namespace radvor::delaunay
