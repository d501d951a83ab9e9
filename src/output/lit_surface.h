// What the outputs read of a bake: its surface, and the light on it as it is now. A bake turns into one by itself, and
// tests put a light of their own on a surface.
#pragma once

#include <span>

#include "base/host.h"
#include "radiosity/bake.h"
#include "surface/surface.h"

namespace radvor {

/// A view: valid until the bake advances or dies.
struct LitSurface {
  LitSurface(const Surface& lit, std::span<const Color> direct_irradiance, std::span<const Color> indirect_irradiance,
             Host& lender)
      : surface(lit), direct(direct_irradiance), indirect(indirect_irradiance), host(lender) {}

  LitSurface(const Bake& bake)  // NOLINT(google-explicit-constructor): wherever light is read, a bake will do
      : LitSurface(bake.surface(), bake.direct(), bake.indirect(), bake.host()) {
    fit = bake.fit();
  }

  const Surface& surface;
  std::span<const Color> direct, indirect;  ///< irradiance per sample of the surface, W m^-2
  std::span<const Color> fit;               ///< added to direct where triangles interpolate; empty: nothing
  Host& host;
};

}  // namespace radvor
