// Many points' triangles at once. To find one is a chain of reads, each of a place that the one before told of, and
// most of the time is waiting for them; so all points take each step together, and memory is asked for the next one
// ahead.
#pragma once

#include <span>

#include "surface/surface_parts.h"

namespace radvor {

void locate_together(const SurfaceParts& parts, std::span<const PlanePoint> points, FacetPoint* found);

}  // namespace radvor
