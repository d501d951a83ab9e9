// Light from all around, freed of noise: what neighbours say together is better known than what each says alone.
#pragma once

#include <limits>
#include <span>

#include "base/host.h"
#include "base/steps.h"
#include "base/vector.h"
#include "radiosity/sample_neighbours.h"
#include "surface/surface.h"

namespace radvor {

/// What is known of one sample's value.
struct Certainty {
  double noise = 0;     ///< standard error over the value, as far as the sample itself can tell
  double nearness = 0;  ///< mean of one over the distance of what is seen: light from there changes over that distance
  /// How far light may be from linear about it at most, all channels as one: a mesh that followed the light knows.
  double most_bend = std::numeric_limits<double>::infinity();
  bool settled = false;  ///< the value stays as it is; its neighbours may still follow it
};

/// Moves values towards the plane that fits each sample and its neighbours best: what is linear stays. A neighbour
/// counts the more, the less noisy it is and the less light may bend on the way to it. What differs from the plane in
/// any channel by more than noise explains stays too. How noisy a value is, its neighbours are asked as well: rays that
/// missed what is bright do not know what they missed. values, certain: one a sample.
Steps smooth(const Surface& surface, const SampleNeighbours& neighbours, std::span<const Certainty> certain,
             std::span<Color> values, Host& host, Pace& pace);

}  // namespace radvor
