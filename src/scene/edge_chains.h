// T-junctions: every segment between two corners becomes the chain of edges between the vertices that lie inside it.
// The chain belongs to the segment, not to a triangle, so all sides that share a segment share its edges.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/jobs.h"
#include "base/vector.h"
#include "scene/box_tree.h"
#include "scene/index_table.h"
#include "scene/position_welding.h"

namespace radvor {

/// What counts as touching: positions given as floats are only known to their precision.
struct Tolerance {
  std::span<const Vec3> positions;
  std::span<const double> precision;  ///< per vertex, of its position
  double weld_distance;               ///< what is closer than this touches anyway

  double touching(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return touching_distance(precision[a] + precision[b] + precision[c], weld_distance);
  }
};

/// The corner opposite the longest side (0..2) where the triangle is degenerate after Tolerance, else -1.
int apex_of_sliver(const Tolerance& tolerance, const std::array<std::uint32_t, 3>& vertices);

class EdgeChains {
 public:
  EdgeChains(const Tolerance& tolerance, std::pmr::memory_resource* memory);

  /// Adds the segments of a triangle, kept or dropped, and returns them, that of side i from corner i to the next; a
  /// dropped triangle lays its apex (0..2) into its longest side.
  std::array<std::uint32_t, 3> add_triangle(const std::array<std::uint32_t, 3>& vertices, int apex = -1);

  /// Finds the vertices of added triangles that lie inside segments, in the segments that arise from these too, until
  /// none is left.
  void split(const Jobs& jobs);

  /// An edge of the answer: no vertex inside.
  struct Link {
    std::uint32_t from, to;
    std::uint32_t segment;  ///< the same for all links between these two vertices
    std::uint32_t parent;   ///< the segment whose division put `from` there; its own where it is the corner
  };
  /// Whether some vertex lies inside.
  bool is_divided(std::uint32_t segment) const { return segments_[segment].inside_count > 0; }
  /// Appends the edges that make up a segment, from one of its ends to the other.
  void chain(std::uint32_t segment, std::uint32_t from, std::pmr::vector<Link>& links);

  /// Takes back that a vertex lies inside a segment: a triangle's outline would touch itself there. After all refusals
  /// split() must run again.
  void refuse(std::uint32_t segment, std::uint32_t vertex);

  std::uint32_t segment_count() const { return static_cast<std::uint32_t>(segments_.size()); }

 private:
  struct Inside {
    std::uint32_t vertex;
    double along;  ///< 0 at a, 1 at b
  };
  struct Segment {
    std::uint32_t a, b;              ///< a < b
    std::uint32_t first_inside = 0;  ///< into inside_, from a to b
    std::uint32_t inside_count = 0;
    std::uint32_t first_child = 0;  ///< into children_, one more than vertices inside
  };
  struct Found {
    std::uint32_t segment;
    Inside inside;
  };

  std::uint32_t segment_between(std::uint32_t a, std::uint32_t b);
  double parameter(const Segment& segment, std::uint32_t vertex) const;
  bool is_smaller(std::uint32_t from, std::uint32_t to, const Segment& than) const;
  void plant_tree();
  void lay_apexes();
  void hand_down(std::uint32_t segment, std::uint32_t vertex);
  void find_inside(std::uint32_t segment, std::pmr::vector<Found>& found) const;
  bool are_twins(std::uint32_t segment, std::uint32_t a, std::uint32_t b) const;
  void sort_along(std::span<Found> found) const;
  void lay_inside(std::span<Found> found);
  void divide(std::uint32_t segment);

  Tolerance tolerance_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<Segment> segments_;
  IndexTable table_;
  std::pmr::vector<Inside> inside_;
  std::pmr::vector<std::uint32_t> children_;       ///< segments
  std::pmr::vector<Found> apexes_;                 ///< of dropped slivers: what closes over these needs them
  std::pmr::vector<std::uint32_t> tree_vertices_;  ///< the vertices of triangles
  std::pmr::vector<bool> in_tree_;
  std::optional<BoxTree> tree_;
  std::uint32_t searched_ = 0;  ///< segments before this one know what lies inside
  std::pmr::vector<Link> stack_;
};

}  // namespace radvor
