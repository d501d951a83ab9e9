// Light at vertices that is best once an engine has interpolated it over its own triangles, as engines do.
// After Kavan, Bargteil and Sloan, "Least Squares Vertex Baking", EGSR 2011, without their smoothing.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "output/quantity.h"

namespace radvor {

/// Minimises, over values that are not negative, the squared difference between their linear interpolation over the
/// mesh's kept triangles and the light on the adaptive mesh, integrated exactly over the surface. `values` (1 a vertex)
/// holds the start, not negative, and gets the answer, which is never worse; vertices of no triangle stay as they are.
void fit_vertices(const LitSurface& lit, std::uint32_t mesh, Quantity quantity, bool back,
                  std::pmr::vector<Color>& values);

}  // namespace radvor
