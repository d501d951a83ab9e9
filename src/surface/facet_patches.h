// A facet's own patches: what is large enough has a lattice of them.
#pragma once

#include <cstdint>
#include <span>

#include "surface/surface_parts.h"

namespace radvor {

/// Fills the patch of each of the facet's shares, those of the front alone: numbered from 0, k_none where it belongs to
/// none of the facet's own. Returns how many there are.
std::uint32_t find_own_patches(const SurfaceParts& parts, std::uint32_t facet, std::span<std::uint32_t> patch_of);

}  // namespace radvor
