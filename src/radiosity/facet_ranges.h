// How facets are shared out to tasks that do little to each triangle.
#pragma once

#include "base/even_ranges.h"
#include "base/host.h"
#include "surface/surface.h"

namespace radvor {

inline EvenRanges ranges_by_triangles(const Surface& surface, Host& host) {
  constexpr double k_task = 2048;
  const auto weight = [&](std::uint32_t facet) { return 1.0 + static_cast<double>(surface.triangles(facet).size()); };
  return {surface.facets().facets.size(), k_task, weight, &host.memory};
}

}  // namespace radvor
