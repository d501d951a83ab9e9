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

void resolve_gaps(Surface& surface, const SurfaceOptions& options, std::uint32_t max_sites,
                  std::pmr::memory_resource* memory) {
  const std::size_t first = surface.sites().size();
  std::size_t most = first + first / 4 + 4096;
  most = max_sites > 0 ? std::min<std::size_t>(most, max_sites) : most;
  for (auto wide = sites_wider_than_gaps(surface, options, memory); !wide.empty() && surface.sites().size() < most;
       wide = sites_wider_than_gaps(surface, options, memory)) {
    const std::size_t before = surface.sites().size();
    surface.raise(wide, static_cast<std::uint32_t>(most));
    if (surface.sites().size() == before) {
      break;  // the next one would lead beyond
    }
  }
  if (surface.sites().size() > first) {
    surface.refine({});
  }
}

}  // namespace radvor
