// Irregular sites: where shadows' edges are.
#include <algorithm>

#include "surface/refinement.h"

namespace radvor {

void Refinement::insert(std::span<const WantedSite> wanted, std::uint32_t max_sites) {
  clearance_.resize(parts_.sites.size(), -1.0);
  const std::size_t most = max_sites > 0 ? max_sites : k_none;
  const std::size_t first = irregular_.size();
  for (const WantedSite& wish : wanted) {
    if (parts_.sites.size() >= most) {
      break;
    }
    if (!is_lattice_facet(wish.facet)) {
      continue;
    }
    const Vec2 point = ground(wish.facet).frame().to_plane(wish.position);
    if (!is_free(wish.facet, point)) {
      continue;
    }
    const std::size_t before = begin_step();
    const std::uint8_t level = level_at(wish.facet, point);
    const std::uint32_t site =
        append(ground(wish.facet).frame().to_world(point), level, {wish.facet, false, {0, 0}}, 0);
    irregular_.push_back({point, site});
    grounds_[ground_of_[wish.facet]]->add(irregular_.back());
    follow_marks(site, wish.facet, point);
    if (level > 1) {
      mark(wish.facet, static_cast<std::uint8_t>(level - 1), point);
    }
    if (!balance(most)) {
      roll_back(before);
      break;
    }
  }
  if (irregular_.size() > first) {
    // Lattice sites near them may be nearer to an obstacle than was known.
    for (std::uint32_t site = 0; site < parts_.sites.size(); ++site) {
      clearance_[site] = parts_.places[site].on_lattice ? -1.0 : clearance_[site];
    }
  }
}

// Far enough from borders and other sites.
bool Refinement::is_free(std::uint32_t facet, const Vec2& point) {
  const FacetGround& on = ground(facet);
  const double apart = 0.25 * spacing(finest_);
  if (!on.encloses(point) || on.clearance(point, 2 * apart) < apart) {
    return false;
  }
  const LatticeIndex index = on.lattice().nearest(lattice_finest_, point);
  return glm::distance(on.lattice().point(lattice_finest_, index), point) >= apart ||
         find_lattice_site(facet, index) == k_none;
}

// The highest among the corners of the triangle that the point was in before.
std::uint8_t Refinement::level_at(std::uint32_t facet, const Vec2& point) const {
  const FacetPoint found = parts_.located(facet).locate(point);
  std::uint8_t level = 0;
  for (const std::uint32_t share : found.shares) {
    level = std::max(level, parts_.levels[parts_.samples[parts_.shares[share].sample].site]);
  }
  return level;
}

}  // namespace radvor
