// Finds where surfaces cut through, stand on, lie on or come close to each other: surface.md's "touching and
// intersecting surfaces", the paper's open problem of polygons represented directly in the triangulation.
#pragma once

#include "base/host.h"
#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

struct ContactLimits {
  double spacing;  ///< of the first elements, scene units > 0: facets smaller than it get no contacts
  double least;    ///< connected contacts smaller than this are left out; 0: none

  /// An eighth of the spacing is left out: what is in the dark there is less than a hundredth of a cell.
  static ContactLimits at_spacing(double spacing) { return {spacing, spacing / 8}; }
};

/// Adds contact edges, and facets.contacts that names them, for facets of meshes that receive, from the triangles of
/// meshes that cast.
/// - A triangle that cuts through a facet leaves the segment that they have in common; one that stands on it, or lies
/// in
///   its plane, leaves those of its edges that lie there. A facet with one side takes no notice of what stays behind
///   it.
/// - Ends inside the facet become welded vertices. Where a segment ends on the facet's outline, or crosses an edge
/// within it, the welded edge is divided by a new
///   vertex, so that all facets at that edge have it.
/// - Where a segment lies on an edge that is not sharp, that edge becomes sharp.
/// Takes time in proportion to the triangles and what they have to do with each other. Logs one line.
void find_contacts(const Scene& scene, WeldedScene& welded, Facets& facets, const ContactLimits& limits, Host& host);

}  // namespace radvor
