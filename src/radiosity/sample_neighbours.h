// Which samples lie next to each other: joined by an edge of some triangle, across smooth edges of facets too.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "surface/surface.h"

namespace radvor {

class SampleNeighbours {
 public:
  SampleNeighbours(const Surface& surface, Host& host);

  /// Once for each triangle that has the edge: twice, but once along borders that are not smooth.
  std::span<const std::uint32_t> of(std::uint32_t sample) const {
    return std::span(list_).subspan(first_[sample], first_[sample + 1] - first_[sample]);
  }

 private:
  std::pmr::vector<std::uint32_t> first_, list_;
};

}  // namespace radvor
