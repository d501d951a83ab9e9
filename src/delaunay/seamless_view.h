// What the star of one vertex would be if continuous constraints were none. Cells ignore them, so their neighbours are
// those of this other triangulation; where an edge kept by a continuous constraint is not locally Delaunay it is
// flipped here, in copies of the triangles concerned.
#pragma once

#include <memory_resource>
#include <vector>

#include "delaunay/id_map.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

class SeamlessView {
 public:
  explicit SeamlessView(std::pmr::memory_resource* memory)
      : index_(memory), changed_(memory), visited_(memory), stack_(memory), pending_(memory) {}

  /// The star of the site becomes Delaunay inside of the blocking constraints.
  void look(const Triangulation& triangulation, VertexId site);

  /// A half-edge out of the site.
  HalfEdge out() const { return out_; }
  VertexId origin(HalfEdge h) const { return record(triangle_of(h)).vertex[corner_of(h)]; }
  VertexId target(HalfEdge h) const { return origin(next(h)); }
  VertexId apex(HalfEdge h) const { return origin(previous(h)); }
  HalfEdge twin(HalfEdge h) const { return record(triangle_of(h)).twin[corner_of(h)]; }
  HalfEdge rotate_ccw(HalfEdge out) const { return twin(previous(out)); }
  HalfEdge rotate_cw(HalfEdge out) const { return next(twin(out)); }
  bool is_inside(TriangleId t) const {
    const Triangle& triangle = record(t);
    return (triangle.state & Triangle::k_outside) == 0 && triangle.vertex[0] != k_infinite &&
           triangle.vertex[1] != k_infinite && triangle.vertex[2] != k_infinite;
  }
  /// A blocking constraint, or an end of the domain.
  bool blocks(HalfEdge h) const {
    return (record(triangle_of(h)).constraint[corner_of(h)] & constraint::k_blocking) != 0 ||
           !is_inside(triangle_of(h)) || !is_inside(triangle_of(twin(h)));
  }
  /// Out of the site to a vertex; k_none where there is none.
  HalfEdge find_out(VertexId target_vertex) const;

 private:
  const Triangle& record(TriangleId t) const {
    const std::uint32_t number = index_.find(t);
    return number == IdMap::k_absent ? triangulation_->mesh().triangle(t) : changed_[number];
  }
  Triangle& write(TriangleId t);
  bool flips(HalfEdge h) const;
  void flip(HalfEdge h);
  bool improve_beyond(HalfEdge spoke);

  const Triangulation* triangulation_ = nullptr;
  VertexId site_ = k_none;
  HalfEdge out_ = k_none;
  IdMap index_;  // of triangles in changed_
  std::pmr::vector<Triangle> changed_;
  IdMap visited_;
  std::pmr::vector<TriangleId> stack_;
  std::pmr::vector<HalfEdge> pending_;
};

}  // namespace radvor::delaunay
