// A facet as a polygon in its own plane: what traces are clipped to, and the outline that they end at.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "scene/box_tree.h"
#include "scene/facets.h"
#include "scene/welded.h"

namespace radvor {

/// A welded edge that bounds the facet, or that cuts it already (all kinds but interior).
struct PlanEdge {
  std::uint32_t edge;
  std::uint32_t a, b;  ///< welded
  Vec2 from, to;       ///< of a and b, snapped
};

/// Where a part of a segment begins and ends: 0 at its a, 1 at its b.
struct Stretch {
  double from, to;
};

/// From a point to the nearest of a segment.
double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b);

class FacetPlan {
 public:
  FacetPlan(const WeldedScene& welded, const Facets& facets, std::uint32_t facet, std::pmr::memory_resource* memory);

  /// Replaces `inside` with the parts of a segment that lie in the facet, or no farther than `slack` beside it; parts
  /// nearer to each other than that are one.
  void clip(const Vec2& a, const Vec2& b, double slack, std::pmr::vector<Stretch>& inside) const;

  /// Whether a point lies in the facet, or no farther than `slack` beside it.
  bool contains(const Vec2& point, double slack) const;

  std::span<const PlanEdge> outline() const { return outline_; }

  /// Where along an edge of the outline, 0 at its a, the plane of another facet cuts it: worked out in space, so that
  /// all facets at the edge have the same answer, which in their own planes is apart where something is cut at a sharp
  /// angle. Nothing where the edge's ends are on one side, or no farther apart than `least` as seen along the plane.
  std::optional<double> cut_by(std::uint32_t outline_edge, std::uint32_t facet, double least) const;

  /// Calls visit(index into outline()) for all edges whose box, grown by `margin`, meets that of a-b, and perhaps for
  /// others.
  template <class Visit>
  void for_each_edge_near(const Vec2& a, const Vec2& b, double margin, Visit&& visit) const {
    Box box;
    box.add(Vec3(a - margin, 0.0));
    box.add(Vec3(a + margin, 0.0));
    box.add(Vec3(b - margin, 0.0));
    box.add(Vec3(b + margin, 0.0));
    edge_tree_->walk([&](const Box& node) { return node.overlaps(box); }, visit);
  }

 private:
  using Corners = std::array<Vec2, 3>;

  template <class Visit>
  void for_each_triangle_near(const Box& box, Visit&& visit) const {
    triangle_tree_->walk([&](const Box& node) { return node.overlaps(box); },
                         [&](std::uint32_t i) { visit(triangles_[i]); });
  }

  const WeldedScene& welded_;
  const Facets& facets_;
  std::pmr::vector<Corners> triangles_;
  std::pmr::vector<PlanEdge> outline_;
  std::optional<BoxTree> triangle_tree_, edge_tree_;
};

}  // namespace radvor
