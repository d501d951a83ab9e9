// Light from all around, freed of noise: what neighbours say together is better known than what each says alone.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>

#include "base/host.h"
#include "base/vector.h"
#include "surface/surface.h"

namespace radvor {

/// What is known of one sample's value.
struct Certainty {
  double noise = 0;  ///< relative standard error; 0: the value stays as it is
  double reach = 0;  ///< how far light from all around stays about the same, scene units
};

/// Moves values towards the plane that fits each sample and its neighbours on its facet best, those within reach, the
/// nearer the more: what is linear stays. What differs from the plane by more than noise explains stays too. Samples
/// that several facets share stay. values, certain: one a sample.
void smooth(const Surface& surface, std::span<const Certainty> certain, std::span<Color> values, Host& host);

}  // namespace radvor
