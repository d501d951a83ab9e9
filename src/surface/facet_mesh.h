// One facet's triangles: a constrained Delaunay triangulation of its border, border sites and lattice. A facet that is
// too degenerate for that keeps its own triangles instead (cut_triangles.h).
#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/prefetch.h"
#include "delaunay/cells.h"
#include "delaunay/triangulation.h"
#include "surface/facet_draft.h"
#include "surface/lattice.h"
#include "surface/quick_location.h"
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

  /// Per vertex: those of the border in the order of its edges, then the inner ones in the order given. Empty where the
  /// facet is degenerate.
  std::span<const std::uint32_t> sites() const { return sites_; }
  std::uint32_t border_count() const { return border_count_; }
  /// Numbers for inner sites that were still to be found: site_of(k) of the k-th.
  template <class SiteOf>
  void number_sites(SiteOf&& site_of) {
    std::size_t count = 0;
    for (std::size_t vertex = border_count_; vertex < sites_.size(); ++vertex) {
      if (sites_[vertex] == k_none) {
        sites_[vertex] = site_of(count++);
      }
    }
  }

  /// The shares of a vertex follow one another: its first, and the next vertex's.
  std::uint32_t first_share(std::uint32_t vertex) const { return first_share_[vertex]; }
  std::uint32_t end_share(std::uint32_t vertex) const { return first_share_[vertex + 1]; }

  /// Fills quick(), which tells triangles as locate does, to rays: it finds nothing before that, where the facet is
  /// degenerate, and once ties are aligned.
  void prepare_location() {
    if (delaunay_) {
      quick_.fill(*delaunay_, index_of_triangle_);
    }
  }
  const QuickLocation& quick() const { return quick_; }
  /// Asks memory ahead for what quick() and triangles() read of the mesh itself.
  void fetch() const {
    prefetch(quick_);
    prefetch(triangles_);
  }

  /// The facet was too degenerate: there is no triangulation, and each triangle's corners are shares of their own.
  bool degenerate() const { return !delaunay_.has_value(); }

  // ---- Not of degenerate facets

  const delaunay::Triangulation& triangulation() const { return *delaunay_; }
  const FacetLattice& lattice() const { return *lattice_; }

  /// Cocircular polygons, and those nearly so, are triangulated anew so that diagonals join shares of similar value;
  /// the triangulation stays as it is. value_of: per share, NaN where it has none. tolerance: relative, see
  /// delaunay/tie_polygon.h.
  Ties align_ties(std::span<const double> value_of, double tolerance, std::pmr::memory_resource* memory);

  bool ties_are_aligned() const { return !next_in_polygon_.empty(); }

  /// Another triangle of the same polygon of ties, and so on round to the first; itself where there is none.
  std::uint32_t next_in_polygon(std::uint32_t triangle) const {
    return next_in_polygon_.empty() ? triangle : next_in_polygon_[triangle];
  }

  /// The polygon of a share of a vertex, counter-clockwise in the facet's plane; in the buffer.
  std::span<const Vec2> cell(std::uint32_t vertex, std::uint32_t share, delaunay::CellBuffer& buffer) const;

  /// The triangle at a point of the facet's plane, or the nearest where it is beside all: an index into triangles().
  std::uint32_t locate(const Vec2& point) const;
  /// As locate, without exact arithmetic, and with weights of the corners; k_none where it cannot tell. Before ties are
  /// aligned.
  std::uint32_t locate_roughly(const Vec2& point, std::array<double, 3>& weights) const {
    const delaunay::TriangleId found = delaunay_->locate_roughly(point, weights, quick_.start(point));
    return found == delaunay::k_none ? k_none : index_of_triangle_[found];
  }

 private:
  friend class FacetTriangulator;

  std::uint32_t nearest_triangle(const Vec2& point) const;

  std::optional<delaunay::Triangulation> delaunay_;
  std::optional<FacetLattice> lattice_;
  QuickLocation quick_;
  std::pmr::vector<ShareTriangle> triangles_;          // beside quick_: rays read both
  std::pmr::vector<ShareTriangle> plain_triangles_;    // before ties were aligned; empty until then
  std::pmr::vector<std::uint32_t> next_in_polygon_;    // likewise
  std::pmr::vector<std::uint32_t> index_of_triangle_;  // per triangle of the triangulation: into triangles_, or k_none
  std::pmr::vector<std::uint32_t> first_share_;        // per vertex and one past the last
  std::pmr::vector<std::uint32_t> sites_;              // per vertex
  std::uint32_t border_count_ = 0;
};

}  // namespace radvor
