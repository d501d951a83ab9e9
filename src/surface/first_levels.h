// What the mesh resolves before there is any light: borders and contacts. Light bends most beside what adjoins a
// surface and beside what nearly touches it, and a mesh that has no site there does not see that it misses anything.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "surface/surface.h"

namespace radvor {

/// Raises sites on sharp edges by options.border_levels, and on contacts until the spacing there is the gap that makes
/// them, options.contact_spacing or the smallest there is. The surface may be one that has no shares and samples yet:
/// of it sites and their levels are read, and the scene.
void raise_first_levels(Surface& surface, const SurfaceOptions& options, std::pmr::memory_resource* memory);

/// Raises, to each level in turn, the sites on sharp edges and contacts of facets that are larger than a cell of that
/// level; not where a surface ends and no other begins. That ends at four times the sites there were, and 8192, and at
/// half of what options.max_sites leaves: the rest is for the light.
void raise_borders(Surface& surface, const SurfaceOptions& options, std::pmr::memory_resource* memory);

/// Raises sites_wider_than_gaps until there are none, all to one level before any to the next. That ends where a
/// quarter of the sites there were, and 4096, have come: light asks for the rest where it is worth it.
void resolve_gaps(Surface& surface, const SurfaceOptions& options, std::pmr::memory_resource* memory);

/// Sites on contacts of which the spacing is wider than the gap that makes them and than options.contact_spacing, and
/// that can still be raised.
std::pmr::vector<std::uint32_t> sites_wider_than_gaps(const Surface& surface, const SurfaceOptions& options,
                                                      std::pmr::memory_resource* memory);

}  // namespace radvor
