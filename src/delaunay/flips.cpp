// Edge flips: which edges are not locally Delaunay, and Lawson's way to make them so.
#include "delaunay/conflict.h"

namespace radvor::delaunay {

/// Not a constraint, real triangles on both sides.
bool Triangulation::is_flippable(HalfEdge h) const {
  return mesh_.constraint(h) == 0 && !is_ghost(triangle_of(h)) && !is_ghost(triangle_of(twin(h)));
}

bool Triangulation::prefers_flip(HalfEdge h) const {
  return is_flippable(h) && conflicts(h, positions_[apex(twin(h))], lattice_);
}

// Edges on stack_ may change under the flips of others; what a flip moves, it puts on the stack again.
void Triangulation::legalize() {
  while (!stack_.empty()) {
    const HalfEdge h = stack_.back();
    stack_.pop_back();
    if (!prefers_flip(h)) {
      continue;
    }
    const HalfEdge diagonal = mesh_.flip(h);
    const HalfEdge other = twin(diagonal);
    for (const HalfEdge side : {diagonal, other}) {
      stack_.push_back(next(side));
      stack_.push_back(previous(side));
      report(apex(side));
    }
    report(origin(diagonal));
    report(target(diagonal));
  }
}

}  // namespace radvor::delaunay
