// The rule that makes a Delaunay triangulation, in line for the loops that do little else.
#pragma once

#include "delaunay/triangulation.h"

namespace radvor::delaunay {

// Does the point destroy the triangle? entry: its edge towards the cavity, with the point beyond it. A ghost does
// where the point is strictly beyond its hull edge, or within that edge. On the circle exactly the rule is that of a
// circle test on points lifted to the paraboloid whose lexicographically least one is lowered a little: every
// cocircular polygon becomes the fan of its least vertex, in whatever order its points come.
inline bool Triangulation::conflicts(HalfEdge entry, Vec2 point, const Lattice& lattice) const {
  const Triangle& record = mesh_.triangle(triangle_of(entry));
  const std::uint32_t corner = corner_of(entry);
  const VertexId a = record.vertex[corner];
  const VertexId b = record.vertex[corner == 2 ? 0 : corner + 1];
  const VertexId c = record.vertex[corner == 0 ? 2 : corner - 1];
  if (a == k_infinite || b == k_infinite || c == k_infinite) [[unlikely]] {
    const Vec2 from = positions_[a == k_infinite ? b : b == k_infinite ? c : a];
    const Vec2 to = positions_[a == k_infinite ? c : b == k_infinite ? a : b];
    const int side = orientation(from, to, point, lattice);
    return side > 0 || (side == 0 && lexicographically_less(from, point) == lexicographically_less(point, to));
  }
  const int side = in_circle(positions_[a], positions_[b], positions_[c], point, lattice);
  if (side != 0) [[likely]] {
    return side > 0;
  }
  return wins_tie(positions_[a], positions_[b], positions_[c], point);
}

}  // namespace radvor::delaunay
