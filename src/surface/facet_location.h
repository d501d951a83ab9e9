// The triangle of a facet at a point of its plane, whatever the facet is made of.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "scene/facets.h"
#include "surface/facet_mesh.h"
#include "surface/surface.h"

namespace radvor {

/// A facet's triangles, and what their corners lead to.
struct LocatedFacet {
  const Frame& frame;
  std::span<const ShareTriangle> triangles;
  const FacetMesh* mesh;  ///< NULL where there is no triangulation to ask
  std::span<const Site> sites;
  std::span<const Sample> samples;
  std::span<const Share> shares;

  std::array<Vec2, 3> corners(const ShareTriangle& triangle) const;
  /// The triangle that the point is in, or nearest to; weights of its corners, >= 0.
  FacetPoint locate(const Vec2& point) const;
  /// Nothing where the point is in none, or it takes long to say.
  std::optional<FacetPoint> find(const Vec2& point) const;

 private:
  std::optional<FacetPoint> find_roughly(const Vec2& point) const;
  FacetPoint locate_exactly(const Vec2& point) const;
  std::size_t best_triangle(const Vec2& point) const;
};

}  // namespace radvor
