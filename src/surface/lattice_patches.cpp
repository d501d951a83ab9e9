#include "surface/lattice_patches.h"

#include <algorithm>
#include <array>
#include <limits>

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

// The nearest candidates: up to 25 lattice points lie within the reach, and given ones come on top.
class Nearest {
 public:
  void add(const Candidate& candidate) {
    if (count_ == list_.size()) {
      if (before(list_.back(), candidate)) {
        return;
      }
      --count_;
    }
    std::uint32_t at = count_++;
    for (; at > 0 && before(candidate, list_[at - 1]); --at) {
      list_[at] = list_[at - 1];
    }
    list_[at] = candidate;
  }
  std::span<const Candidate> sorted() const { return {list_.data(), count_}; }

 private:
  static bool before(const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.patch < b.patch;
  }

  std::array<Candidate, 25> list_;
  std::uint32_t count_ = 0;
};

}  // namespace

LatticePatches::LatticePatches(const FacetLattice& lattice, std::span<const LatticeIndex> centres,
                               std::span<const Vec2> given, std::span<const Segment> walls,
                               std::pmr::memory_resource* memory)
    : lattice_(lattice),
      walls_(walls, lattice.column(0), memory),
      centres_(centres.begin(), centres.end(), memory),
      given_(given.begin(), given.end(), memory) {
  std::sort(centres_.begin(), centres_.end(), before);
}

// The lattice's point nearest to a site is in one of the rows beside it, in the column before or after; of equally near
// ones it is the first by row and column, as patches are numbered.
LatticeIndex LatticePatches::nearest_point(const Vec2& site) const {
  LatticeIndex best{};
  double least = std::numeric_limits<double>::infinity();
  const std::int64_t row = lattice_.last_row(0, site.y);
  for (std::int64_t j = row; j <= row + 1; ++j) {
    const std::int64_t column = lattice_.last_column(0, j, site.x);
    for (std::int64_t i = column; i <= column + 1; ++i) {
      const Vec2 offset = lattice_.point(0, {i, j}) - site;
      if (glm::dot(offset, offset) < least) {
        least = glm::dot(offset, offset);
        best = {i, j};
      }
    }
  }
  return best;
}

std::uint32_t LatticePatches::nearest(const Vec2& site, const Vec2& receiver) const {
  if (given_.empty()) {
    const LatticeIndex index = nearest_point(site);
    const auto centre = std::lower_bound(centres_.begin(), centres_.end(), index, before);
    if (centre != centres_.end() && !before(index, *centre) && !walls_.blocks(receiver, lattice_.point(0, index))) {
      return static_cast<std::uint32_t>(centre - centres_.begin());
    }
  }
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
  for (std::size_t k = 0; k < given_.size(); ++k) {
    const Vec2 offset = given_[k] - site;
    const double distance = glm::dot(offset, offset);
    if (distance <= reach * reach) {
      found.add({distance, static_cast<std::uint32_t>(centres_.size() + k)});
    }
  }
  for (const Candidate& candidate : found.sorted()) {
    if (!walls_.blocks(receiver, position(candidate.patch))) {
      return candidate.patch;
    }
  }
  return k_none;
}

}  // namespace radvor
