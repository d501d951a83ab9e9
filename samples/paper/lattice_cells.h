// Sites on a lattice over the unit square and their Voronoi cells, by radvor's Delaunay kernel.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "floor_bake.h"

namespace paper {

/// The sites of a lattice (RADVOR_LATTICE_*) inside the unit square; one of them is the anchor.
std::vector<glm::dvec2> lattice_sites(std::uint32_t lattice, double spacing, const glm::dvec2& anchor);
/// Between the sites of a lattice that has so many in a unit of area.
double spacing_for(std::uint32_t lattice, double density);

/// The triangulation of sites, and what follows from it.
class Diagram {
 public:
  explicit Diagram(const std::vector<glm::dvec2>& sites);

  /// Clipped to the unit square.
  std::vector<glm::dvec2> cell(std::uint32_t site) const;
  /// 3 a triangle.
  std::vector<std::uint32_t> triangles() const;
  const std::vector<glm::dvec2>& sites() const { return sites_; }

 private:
  std::vector<glm::dvec2> sites_;
  Context context_;
  Delaunay delaunay_;
};

}  // namespace paper
