#include "surface/spacing.h"

#include <algorithm>
#include <cmath>

#include "surface/lattice.h"

namespace radvor {

namespace {

constexpr double k_patches_at_unit_tolerance = 20;  // patches = this / tolerance
constexpr std::uint32_t k_refinements = 5;          // from the patches to min_spacing, where left open
constexpr std::uint32_t k_border_levels = 2;        // of those, that borders begin with
constexpr double k_contact_spacing = 0.2;           // over the tolerance and the root of the area
constexpr double k_lattice_share = 2;               // of corners, over the tolerance: sites of the first lattice
constexpr double k_most_sites = 1 << 28;            // ids are 32 bits, and a sample may have several shares

// What the number of sites depends on: lattice sites go by area, border sites by length, corners are there anyway.
struct Extent {
  double area = 0;            // of receiving sides
  double one_sided = 0;       // of receiving facets, each counted once
  double border = 0;          // length of edges that carry sites, each counted once
  std::uint32_t corners = 0;  // welded vertices on them
};

bool receives_at(const Scene& scene, const WeldedScene& welded, std::uint32_t edge) {
  const auto uses = welded.uses_at_edge(edge);
  return std::any_of(uses.begin(), uses.end(), [&](std::uint32_t use) {
    return scene.meshes[welded.triangles[welded.uses_by_triangle[use].triangle].mesh].receives;
  });
}

Extent measure(const Scene& scene, const WeldedScene& welded, const Facets& facets) {
  Extent extent;
  for (const Facet& facet : facets.facets) {
    if (scene.meshes[facet.mesh].receives) {
      extent.one_sided += facet.area;
      extent.area += scene.materials[facet.material].two_sided ? 2 * facet.area : facet.area;
    }
  }
  for (std::uint32_t edge = 0; edge < welded.edges.size(); ++edge) {
    if (facets.edge_kinds[edge] != EdgeKind::interior && receives_at(scene, welded, edge)) {
      extent.border += glm::distance(welded.positions[welded.edges[edge].a], welded.positions[welded.edges[edge].b]);
      ++extent.corners;  // planar subdivisions have up to three edges a vertex, polygons one: an upper bound
    }
  }
  extent.corners = std::min(extent.corners, static_cast<std::uint32_t>(welded.positions.size()));
  return extent;
}

// Area of a lattice's cell over the square of its spacing.
double cell_shape(Lattice lattice) {
  return lattice == Lattice::hexagonal ? 0.8660254037844386 : 1.0;
}

double estimate_sites(const Extent& extent, Lattice lattice, double spacing) {
  return extent.one_sided / (cell_shape(lattice) * spacing * spacing) + extent.border / spacing + extent.corners;
}

// Of first elements that refinement begins with. Where corners are most of the sites, and rays few, a lattice costs
// next to nothing.
std::uint32_t levels_by_corners(const Extent& extent, double patches, double tolerance) {
  std::uint32_t levels = 0;
  while (patches > 0 && levels < k_refinements - k_border_levels &&
         std::ldexp(patches, 2 * static_cast<int>(levels + 1)) <= k_lattice_share * tolerance * extent.corners) {
    ++levels;
  }
  return levels;
}

// Of first elements that stay as they are.
std::uint32_t levels_for(double tolerance) {
  if (tolerance >= 0.08) {
    return 1;
  }
  return tolerance <= 0.005 ? 3 : 2;
}

double scaled_down(double spacing, std::uint32_t levels) {
  return std::ldexp(spacing, -static_cast<int>(levels));
}

}  // namespace

double finest_spacing(const SurfaceOptions& options) {
  return scaled_down(options.patch_spacing, options.element_levels + refinements(options));
}

SurfaceOptions choose_spacing(const Scene& scene, const WeldedScene& welded, const Facets& facets,
                              const SpacingRequest& request) {
  const Extent extent = measure(scene, welded, facets);
  SurfaceOptions options;
  options.lattice = request.lattice;

  if (request.patch_spacing > 0) {
    options.patch_spacing = request.patch_spacing;
  } else if (extent.area > 0) {
    const double patches = k_patches_at_unit_tolerance / request.tolerance;
    options.patch_spacing = std::sqrt(extent.area / (patches * cell_shape(request.lattice)));
  }

  const double patches = extent.area / (cell_shape(request.lattice) * options.patch_spacing * options.patch_spacing);
  if (request.element_levels > 0) {
    options.element_levels = request.element_levels;
  } else if (!request.refines) {
    options.element_levels = levels_for(request.tolerance);
  } else {
    options.element_levels = request.patch_spacing > 0 ? 0 : levels_by_corners(extent, patches, request.tolerance);
  }
  options.border_levels = request.refines ? k_border_levels : 0;
  options.contact_spacing = k_contact_spacing * request.tolerance * std::sqrt(extent.area);
  options.raises_first = true;
  options.max_sites = request.max_sites;
  if (request.element_levels == 0) {
    while (options.element_levels > 0 &&
           scaled_down(options.patch_spacing, options.element_levels) < request.min_spacing) {
      --options.element_levels;
    }
  }

  // Corners alone may exceed the limit: then nothing is gained by a spacing beyond the scene's size.
  const double most = request.max_sites > 0 ? static_cast<double>(request.max_sites) : k_most_sites;
  const double scene_size = glm::distance(welded.low, welded.high);
  while (scaled_down(options.patch_spacing, options.element_levels) < scene_size &&
         estimate_sites(extent, options.lattice, scaled_down(options.patch_spacing, options.element_levels)) > most) {
    options.patch_spacing *= 1.09050773266525766;  // 2^(1/8)
  }

  options.min_spacing = request.min_spacing;
  if (!(request.min_spacing > 0)) {
    const std::uint32_t levels =
        request.refines ? std::max(k_refinements, options.element_levels) : options.element_levels;
    options.min_spacing = scaled_down(options.patch_spacing, levels);
  }
  return options;
}

}  // namespace radvor
