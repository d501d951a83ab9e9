// How dense sites are where the host leaves it open: from the scene's size and the tolerance.
#pragma once

#include "scene/facets.h"
#include "scene/scene.h"
#include "surface/surface.h"

namespace radvor {

/// Whether sites are added where light demands them, unless the host turns it off.
inline constexpr bool k_refines_by_default = true;

/// What the host may say about density; 0 leaves it open.
struct SpacingRequest {
  Lattice lattice = Lattice::hexagonal;
  double tolerance = 0.02;
  double patch_spacing = 0;
  double min_spacing = 0;
  std::uint32_t element_levels = 0;
  std::uint32_t max_sites = 0;
  bool refines = false;  ///< the first elements are the patches where it is left open, and refinement does the rest
};

/// The smallest spacing that refinement comes down to.
double finest_spacing(const SurfaceOptions& options);

/// Resolved so that the scene has about 20 / tolerance patches and, at the first elements' spacing, no more sites than
/// max_sites (estimated from areas and border lengths). Where refinement is on the first elements are the patches, or,
/// where the host leaves their spacing open, up to three levels finer where corners are so many that their lattice
/// hardly counts; borders are raised by two levels, and it goes down
/// to a thirty-second of the patches' spacing if min_spacing is left open. Where it is off there is none.
SurfaceOptions choose_spacing(const Scene& scene, const WeldedScene& welded, const Facets& facets,
                              const SpacingRequest& request);

}  // namespace radvor
