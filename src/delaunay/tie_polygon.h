// One cocircular polygon: its triangles, its corners in order, and how its diagonals ought to run.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "delaunay/triangulation.h"

namespace radvor::delaunay {

class TiePolygon {
 public:
  explicit TiePolygon(std::pmr::memory_resource* memory);

  /// The polygon around a triangle; returns its number of corners, 3 where no tie is.
  std::uint32_t collect(const Triangulation& triangulation, TriangleId seed);
  std::span<const TriangleId> triangles() const { return triangles_; }
  std::span<const VertexId> corners() const { return corners_; }  ///< ccw from the lexicographically least

  /// Decides the diagonals; false where they run like that already.
  bool resolve(const Triangulation& triangulation);
  /// Rewrites the triangles as decided.
  void apply(Mesh& mesh) const;

 private:
  void fan();
  void resolve_exactly();
  void resolve_greedily();
  double difference(std::uint32_t i, std::uint32_t j) const;

  std::pmr::vector<TriangleId> triangles_;
  std::pmr::vector<VertexId> corners_;
  std::pmr::vector<HalfEdge> outer_;  // beyond the side from corner i to i + 1
  std::pmr::vector<double> values_;   // of the corners
  std::pmr::vector<Vec2> positions_;
  std::pmr::vector<std::uint32_t> ears_;  // corners in the order in which they are cut off
  std::pmr::vector<HalfEdge> stack_;
  std::pmr::vector<double> costs_;
  std::pmr::vector<std::uint32_t> apexes_, before_, after_;
};

}  // namespace radvor::delaunay
