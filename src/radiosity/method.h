// What the steps of a bake share: constants of the method, and sums.
#pragma once

#include <limits>

#include "base/vector.h"
#include "scene/welded.h"
#include "surface/surface.h"

namespace radvor {

inline constexpr double k_pi = 3.14159265358979323846;

/// Rays of one hemisphere where all samples have the same area: the first are as many as its other costs are worth; of
/// the others, over the tolerance, so many where they leave a sample's light as uncertain as the tolerance. Rounded up
/// to a power of two.
inline constexpr double k_first_rays = 32, k_rays = 1.5;
inline constexpr double k_least_rays = 16, k_most_rays = 8192;

/// Standard errors of a hemisphere of one ray that noise explains; those of a net of N rays fall by N^(-3/4).
inline constexpr double k_noise = 2, k_net_power = 0.75;

/// Light from all around is taken over so far, times the root of the tolerance, relative to the distance of what is
/// seen (Ward's a, but linear interpolation errs by its square).
inline constexpr double k_reach = 1.5;

/// Of the tolerance: what the mesh may get wrong.
inline constexpr double k_share_of_mesh = 0.5;

/// Of the tolerance: what may be missing when the bake has converged.
inline constexpr double k_share_left_unshot = 0.01;

/// Of all light: bounces that bring less are lost in rounding, since what shares send is a float.
inline constexpr double k_lost_to_rounding = 1e-7;

/// The samples that a sample lies between are not known, or are no more.
inline constexpr SampleOrigin k_unanchored = {{k_none, k_none, k_none}, {0, 0, 0}, false};

/// What a share sends, as hemispheres gather it. Light beyond what a float holds is as much as it holds: infinite, it
/// would be no number once a black surface reflects it.
inline glm::vec3 as_sent(const Color& radiosity) {
  return glm::vec3(glm::min(radiosity, Color(std::numeric_limits<float>::max())));
}

inline double sum(const Color& color) {
  return color.r + color.g + color.b;
}

}  // namespace radvor
