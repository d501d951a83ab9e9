// The usual removal: a vertex inside, with few neighbours and no constraint around. Its star is a polygon whose
// triangulation consists of Delaunay triangles of the neighbours alone: the apex over an edge is the neighbour whose
// circle through the edge holds no other (O. Devillers, "On Deletion in Delaunay Triangulations", 2002, on choosing
// directly for low degrees). It changes nothing until all is decided, and allocates nothing then.
#include <array>

#include "delaunay/triangulation.h"

namespace radvor::delaunay {

bool Triangulation::close_hole(VertexId v) {
  constexpr std::uint32_t k_most = 24;  // neighbours; quadratic time
  std::array<VertexId, k_most> ring;    // counter-clockwise
  std::array<HalfEdge, k_most> outer;   // beyond the edge from ring[i] to ring[i + 1]
  std::array<TriangleId, k_most> triangles;
  std::array<Vec2, k_most> at;
  std::uint32_t degree = 0;
  const HalfEdge first = mesh_.out(v);
  HalfEdge h = first;
  do {
    const Triangle& record = mesh_.triangle(triangle_of(h));
    const std::uint32_t corner = corner_of(h);
    const std::uint32_t after = corner == 2 ? 0 : corner + 1;
    const std::uint32_t before = corner == 0 ? 2 : corner - 1;
    const VertexId neighbour = record.vertex[after];
    if (degree == k_most || neighbour == k_infinite || (record.constraint[corner] | record.constraint[after]) != 0) {
      return false;
    }
    ring[degree] = neighbour;
    outer[degree] = record.twin[after];
    triangles[degree] = triangle_of(h);
    at[degree] = positions_[neighbour];
    ++degree;
    h = record.twin[before];
  } while (h != first);

  // The part of the polygon from corner i to j, beyond the edge from j to i.
  struct Part {
    std::uint8_t i, j, beyond;  // beyond: the corner of the triangle at the edge's other side
    std::uint8_t apex;
  };
  std::array<Part, k_most> parts;  // one a triangle; those before it are decided
  std::uint32_t decided = 0, known = 0;
  parts[known++] = {0, static_cast<std::uint8_t>(degree - 1), k_most, 0};
  while (decided < known) {
    Part& part = parts[decided++];
    const std::uint32_t i = part.i, j = part.j;
    // A constraint not far away may hide neighbours from each other, so that more than a circle decides.
    const auto is_delaunay = [&](std::uint32_t apex) {
      if (orientation(at[j], at[i], at[apex], lattice_) <= 0) {
        return false;
      }
      const int side = part.beyond == k_most ? -1 : in_circle(at[j], at[i], at[apex], at[part.beyond], lattice_);
      return side < 0 || (side == 0 && !wins_tie(at[j], at[i], at[apex], at[part.beyond]));
    };
    std::uint32_t best = i + 1;
    if (j > i + 2) {
      best = j;
      for (std::uint32_t k = i + 1; k < j; ++k) {
        if (orientation(at[j], at[i], at[k], lattice_) <= 0) {
          continue;
        }
        if (best == j) {
          best = k;
          continue;
        }
        const int side = in_circle(at[j], at[i], at[best], at[k], lattice_);
        if (side > 0 || (side == 0 && wins_tie(at[best], at[j], at[i], at[k]))) {
          best = k;
        }
      }
      if (best == j) {
        return false;
      }
    }
    if (constrained_ && !is_delaunay(best)) {
      return false;
    }
    part.apex = static_cast<std::uint8_t>(best);
    if (best > i + 1) {
      parts[known++] = {part.i, part.apex, part.j, 0};
    }
    if (j > best + 1) {
      parts[known++] = {part.apex, part.j, part.i, 0};
    }
  }

  changed_.assign(ring.begin(), ring.begin() + degree);
  const std::uint8_t state = mesh_.state(triangles[0]);
  // parents[k]: the half-edge from i to j of part k, known once its parent is written.
  std::array<HalfEdge, k_most> parents;
  parents[0] = outer[degree - 1];
  std::uint32_t child = 1;
  for (std::uint32_t k = 0; k < known; ++k) {
    const std::uint32_t i = parts[k].i, j = parts[k].j, apex = parts[k].apex;
    const TriangleId t = triangles[k];
    mesh_.set_triangle(t, ring[i], ring[apex], ring[j], state);
    mesh_.link(half_edge(t, 2), parents[k]);
    if (apex > i + 1) {
      parents[child++] = half_edge(t, 0);
    } else {
      mesh_.link(half_edge(t, 0), outer[i]);
    }
    if (j > apex + 1) {
      parents[child++] = half_edge(t, 1);
    } else {
      mesh_.link(half_edge(t, 1), outer[apex]);
    }
  }
  mesh_.release(triangles[degree - 1]);
  mesh_.release(triangles[degree - 2]);
  last_ = ring[0];
  return true;
}

}  // namespace radvor::delaunay
