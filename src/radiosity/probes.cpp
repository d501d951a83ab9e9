#include "radiosity/probes.h"

#include <algorithm>

namespace radvor {

std::pmr::vector<Probe> place_probes(const Surface& surface, double least_area, std::span<const std::uint8_t> fresh,
                                     double lift, Host& host) {
  std::pmr::vector<Probe> probes(&host.memory);
  const auto shares = surface.shares();
  const auto samples = surface.samples();
  const auto sites = surface.sites();
  const auto& facets = surface.facets().facets;
  for (std::uint32_t facet = 0; facet < facets.size(); ++facet) {
    const Facet& described = facets[facet];
    if (described.area < least_area) {
      continue;
    }
    for (const ShareTriangle& triangle : surface.triangles(facet)) {
      for (const bool back : {false, true}) {
        if (back && shares[triangle[0]].other_side == k_none) {
          continue;
        }
        Probe probe;
        std::array<Vec3, 3> corners;
        Vec3 normal(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
          probe.samples[k] = shares[back ? shares[triangle[k]].other_side : triangle[k]].sample;
          corners[k] = sites[samples[probe.samples[k]].site].position;
          normal += samples[probe.samples[k]].normal;
        }
        const Vec3 up = back ? -described.frame.normal : described.frame.normal;
        probe.area =
            0.5 * glm::dot(described.frame.normal, glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        const bool asked = std::any_of(probe.samples.begin(), probe.samples.end(),
                                       [&](std::uint32_t sample) { return fresh[sample] != 0; });
        if (!asked || probe.area < least_area) {
          continue;
        }
        const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        const double length = glm::length(normal);
        probe.receiver = {middle, middle + lift * up, length > 0 ? normal / length : up};
        probes.push_back(probe);
      }
    }
  }
  return probes;
}

}  // namespace radvor
