// What can be asked of a bake's light, and its value at a share or between shares.
#pragma once

#include <cstdint>

#include "output/lit_surface.h"

namespace radvor {

enum class Quantity : std::uint32_t { irradiance = 0, direct = 1, indirect = 2, radiance = 3 };

/// The quantity at a share: irradiance of its sample (W m^-2), or what leaves there (W sr^-1 m^-2):
/// emission + albedo * irradiance / pi.
Color value_at(const LitSurface& lit, Quantity quantity, std::uint32_t share);

/// What it is at the share's corner of a triangle that interpolates linearly: the two differ by LitSurface::fit.
Color corner_value(const LitSurface& lit, Quantity quantity, std::uint32_t share);

/// Between the three shares round a point of a facet, by corner values. back: on the other side of a two-sided facet;
/// the shares have one.
Color value_at(const LitSurface& lit, Quantity quantity, const FacetPoint& point, bool back);

/// Whether the facet's material lights up on both sides.
bool two_sided(const Surface& surface, std::uint32_t facet);

}  // namespace radvor
