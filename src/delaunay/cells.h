// Voronoi cells as polygons: bounded by constraints (what belongs to the nearest site that a point sees), or clipped to
// a convex window. See "The Bounded Voronoi Diagram", R. Seidel, and the constrained Delaunay triangulation it is dual
// to.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "delaunay/cell_polygon.h"
#include "delaunay/id_map.h"
#include "delaunay/seamless_view.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

/// One wedge of a site's neighbourhood: between two consecutive blocking constraint edges (or the edge of the domain),
/// or all of it where none ends at the site.
struct Sector {
  HalfEdge first;                ///< out of the site, the clockwise end of the wedge; any where nothing blocks
  std::uint32_t triangle_count;  ///< of the star, counter-clockwise from the one left of first
  bool closed;                   ///< the wedge is the whole disk and nothing blocks
  std::uint32_t begin, end;      ///< its polygon in CellBuffer::points
  double area;
  Vec2 centroid;
};

/// Results and scratch of a cell query, reused from call to call by one thread.
class CellBuffer {
 public:
  explicit CellBuffer(std::pmr::memory_resource* memory);

  /// Sectors counter-clockwise, starting with the one whose first edge leads to the lowest vertex id. Only what is
  /// inside of the domain counts. Empty where the site has no triangle inside.
  std::span<const Sector> sectors() const { return sectors_; }
  /// Counter-clockwise, star-shaped about the site, which is a corner of it unless the sector is closed.
  std::span<const Vec2> polygon(const Sector& sector) const {
    return std::span<const Vec2>(points_).subspan(sector.begin, sector.end - sector.begin);
  }
  double area() const;  ///< of all sectors

 private:
  friend class CellBuilder;

  std::pmr::vector<Sector> sectors_;
  std::pmr::vector<Vec2> points_;
  CellPolygon polygon_;
  std::pmr::vector<HalfEdge> stack_;
  IdMap visited_;
  SeamlessView view_;
};

/// The cell of a site: the points inside of the domain whose nearest visible site it is; blocking constraint edges
/// (border, discontinuous), the domain's border and the convex hull block the view.
void bounded_cell(const Triangulation& triangulation, VertexId site, CellBuffer& buffer);

/// The ordinary Voronoi cell, constraints ignored, clipped to a convex counter-clockwise window: one closed sector, or
/// none where they do not meet.
void window_cell(const Triangulation& triangulation, VertexId site, std::span<const Vec2> window, CellBuffer& buffer);

}  // namespace radvor::delaunay
