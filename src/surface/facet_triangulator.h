// The steps from a facet's outline to its triangulation and shares.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "delaunay/triangulation.h"
#include "surface/facet_draft.h"
#include "surface/facet_mesh.h"
#include "surface/facet_outline.h"
#include "surface/lattice.h"
#include "surface/segments.h"

namespace radvor {

class FacetTriangulator {
 public:
  FacetTriangulator(const FacetInput& input, FacetMesh& mesh, FacetDraft& draft);

  /// Fills mesh and draft; false, with both empty, where the facet is too degenerate.
  bool run();

 private:
  std::uint32_t known_vertices() const;
  bool insert_corners(delaunay::Triangulation& triangulation);
  bool insert_borders(delaunay::Triangulation& triangulation);
  static void constrain_contact(delaunay::Triangulation& triangulation, delaunay::VertexId a, delaunay::VertexId b);
  bool insert_inner(delaunay::Triangulation& triangulation);
  void find_lattice_sites(const FacetLattice& lattice, std::pmr::vector<Vec2>& points);
  bool find_shares(const delaunay::Triangulation& triangulation);
  bool find_triangles(const delaunay::Triangulation& triangulation);
  bool find_sources(const delaunay::Triangulation& triangulation);
  delaunay::VertexId corner(std::uint32_t welded_vertex) const;

  const FacetInput& in_;
  FacetMesh& mesh_;
  FacetDraft& draft_;
  // For what is needed only until the facet is done: most facets are small, and there may be a hundred thousand.
  alignas(std::max_align_t) std::array<std::byte, 16384> room_;
  std::pmr::monotonic_buffer_resource scratch_;
  FacetOutline outline_;
  std::pmr::vector<delaunay::VertexId> chains_;     // per outline edge: its a, the sites inside, its b
  std::pmr::vector<std::uint32_t> first_of_chain_;  // per outline edge, and one past the last
  std::pmr::vector<Segment> borders_, inner_;       // outline edges: of the domain, and within it
  std::pmr::vector<std::uint32_t> share_at_;        // per half-edge: share of its origin, in its triangle
  Vec2 low_{0.0}, high_{0.0};
};

}  // namespace radvor
