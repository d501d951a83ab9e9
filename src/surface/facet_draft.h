// A facet's part of the surface while it is being made: shares, before the surface numbers them.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"
#include "surface/border_sites.h"
#include "surface/lattice.h"
#include "surface/surface.h"

namespace radvor {

/// A site that lies inside of one facet.
struct InnerSite {
  Vec2 position;  ///< exact
  std::uint32_t site;
};

/// All that a facet's triangles are made from.
struct FacetInput {
  const Scene& scene;
  const WeldedScene& welded;
  const Facets& facets;
  const SurfaceOptions& options;
  const BorderSites& borders;
  std::pmr::memory_resource* memory;
  std::uint32_t index;                    ///< of the facet
  std::span<const InnerSite> given = {};  ///< sites inside that the host wants: obstacles to the lattice
  /// All sites inside, given ones too; absent: those of the first elements' lattice, which are still to be found.
  std::optional<std::span<const InnerSite>> inner = {};

  const Facet& facet() const { return facets.facets[index]; }
};

/// Where a share's normal and colour come from: a side of one of the facet's triangles that the site lies on.
struct SourceSide {
  std::uint32_t triangle = k_none;  ///< welded; k_none: the site lies inside the facet
  std::uint8_t side = 0;
};

/// One sector of one vertex of the facet.
struct FacetShare {
  std::uint32_t vertex;                 ///< in the facet's triangulation
  std::uint32_t site = k_none;          ///< shared with other facets, or k_none
  std::uint32_t inner_vertex = k_none;  ///< welded vertex that is a site in this facet alone, or k_none
  SourceSide source;
  Vec2 position{0.0};
  Vec2 centroid{0.0};
  Vec2 receiver{0.0};
  double area = 0;
};

/// A piece of a welded edge between neighbouring sites, with the shares at its ends on the facet's side.
struct BorderPiece {
  std::uint32_t edge;
  std::uint32_t index;      ///< counted from the edge's a
  std::uint32_t low, high;  ///< nearer to a, nearer to b
};

/// shares and lattice are let go once the surface's shares are made of them; the others stay until the facet is made
/// anew.
struct FacetDraft {
  explicit FacetDraft(std::pmr::memory_resource* memory)
      : shares(memory), lattice(memory), pieces(memory), joined(memory) {}

  void clear() {
    shares.clear();
    lattice.clear();
    pieces.clear();
    joined.clear();
  }

  void let_go() {
    std::pmr::vector<FacetShare>(shares.get_allocator()).swap(shares);
    std::pmr::vector<LatticeIndex>(lattice.get_allocator()).swap(lattice);
  }
  void let_all_go() {
    let_go();
    std::pmr::vector<BorderPiece>(pieces.get_allocator()).swap(pieces);
    std::pmr::vector<std::array<std::uint32_t, 2>>(joined.get_allocator()).swap(joined);
  }

  std::pmr::vector<FacetShare> shares;
  std::pmr::vector<LatticeIndex> lattice;                 ///< of the first elements' level: the inner sites found
  std::pmr::vector<BorderPiece> pieces;                   ///< of edges that irradiance is shared across
  std::pmr::vector<std::array<std::uint32_t, 2>> joined;  ///< shares that are one sample within the facet
};

}  // namespace radvor
