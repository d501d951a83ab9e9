// Which samples lie next to each other: joined by an edge of some triangle, across smooth edges of facets too.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "surface/surface.h"

namespace radvor {

struct Neighbour {
  std::uint32_t sample;
  std::uint32_t triangles;  ///< that have the edge: two, or one along borders that are not smooth; more where many meet
};

class SampleNeighbours {
 public:
  SampleNeighbours(const Surface& surface, Host& host);

  /// In ascending order, each once.
  std::span<const Neighbour> of(std::uint32_t sample) const {
    return std::span(list_).subspan(first_[sample], first_[sample + 1] - first_[sample]);
  }
  /// Of a sample's first neighbour among all samples' neighbours.
  std::uint32_t first(std::uint32_t sample) const { return first_[sample]; }
  std::size_t size() const { return list_.size(); }

 private:
  std::pmr::vector<std::uint32_t> first_;
  std::pmr::vector<Neighbour> list_;
};

}  // namespace radvor
