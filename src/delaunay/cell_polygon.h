// A convex polygon in the making: what half-planes leave of a site's cell. Its corners are computed from the vertices
// that define them, in an order of their own, so that neighbouring cells agree to the bit.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "delaunay/triangulation.h"

namespace radvor::delaunay {

/// A side: on the bisector between the site and another one, on an edge or the ray to a neighbour, or on the caller's
/// window.
struct CellSide {
  enum class Kind : std::uint8_t { bisector, line, window } kind;
  VertexId a, b;  ///< bisector: the other site; line: the polygon is left of a -> b; window: from corner a to b
  Vec2 end;       ///< where it meets the next side, counter-clockwise
};

class CellPolygon {
 public:
  explicit CellPolygon(std::pmr::memory_resource* memory) : sides_(memory), clipped_(memory) {}

  /// The polygons from now on are about this site; window: what sides of that kind speak of.
  void look(const Triangulation& triangulation, VertexId site, std::span<const Vec2> window) {
    triangulation_ = &triangulation;
    site_ = site;
    at_ = triangulation.position(site);
    window_ = window;
    sides_.clear();
  }

  /// Counter-clockwise.
  std::span<const CellSide> sides() const { return sides_; }
  void clear() { sides_.clear(); }
  void add(const CellSide& side) { sides_.push_back(side); }
  /// What was added is a chain of bisectors: drops its ends beyond the two lines, and puts the lines around it.
  void close_wedge(CellSide low, CellSide high);

  /// Cuts off what is beyond a side.
  void clip(CellSide by);
  /// > 0 on the polygon's side of it.
  double value(const CellSide& side, Vec2 point) const;
  /// Does the segment meet the inside of the polygon?
  bool cuts(Vec2 a, Vec2 b) const;
  /// Does the segment meet one of the circles around the corners through the site?
  bool meets_a_circle(Vec2 a, Vec2 b) const;
  /// Of the cells of the site, a and b.
  Vec2 corner(VertexId a, VertexId b) const;

 private:
  Vec2 position(VertexId v) const { return triangulation_->position(v); }
  bool is_side(VertexId site) const;
  Vec2 meet(const CellSide& one, const CellSide& other) const;
  Vec2 meet_lines(const CellSide& one, const CellSide& other) const;

  const Triangulation* triangulation_ = nullptr;
  VertexId site_ = k_none;
  Vec2 at_{0.0};
  std::span<const Vec2> window_;
  std::pmr::vector<CellSide> sides_, clipped_;
};

}  // namespace radvor::delaunay
