// The parts of the triangulation that are neither insertion, removal, constraints nor questions.
#include "delaunay/triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"

namespace radvor::delaunay {

Triangulation::Triangulation(std::pmr::memory_resource* memory)
    : memory_(memory),
      mesh_(memory),
      positions_(memory),
      values_(memory),
      hints_(memory),
      reused_(memory),
      changed_(memory),
      changed_before_(memory),
      reports_(memory),
      stack_(memory),
      cavity_(memory) {}

bool Triangulation::is_vertex(VertexId vertex) const {
  return vertex < positions_.size() && !std::isnan(positions_[vertex].x);
}

void Triangulation::require_vertex(VertexId vertex) const {
  if (!is_vertex(vertex)) {
    throw Error(ErrorCode::invalid_argument, "there is no vertex %u", vertex);
  }
}

VertexId Triangulation::only_vertex() const {
  VertexId vertex = 0;
  while (!is_vertex(vertex)) {
    ++vertex;
  }
  return vertex;
}

std::uint32_t Triangulation::triangle_count() const {
  // A sphere of n + 1 vertices has 2 n - 2 triangles; as many are ghosts as the hull has edges.
  if (flat_) {
    return 0;
  }
  std::uint32_t hull_size = 0;
  const HalfEdge first = hull_edge();
  HalfEdge h = first;
  do {
    ++hull_size;
    h = hull_next(h);
  } while (h != first);
  return mesh_.live_count() - hull_size;
}

HalfEdge Triangulation::find_edge(VertexId a, VertexId b) const {
  const HalfEdge first = mesh_.out(a);
  if (first == k_none) {
    return k_none;
  }
  HalfEdge h = first;
  do {
    if (target(h) == b) {
      return h;
    }
    h = rotate_ccw(h);
  } while (h != first);
  return k_none;
}

std::uint8_t Triangulation::constraint_flags(VertexId a, VertexId b) const {
  if (!is_vertex(a) || !is_vertex(b)) {
    return 0;
  }
  const HalfEdge h = find_edge(a, b);
  return h == k_none ? std::uint8_t{0} : mesh_.constraint(h);
}

std::uint32_t Triangulation::constraint_count() const {
  std::uint32_t sides = 0;
  for (TriangleId t = 0; t < mesh_.record_count(); ++t) {
    if (!mesh_.is_free(t)) {
      for (const std::uint8_t flags : mesh_.triangle(t).constraint) {
        sides += flags != 0;
      }
    }
  }
  return sides / 2;
}

HalfEdge Triangulation::hull_edge() const {
  if (vertex_count_ < 2) {
    return k_none;
  }
  // A walk in one direction ends in a ghost: rotate to the edge that leads farthest up, and so on.
  VertexId top = last_;
  for (bool rising = true; rising;) {
    rising = false;
    VertexId higher = top;
    for_each_neighbour(top, [&](VertexId neighbour) {
      if (lexicographically_less(positions_[higher], positions_[neighbour])) {
        higher = neighbour;
        rising = true;
      }
    });
    top = higher;
  }
  HalfEdge h = mesh_.out(top);  // the greatest of all vertices is on the hull
  while (!is_ghost(triangle_of(h))) {
    h = rotate_ccw(h);
  }
  while (apex(h) != k_infinite) {
    h = next(h);
  }
  return twin(h);
}

// The ghost of a -> b (with the hull on the left) is (b, a, infinite); the next hull edge starts at b.
HalfEdge Triangulation::hull_next(HalfEdge hull) const {
  const HalfEdge ghost = twin(hull);              // b -> a
  const HalfEdge beside = twin(previous(ghost));  // b -> infinite, of the ghost (c, b, infinite)
  return twin(previous(beside));
}

// Sorting a long report would take longer than the edit.
void Triangulation::make_report_unique() {
  constexpr std::size_t k_short = 48;
  if (changed_.size() <= k_short) {
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    std::erase_if(changed_, [&](VertexId v) { return !is_vertex(v); });
    return;
  }
  if (reports_.size() < positions_.size()) {
    reports_.resize(positions_.capacity(), 0);
  }
  if (++report_number_ == 0) {
    std::fill(reports_.begin(), reports_.end(), 0u);
    ++report_number_;
  }
  std::erase_if(changed_, [&](VertexId v) {
    return std::exchange(reports_[v], report_number_) == report_number_ || !is_vertex(v);
  });
}

}  // namespace radvor::delaunay
