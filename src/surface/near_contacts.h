// Beside what is closer to a facet than sites are to each other, the light is not resolved until they are as close.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "surface/surface.h"

namespace radvor {

/// Sites on contacts of which the spacing is wider than the gap that makes them, and that can still be raised.
std::pmr::vector<std::uint32_t> sites_wider_than_gaps(const Surface& surface, const SurfaceOptions& options,
                                                      std::pmr::memory_resource* memory);

/// Raises them until there are none: the spacing about each contact is its gap then, or the smallest there is. All are
/// raised to one level before any to the next; that ends at max_sites (0: no limit), and where a quarter of the sites
/// there were, and 4096, have come: light asks for the rest where it is worth it.
void resolve_gaps(Surface& surface, const SurfaceOptions& options, std::uint32_t max_sites,
                  std::pmr::memory_resource* memory);

}  // namespace radvor
