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
  /// The same, of corners near the triangle's circle: in-circle determinants are at most `tolerance` of the sum of
  /// their terms' magnitudes, and of four times the triangle's doubled area times the greatest squared distance of one
  /// of its corners from the other corner; 0: on it. Unlike ties these are no classes: `taken`, not 0 for triangles of
  /// other polygons (by id), keeps them apart.
  std::uint32_t collect_near(const Triangulation& triangulation, TriangleId seed, double tolerance,
                             std::span<const std::uint8_t> taken);
  std::span<const TriangleId> triangles() const { return triangles_; }
  std::span<const VertexId> corners() const { return corners_; }  ///< ccw from the lexicographically least

  /// Of each corner: the half-edge to the next one, inside of the polygon.
  HalfEdge side(const Triangulation& triangulation, std::size_t corner) const {
    return triangulation.twin(outer_[corner]);
  }

  /// Decides the diagonals; false where they run like that already.
  bool resolve(const Triangulation& triangulation);
  /// The same for values of the caller's, one a corner: also false where the diagonals there are cost no more, and
  /// where a triangle would have no area, as it may where corners are near the circle alone.
  bool resolve(const Triangulation& triangulation, std::span<const double> values);
  /// function(a, b, c) for each triangle as decided: numbers of corners, counter-clockwise.
  template <class Function>
  void for_each_decided(Function&& function) {
    start_cutting();
    for (const std::uint32_t ear : ears_) {
      const std::uint32_t a = before_[ear], c = after_[ear];
      function(a, ear, c);
      after_[a] = c;
      before_[c] = a;
    }
  }
  /// Rewrites the triangles as decided.
  void apply(Mesh& mesh) const;

 private:
  template <class Belongs>
  std::uint32_t collect_where(const Triangulation& triangulation, TriangleId seed, Belongs&& belongs);
  void decide();
  bool is_new(const Triangulation& triangulation);
  void start_cutting();
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
