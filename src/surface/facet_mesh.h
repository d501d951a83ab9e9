// One facet's triangles: a constrained Delaunay triangulation of its border, border sites and lattice. A facet that is
// too degenerate for that keeps its own triangles instead (source_triangles.h).
#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/cells.h"
#include "delaunay/triangulation.h"
#include "surface/facet_draft.h"
#include "surface/lattice.h"
#include "surface/surface.h"

namespace radvor {

class FacetMesh {
 public:
  /// Fills the draft. Triangles name the facet's shares until number_shares gives them the surface's numbers.
  FacetMesh(const FacetInput& input, FacetDraft& draft);

  /// Whether a facet is more than a single triangle that needs no sites beyond its corners.
  static bool needed(const FacetInput& input);

  void number_shares(std::uint32_t first);

  std::span<const ShareTriangle> triangles() const { return triangles_; }

  /// The facet was too degenerate: there is no triangulation, and each triangle's corners are shares of their own.
  bool degenerate() const { return !delaunay_.has_value(); }

  // ---- Not of degenerate facets

  const delaunay::Triangulation& triangulation() const { return *delaunay_; }

  /// The polygon of a share of a vertex, counter-clockwise in the facet's plane; in the buffer.
  std::span<const Vec2> cell(std::uint32_t vertex, std::uint32_t share, delaunay::CellBuffer& buffer) const;

  /// The triangle at a point of the facet's plane, or the nearest where it is beside all: an index into triangles().
  std::uint32_t locate(const Vec2& point) const;

 private:
  friend class FacetTriangulator;

  std::uint32_t nearest_triangle(const Vec2& point) const;

  std::optional<delaunay::Triangulation> delaunay_;
  std::optional<FacetLattice> lattice_;
  std::pmr::vector<ShareTriangle> triangles_;
  std::pmr::vector<std::uint32_t> index_of_triangle_;  // per triangle of the triangulation: into triangles_, or k_none
  std::pmr::vector<std::uint32_t> first_share_;        // per vertex; the shares of its sectors follow one another
};

}  // namespace radvor
