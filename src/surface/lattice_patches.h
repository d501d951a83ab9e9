// A facet's own patches: each element belongs to the level-0 site whose cell encloses it, the nearest one that it sees.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/vector.h"
#include "surface/lattice.h"
#include "surface/segments.h"

namespace radvor {

class LatticePatches {
 public:
  /// centres: the facet's sites of level 0, in any order; given: more of them off the lattice; walls: what sites do not
  /// see across, kept by reference as the lattice is.
  LatticePatches(const FacetLattice& lattice, std::span<const LatticeIndex> centres, std::span<const Vec2> given,
                 std::span<const Segment> walls, std::pmr::memory_resource* memory);

  /// Sites of level 0.
  std::uint32_t count() const { return static_cast<std::uint32_t>(centres_.size() + given_.size()); }

  /// The patch of a site, k_none where none is both near and in sight. receiver: in the site's cell, off the walls.
  std::uint32_t nearest(const Vec2& site, const Vec2& receiver) const;

 private:
  LatticeIndex nearest_point(const Vec2& site) const;

  const FacetLattice& lattice_;
  SegmentGrid walls_;
  Vec2 position(std::uint32_t patch) const {
    return patch < centres_.size() ? lattice_.point(0, centres_[patch]) : given_[patch - centres_.size()];
  }

  std::pmr::vector<LatticeIndex> centres_;  // of level 0, by row, then column
  std::pmr::vector<Vec2> given_;
};

}  // namespace radvor
