#include "surface/lattice_patches.h"

#include <algorithm>
#include <array>

#include "scene/welded.h"

namespace radvor {

namespace {

// Spacings within which a patch looks for its elements. The outermost centres are less than one and a half spacings
// from the border along each lattice direction.
constexpr double k_reach = 2.0;

bool before(const LatticeIndex& a, const LatticeIndex& b) {
  return a.j != b.j ? a.j < b.j : a.i < b.i;
}

struct Candidate {
  double distance;
  std::uint32_t patch;
};

// The candidates that matter: up to 25 lattice points lie within the reach.
class Nearest {
 public:
  void add(const Candidate& candidate) {
    if (count_ < list_.size()) {
      list_[count_++] = candidate;
    }
  }
  std::span<const Candidate> sorted() {
    std::sort(list_.begin(), list_.begin() + count_, [](const Candidate& a, const Candidate& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.patch < b.patch;
    });
    return {list_.data(), count_};
  }

 private:
  std::array<Candidate, 25> list_;
  std::uint32_t count_ = 0;
};

}  // namespace

LatticePatches::LatticePatches(const FacetLattice& lattice, std::span<const LatticeIndex> centres,
                               std::span<const Segment> walls, std::pmr::memory_resource* memory)
    : lattice_(lattice), walls_(walls, lattice.column(0), memory), centres_(centres.begin(), centres.end(), memory) {
  std::sort(centres_.begin(), centres_.end(), before);
}

std::uint32_t LatticePatches::nearest(const Vec2& site, const Vec2& receiver) const {
  const double reach = k_reach * lattice_.column(0);
  Nearest found;
  const std::int64_t last_row = lattice_.last_row(0, site.y + reach);
  for (std::int64_t j = lattice_.first_row(0, site.y - reach); j <= last_row; ++j) {
    const LatticeIndex first{lattice_.first_column(0, j, site.x - reach), j};
    const std::int64_t last = lattice_.last_column(0, j, site.x + reach);
    auto centre = std::lower_bound(centres_.begin(), centres_.end(), first, before);
    for (; centre != centres_.end() && centre->j == j && centre->i <= last; ++centre) {
      const Vec2 offset = lattice_.point(0, *centre) - site;
      const double distance = glm::dot(offset, offset);
      if (distance <= reach * reach) {
        found.add({distance, static_cast<std::uint32_t>(centre - centres_.begin())});
      }
    }
  }
  for (const Candidate& candidate : found.sorted()) {
    if (!walls_.blocks(receiver, lattice_.point(0, centres_[candidate.patch]))) {
      return candidate.patch;
    }
  }
  return k_none;
}

}  // namespace radvor
