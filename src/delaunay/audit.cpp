// The full check of a triangulation: that the records are a triangulated sphere, that its real part is planar and
// convex, and that every edge has a reason. It throws what is wrong first.
#include <cmath>

#include "base/error.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

class Audit {
 public:
  explicit Audit(const Triangulation& triangulation) : d_(triangulation), m_(triangulation.mesh_) {}

  void run() {
    check_counts();
    check_vertices();
    for (TriangleId t = 0; t < m_.record_count(); ++t) {
      if (!m_.is_free(t)) {
        check_links(t);
        check_shape(t);
        check_edges(t);
      }
    }
    check_stars();
    require(d_.flat_ == !real_, "what is flat has triangles, or the other way round", 0);
    if (d_.vertex_count_ >= 2) {
      check_hull();
    }
    if (ties_ && d_.steered_ && !d_.unaligned_) {
      require(d_.is_aligned(), "a tie does not follow the values", 0);
    }
  }

 private:
  template <class... Values>
  [[noreturn]] static void fail(const char* format, Values... values) {
    throw Error(ErrorCode::internal, format, values...);
  }
  static void require(bool holds, const char* what, std::uint32_t where) {
    if (!holds) {
      fail("%s (at %u)", what, where);
    }
  }

  int side(VertexId a, VertexId b, VertexId c) const {
    return orientation(d_.positions_[a], d_.positions_[b], d_.positions_[c], d_.lattice_);
  }

  void check_counts() const {
    std::uint32_t live = 0;
    for (TriangleId t = 0; t < m_.record_count(); ++t) {
      live += !m_.is_free(t);
    }
    require(live == m_.live_count(), "the number of triangle records is off", live);
    const std::uint32_t expected = d_.vertex_count_ < 2 ? 0 : 2 * d_.vertex_count_ - 2;
    require(live == expected, "Euler's formula does not hold: triangles", live);
    require(!m_.in_transaction(), "a transaction is open", 0);
    TriangleId free = m_.first_free();
    std::uint32_t free_count = 0;
    for (; free != k_none && free_count <= m_.record_count(); ++free_count) {
      require(free < m_.record_count() && m_.is_free(free), "a triangle is listed as free", free);
      free = m_.triangle(free).vertex[0];
    }
    require(free_count + live == m_.record_count(), "free triangle records are lost", free_count);
  }

  void check_vertices() const {
    std::uint32_t count = 0;
    for (VertexId v = 0; v < d_.vertex_bound(); ++v) {
      if (!d_.is_vertex(v)) {
        continue;
      }
      ++count;
      check_position(v);
      const HalfEdge h = m_.out(v);
      require((h == k_none) == (d_.vertex_count_ == 1), "a vertex has lost its star", v);
      if (h != k_none) {
        require(
            triangle_of(h) < m_.record_count() && corner_of(h) < 3 && !m_.is_free(triangle_of(h)) && m_.origin(h) == v,
            "a vertex's half-edge is not its own", v);
      }
    }
    require(count == d_.vertex_count_, "the number of vertices is off", count);
    require(m_.vertex_capacity() == d_.vertex_bound(), "vertex arrays differ in size", m_.vertex_capacity());
    require(d_.values_.empty() || d_.values_.size() == d_.positions_.size(), "values differ in number", 0);
    require(count == 0 || d_.is_vertex(d_.last_), "the last vertex is none", d_.last_);
    VertexId free = d_.free_vertex_;
    std::uint32_t free_count = 0;
    while (free != k_none && free_count <= d_.vertex_bound()) {
      require(free < d_.vertex_bound() && !d_.is_vertex(free), "a used vertex is listed as free", free);
      free = m_.out(free);
      ++free_count;
    }
    require(free_count + count == d_.vertex_bound(), "free vertices are lost", free_count);
  }

  // In range, and on the lattice that the predicates' shortcuts count on.
  void check_position(VertexId v) const {
    for (int axis = 0; axis < 2; ++axis) {
      const double at = d_.positions_[v][axis], magnitude = std::fabs(at);
      require(at == 0 || (magnitude >= k_least_coordinate && magnitude <= k_greatest_coordinate),
              "a coordinate is out of range", v);
    }
    Lattice lattice = d_.lattice_;
    lattice.include(d_.positions_[v]);
    require(lattice.per_unit() == d_.lattice_.per_unit(), "a vertex is not on the lattice", v);
    require(!std::isinf(d_.value(v)), "a value is infinite", v);
  }

  void check_links(TriangleId t) const {
    const auto& v = m_.triangle(t).vertex;
    require(v[0] != v[1] && v[1] != v[2] && v[2] != v[0], "a triangle has a corner twice", t);
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      require(v[corner] == k_infinite || d_.is_vertex(v[corner]), "a triangle has a corner that is no vertex", t);
      const HalfEdge h = half_edge(t, corner);
      const HalfEdge other = m_.twin(h);
      require(triangle_of(other) < m_.record_count() && corner_of(other) < 3 && !m_.is_free(triangle_of(other)),
              "a triangle has no neighbour", t);
      require(m_.twin(other) == h, "a triangle's neighbour has another neighbour there", t);
      require(m_.origin(h) == m_.target(other) && m_.target(h) == m_.origin(other), "twins have other ends", t);
      require(m_.constraint(h) == m_.constraint(other), "a constraint has two opinions of itself", t);
    }
  }

  void check_shape(TriangleId t) {
    const auto& v = m_.triangle(t).vertex;
    require(m_.state(t) == 0 || (d_.marked_ && m_.state(t) == Triangle::k_outside), "a triangle's state is unknown", t);
    if (m_.is_ghost(t)) {
      const int infinite = (v[0] == k_infinite) + (v[1] == k_infinite) + (v[2] == k_infinite);
      require(infinite == 1, "a ghost has more than one infinite corner", t);
      require(!d_.marked_ || (m_.state(t) & Triangle::k_outside), "a ghost is inside of the domain", t);
    } else {
      real_ = true;
      require(side(v[0], v[1], v[2]) > 0, "a triangle is not counter-clockwise", t);
    }
  }

  void check_edges(TriangleId t) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const HalfEdge h = half_edge(t, corner);
      if (m_.origin(h) == k_infinite || m_.target(h) == k_infinite) {
        require(m_.constraint(h) == 0, "an edge to infinity is a constraint", t);
      } else {
        require(d_.positions_[m_.origin(h)] != d_.positions_[m_.target(h)], "two vertices are at one place", h);
      }
      require(m_.constraint(h) == 0 || d_.constrained_, "a constraint that nobody knows of", h);
      require(m_.constraint(h) == 0 || (m_.constraint(h) & constraint::k_blocking) != 0 || d_.seamed_,
              "a continuous constraint that nobody knows of", h);
      if (m_.state(t) != m_.state(triangle_of(m_.twin(h)))) {
        require((m_.constraint(h) & constraint::k_border) != 0, "the domain ends where no border is", t);
      }
      if (h < m_.twin(h) && d_.is_flippable(h)) {
        const int inside = in_circle(d_.positions_[m_.origin(h)], d_.positions_[m_.target(h)],
                                     d_.positions_[m_.apex(h)], d_.positions_[m_.apex(m_.twin(h))], d_.lattice_);
        require(inside <= 0, "an edge is not locally Delaunay", h);
        require(inside < 0 || d_.steered_ || !d_.prefers_flip(h), "a tie is not canonical", h);
        ties_ = ties_ || inside == 0;
      }
    }
  }

  // All corners are reached from the vertices, so no vertex has two stars.
  void check_stars() const {
    std::uint64_t corners = 0;
    for (VertexId v = 0; v < d_.vertex_bound(); ++v) {
      if (!d_.is_vertex(v) || m_.out(v) == k_none) {
        continue;
      }
      const HalfEdge first = m_.out(v);
      HalfEdge h = first;
      std::uint32_t degree = 0;
      do {
        require(m_.origin(h) == v, "a star has a foreign corner", v);
        require(degree++ <= m_.live_count(), "a star does not close", v);
        h = m_.rotate_ccw(h);
      } while (h != first);
      corners += degree;
    }
    std::uint64_t expected = 0;
    for (TriangleId t = 0; t < m_.record_count(); ++t) {
      expected += m_.is_free(t) ? 0 : m_.is_ghost(t) ? 2 : 3;
    }
    require(corners == expected, "a vertex has two stars", static_cast<std::uint32_t>(corners));
  }

  // Turns left or goes straight, and round once: one highest vertex.
  void check_hull() const {
    const auto less = [&](VertexId a, VertexId b) {
      return lexicographically_less(d_.positions_[a], d_.positions_[b]);
    };
    const HalfEdge first = d_.hull_edge();
    HalfEdge h = first;
    std::uint32_t tops = 0, bottoms = 0, size = 0;
    do {
      require(size++ <= m_.live_count(), "the hull does not close", h);
      const HalfEdge following = d_.hull_next(h);
      const VertexId a = m_.origin(h), b = m_.target(h), c = m_.target(following);
      require(m_.origin(following) == b, "the hull is torn", b);
      require(d_.flat_ ? side(a, b, c) == 0 : side(a, b, c) >= 0, "the hull is not convex", b);
      tops += less(a, b) && less(c, b);
      bottoms += less(b, a) && less(b, c);
      h = following;
    } while (h != first);
    require(tops == 1 && bottoms == 1, "the hull goes round more than once", tops);
    std::uint32_t ghosts = 0;
    for (TriangleId t = 0; t < m_.record_count(); ++t) {
      ghosts += !m_.is_free(t) && m_.is_ghost(t);
    }
    require(ghosts == size, "ghosts that are not at the hull", ghosts);
  }

  const Triangulation& d_;
  const Mesh& m_;
  bool ties_ = false;
  bool real_ = false;
};

void Triangulation::validate() const {
  Audit(*this).run();
}

}  // namespace radvor::delaunay
