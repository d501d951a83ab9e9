// Beside what is closer to a facet than sites are to each other, the light is not resolved until they are as close.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "surface/surface.h"

namespace radvor {

/// Sites on contacts of which the spacing is wider than the gap that makes them, and that can still be raised. Raising
/// them until there are none brings the spacing about each such contact down to its gap, or to the smallest there is.
std::pmr::vector<std::uint32_t> sites_wider_than_gaps(const Surface& surface, const SurfaceOptions& options,
                                                      std::pmr::memory_resource* memory);

}  // namespace radvor
