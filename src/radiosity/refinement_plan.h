// Where the mesh is too coarse for the light on it: which sites to raise so that what linear interpolation gets wrong
// stays within the tolerance.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "base/steps.h"
#include "base/vector.h"
#include "surface/surface.h"

namespace radvor {

/// Light on the samples of a surface.
struct SampledLight {
  std::span<const Color> irradiance;
  std::span<const std::uint64_t> sights;  ///< equal where two samples see all the same sources, and all of each
};

struct RefinementGoal {
  double tolerance;        ///< of the area-weighted RMS, relative to mean_irradiance
  double mean_irradiance;  ///< mean of the three channels, > 0
};

/// An edge of the triangulation is as wrong as its ends' gradients fail to foresee its difference: a step between them
/// is off by 0.2 of its height, a parabola by 1.6 times what it is. Where the ends do not see the same sources it is
/// off by 0.3 of the difference: a step's root mean square. Of the estimated squared error over the area the worst is
/// refined until the rest is within the goal. For each edge that is to be halved one end is raised; worst first. Edges
/// whose ends are at the highest level stay as they are.
/// raised: the sites, empty before.
Steps plan_refinement(const Surface& surface, SampledLight light, RefinementGoal goal, Host& host,
                      std::pmr::vector<std::uint32_t>& raised, Pace& pace);

}  // namespace radvor
