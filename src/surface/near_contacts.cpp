#include "surface/near_contacts.h"

#include <algorithm>
#include <cmath>

namespace radvor {

std::pmr::vector<std::uint32_t> sites_wider_than_gaps(const Surface& surface, const SurfaceOptions& options,
                                                      std::pmr::memory_resource* memory) {
  std::pmr::vector<std::uint32_t> wide(memory);
  const auto& contacts = surface.facets().contacts.edges;
  if (surface.max_level() == 0 || contacts.empty()) {
    return wide;
  }
  const double first = std::ldexp(options.patch_spacing, -static_cast<int>(options.element_levels));
  const std::uint32_t first_edge = contacts.front().edge;  // they are numbered one after the other
  const auto sites = surface.sites();
  for (std::uint32_t site = 0; site < sites.size(); ++site) {
    if (sites[site].edge == k_none || sites[site].edge < first_edge) {
      continue;
    }
    const double gap = contacts[sites[site].edge - first_edge].gap;
    const std::uint32_t level = surface.level_of(site);
    if (gap > 0 && level < surface.max_level() && std::ldexp(first, -static_cast<int>(level)) > gap) {
      wide.push_back(site);
    }
  }
  return wide;
}

}  // namespace radvor
