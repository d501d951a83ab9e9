// The sites that facets share: welded vertices on borders, and the points along welded edges between them. Numbered
// before any facet is triangulated, so that facets can be built side by side.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"
#include "surface/border.h"
#include "surface/surface.h"

namespace radvor {

/// A site inside a welded edge.
struct EdgeSite {
  std::uint32_t site;
  std::int64_t step;  ///< from the edge's middle, in units of the spacing at the finest level
};

class BorderSites {
 public:
  /// Of all edges that bound or cut a facet of a mesh that receives, at the first elements' spacing.
  BorderSites(const Scene& scene, const WeldedScene& welded, const Facets& facets, const SurfaceOptions& options,
              std::pmr::memory_resource* memory);

  /// The first ones: vertices, then the edges' inner sites, both in the order of the welded scene.
  std::pmr::vector<Site> list() const;
  std::uint32_t first_count() const { return first_count_; }

  /// k_none: no border ends there.
  std::uint32_t at_vertex(std::uint32_t vertex) const { return of_vertex_[vertex]; }
  /// Inner sites of an edge, from its a to its b.
  std::span<const EdgeSite> on_edge(std::uint32_t edge) const {
    return std::span(sites_).subspan(ranges_[edge].first, ranges_[edge].count);
  }
  std::uint32_t count_on_edge(std::uint32_t edge) const { return ranges_[edge].count; }
  /// Whether the edge has sites on some level: a facet that receives ends there, or is cut.
  bool carries(std::uint32_t edge) const { return carries_[edge] != 0; }

  EdgeLine line(std::uint32_t edge) const;
  /// Of a site, along its edge, scene units.
  double from_middle(std::int64_t step) const { return static_cast<double>(step) * unit_; }
  double unit() const { return unit_; }
  /// Between the first ones.
  double spacing() const { return spacing_; }

  /// More sites of one edge, by ascending step.
  void insert(std::uint32_t edge, std::span<const EdgeSite> more);

  /// Whether irradiance is shared across the edge: it is smooth, and exactly two facets that receive meet there with
  /// their fronts on the same side.
  bool joins(std::uint32_t edge) const { return joins_[edge] != 0; }

 private:
  struct Range {
    std::uint32_t first = 0, count = 0;
  };

  const WeldedScene& welded_;
  double spacing_, unit_;
  std::uint32_t first_count_ = 0;
  std::pmr::vector<std::uint32_t> of_vertex_;
  std::pmr::vector<Range> ranges_;  // per edge: into sites_
  std::pmr::vector<EdgeSite> sites_;
  std::pmr::vector<std::uint8_t> carries_, joins_;
};

}  // namespace radvor
