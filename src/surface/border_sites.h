// The sites that facets share: welded vertices on borders, and the points along welded edges between them. Numbered
// before any facet is triangulated, so that facets can be built side by side.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"
#include "surface/border.h"
#include "surface/surface.h"

namespace radvor {

class BorderSites {
 public:
  /// Of all edges that bound or cut a facet of a mesh that receives. spacing: between sites, scene units.
  BorderSites(const Scene& scene, const WeldedScene& welded, const Facets& facets, double spacing,
              std::pmr::memory_resource* memory);

  /// Vertices first, then the edges' inner sites, both in the order of the welded scene.
  std::pmr::vector<Site> list() const;

  std::uint32_t size() const { return first_of_edge_.back(); }
  /// k_none: no border ends there.
  std::uint32_t at_vertex(std::uint32_t vertex) const { return of_vertex_[vertex]; }
  /// Inner sites of an edge, numbered on from the first, from its a to its b.
  std::uint32_t first_on_edge(std::uint32_t edge) const { return first_of_edge_[edge]; }
  std::uint32_t count_on_edge(std::uint32_t edge) const { return first_of_edge_[edge + 1] - first_of_edge_[edge]; }
  EdgeSites along(std::uint32_t edge) const;

  /// Whether irradiance is shared across the edge: it is smooth, and exactly two facets that receive meet there with
  /// their fronts on the same side.
  bool joins(std::uint32_t edge) const { return joins_[edge] != 0; }

 private:
  const WeldedScene& welded_;
  double spacing_;
  std::pmr::vector<std::uint32_t> of_vertex_;
  std::pmr::vector<std::uint32_t> first_of_edge_;
  std::pmr::vector<std::uint8_t> joins_;
};

}  // namespace radvor
