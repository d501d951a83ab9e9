// Which points of a facet's lattice become sites: those inside the facet and clear of its borders.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "base/vector.h"
#include "surface/lattice.h"
#include "surface/segments.h"

namespace radvor {

/// Points of a lattice's level inside the outline (even-odd: loops in any order, holes alike) and at least `clearance`
/// from it and from the constraints within; appended row by row.
void find_interior_sites(const FacetLattice& lattice, std::uint32_t level, std::span<const Segment> outline,
                         std::span<const Segment> constraints, double clearance, std::pmr::vector<LatticeIndex>& sites,
                         std::pmr::memory_resource* memory);

}  // namespace radvor
