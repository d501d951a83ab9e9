// New vertices inside welded edges, as if a vertex of another mesh lay there: T-junctions made on purpose, so that all
// facets at an edge have them.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "scene/facets.h"
#include "scene/welded.h"

namespace radvor {

/// A vertex to be inside an edge, at a + part * (b - a); 0 < part < 1. One that is no farther than the tolerance from
/// an end of the edge is that end.
struct EdgeStop {
  std::uint32_t edge;
  double part;
  double tolerance;  ///< of the edge; stops no farther apart are one vertex
};

/// Where things are after a division.
struct EdgeDivision {
  explicit EdgeDivision(std::pmr::memory_resource* memory) : vertices(memory), first_piece(memory) {}

  std::pmr::vector<std::uint32_t> vertices;     ///< welded, of each stop in the order given
  std::pmr::vector<std::uint32_t> first_piece;  ///< per old edge, and one past the last: its pieces, from a to b
};

/// Replaces each edge that has stops by its pieces; they are of the edge's kind.
EdgeDivision divide_edges(std::span<const EdgeStop> stops, WeldedScene& welded, Facets& facets,
                          std::pmr::memory_resource* memory);

}  // namespace radvor
