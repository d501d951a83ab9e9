// The polygon domain: which triangles lie inside of the border edges.
#include "base/error.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

void Triangulation::unmark_domain() {
  for (TriangleId t = 0; t < mesh_.record_count(); ++t) {
    if (!mesh_.is_free(t)) {
      mesh_.set_state(t, 0);
    }
  }
  marked_ = false;
}

// Even-odd: one flood from a ghost that toggles at border edges. Where it comes to a triangle twice with different
// answers, the border does not close.
void Triangulation::mark_domain() {
  if (vertex_count_ < 2) {
    return;
  }
  enum : std::uint8_t { unknown, inside, outside };
  std::pmr::vector<std::uint8_t> side(mesh_.record_count(), unknown, memory_);
  std::pmr::vector<TriangleId> pending(memory_);
  const TriangleId start = triangle_of(twin(hull_edge()));
  side[start] = outside;
  pending.push_back(start);
  while (!pending.empty()) {
    const TriangleId t = pending.back();
    pending.pop_back();
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const HalfEdge h = half_edge(t, corner);
      const TriangleId neighbour = triangle_of(twin(h));
      const bool toggles = (mesh_.constraint(h) & constraint::k_border) != 0;
      const std::uint8_t expected = toggles ? static_cast<std::uint8_t>(inside + outside - side[t]) : side[t];
      if (side[neighbour] == unknown) {
        side[neighbour] = expected;
        pending.push_back(neighbour);
      } else if (side[neighbour] != expected) {
        throw Error(ErrorCode::constraint, "the border does not close: the edge from vertex %u to %u ends in the open",
                    origin(h), target(h));
      }
    }
  }
  for (TriangleId t = 0; t < mesh_.record_count(); ++t) {
    if (!mesh_.is_free(t)) {
      mesh_.set_state(t, side[t] == outside ? Triangle::k_outside : std::uint8_t{0});
    }
  }
  marked_ = true;
}

}  // namespace radvor::delaunay
