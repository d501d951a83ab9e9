// Finds where surfaces cut through, stand on, lie on or come close to each other: surface.md's "touching and
// intersecting surfaces", the paper's open problem of polygons represented directly in the triangulation.
#pragma once

#include "base/host.h"
#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

struct ContactLimits {
  double size;   ///< scene units >= 0: facets smaller than it get no contacts
  double least;  ///< connected contacts smaller than this are left out; 0: none
  double reach;  ///< surfaces no farther apart than this are near each other; 0: those that touch alone

  /// finest: the smallest spacing there can be between sites, scene units. What lies in the dark of a contact that is
  /// left out is less than a quarter of the smallest cell.
  static ContactLimits at_spacing(double finest) { return {2 * finest, 0.5 * finest, 4 * finest}; }
};

/// Adds contact edges, and facets.contacts that names them, for facets of meshes that receive, from the triangles of
/// meshes that cast.
/// - A triangle that cuts through a facet leaves the segment that they have in common; one that stands on it, or lies
/// in
///   its plane, leaves those of its edges that lie there. A facet with one side takes no notice of what stays behind
///   it.
/// - A triangle that is near above a facet, and about parallel to it, leaves those of its edges where the surface ends
/// as
///   seen along the facet's normal, with the gap: until sites are that close to each other the light there is not
///   resolved.
/// - Ends inside the facet become welded vertices. Where a segment ends on the facet's outline, or crosses an edge
/// within it, the welded edge is divided by a new
///   vertex, so that all facets at that edge have it.
/// - Where a segment lies on an edge that is not sharp, that edge becomes sharp.
/// Takes time in proportion to the triangles and what they have to do with each other. Logs one line.
void find_contacts(const Scene& scene, WeldedScene& welded, Facets& facets, const ContactLimits& limits, Host& host);

}  // namespace radvor
