// The light whose linear interpolation is best: between samples light bends, so that samples which are right each give
// triangles which are wrong on the average. Kavan, Bargteil and Sloan, Least squares vertex baking (2011).
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "base/vector.h"
#include "radiosity/probes.h"
#include "surface/surface.h"

namespace radvor {

/// What to add to values (one a sample) so that they lie, interpolated, nearer to what the probes found (one each):
/// least squares by two steps with a lumped mass matrix. Where light bends evenly the mean is right and 0.41 of the
/// error is left. No value leaves the range of what was found at and about it.
std::pmr::vector<Color> fit_to_probes(const Surface& surface, std::span<const Probe> probes,
                                      std::span<const Color> found, std::span<const Color> values, Host& host);

}  // namespace radvor
