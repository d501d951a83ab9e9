// Looks between the samples: a triangle that is worth it is asked in its middle whether interpolation tells the truth.
// What lies wholly between samples (a picture whose frame covers all its corners, a small shadow) shows only there.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "radiosity/receiver.h"
#include "surface/surface.h"

namespace radvor {

struct Probe {
  Receiver receiver;
  std::array<std::uint32_t, 3> samples;  ///< of the triangle's corners, on its side
  double area;                           ///< of the triangle
};

/// One in the middle of each triangle, and side, of at least least_area with a corner among `fresh` (one flag a
/// sample). lift: of the receivers.
std::pmr::vector<Probe> place_probes(const Surface& surface, double least_area, std::span<const std::uint8_t> fresh,
                                     double lift, Host& host);

}  // namespace radvor
