// T-junctions: every segment between two corners becomes the chain of edges between the vertices that lie inside it.
// The chain belongs to the segment, not to a triangle, so all sides that share a segment share its edges.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/jobs.h"
#include "base/vector.h"
#include "scene/box_tree.h"
#include "scene/index_table.h"

namespace radvor {

/// What counts as touching: positions given as floats are only known to their precision.
struct Tolerance {
  std::span<const Vec3> positions;
  std::span<const double> precision;  ///< per vertex, of its position
  double weld_distance;               ///< what is closer than this touches anyway

  /// A triangle no higher than this over its longest side has no plane: rounding may tilt it by ten degrees. A vertex
  /// no farther than this from a segment lies on it. One bound for both, so that dropping a sliver leaves a T-junction
  /// where the sliver's apex lies on its longest side, and never a crack.
  double touching(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    constexpr double k_roundings = 4;  // three exact corners take 1; the rest is for tools that compute in float
    const double bound = k_roundings * (precision[a] + precision[b] + precision[c]);
    return bound > weld_distance ? bound : weld_distance;
  }
};

/// The corner opposite the longest side (0..2) where the triangle is degenerate after Tolerance, else -1.
int apex_of_sliver(const Tolerance& tolerance, const std::array<std::uint32_t, 3>& vertices);

class EdgeChains {
 public:
  EdgeChains(const Tolerance& tolerance, std::pmr::memory_resource* memory);

  /// Adds the segments of a triangle, kept or dropped; a dropped one lays its apex (0..2) into its longest side.
  void add_triangle(const std::array<std::uint32_t, 3>& vertices, int apex = -1);

  /// Finds the vertices of added triangles that lie inside segments, in the segments that arise from these too, until
  /// none is left.
  void split(const Jobs& jobs);

  /// An edge of the answer: no vertex inside.
  struct Link {
    std::uint32_t from, to;
    std::uint32_t segment;  ///< the same for all links between these two vertices
  };
  /// Appends the edges that make up the segment of an added triangle, in order.
  void chain(std::uint32_t from, std::uint32_t to, std::pmr::vector<Link>& links);

  std::uint32_t segment_count() const { return static_cast<std::uint32_t>(segments_.size()); }

 private:
  struct Segment {
    std::uint32_t a, b;  ///< a < b
    std::uint32_t first_child = 0;
    std::uint32_t child_count = 0;  ///< 0: has no vertex inside
  };
  struct Inside {
    std::uint32_t segment;
    std::uint32_t vertex;
    double along;  ///< 0 at a, 1 at b
  };

  std::uint32_t segment_between(std::uint32_t a, std::uint32_t b);
  double parameter(const Segment& segment, std::uint32_t vertex) const;
  bool is_smaller(const Segment& a, const Segment& b) const;
  void find_inside(const BoxTree& tree, std::uint32_t segment, std::pmr::vector<Inside>& found) const;
  void divide(std::span<Inside> inside);

  Tolerance tolerance_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<Segment> segments_;
  IndexTable table_;
  std::pmr::vector<std::uint32_t> children_;     ///< segments, from a to b
  std::pmr::vector<Inside> apexes_;              ///< of dropped slivers
  std::pmr::vector<std::uint32_t> tree_vertex_;  ///< the vertices of triangles
  std::pmr::vector<bool> in_tree_;
  std::pmr::vector<Link> stack_;
};

}  // namespace radvor
