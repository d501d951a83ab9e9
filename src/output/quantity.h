// What can be asked of a bake's light, and its value at a share.
#pragma once

#include <cstdint>

#include "radiosity/bake.h"

namespace radvor {

enum class Quantity : std::uint32_t { irradiance = 0, direct = 1, indirect = 2, radiance = 3 };

/// The quantity at a share: irradiance of its sample (W m^-2), or what leaves there (W sr^-1 m^-2):
/// emission + albedo * irradiance / pi.
Color value_at(const Bake& bake, Quantity quantity, std::uint32_t share);

}  // namespace radvor
