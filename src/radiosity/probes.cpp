#include "radiosity/probes.h"

#include <algorithm>

#include "radiosity/facet_ranges.h"

namespace radvor {

namespace {

// The probes of facets, one after the other.
class ProbePlacer {
 public:
  ProbePlacer(const Surface& surface, double least_area, std::span<const std::uint8_t> fresh, double lift,
              std::pmr::vector<Probe>& probes)
      : surface_(surface), least_area_(least_area), fresh_(fresh), lift_(lift), probes_(probes) {}

  void place_on(std::uint32_t facet) {
    const Facet& described = surface_.facets().facets[facet];
    if (described.area < least_area_) {
      return;
    }
    for (const ShareTriangle& triangle : surface_.triangles(facet)) {
      place_on(triangle, described.frame.normal, false);
      if (surface_.shares()[triangle[0]].other_side != k_none) {
        place_on(triangle, described.frame.normal, true);
      }
    }
  }

 private:
  void place_on(const ShareTriangle& triangle, const Vec3& facet_normal, bool back) {
    const auto shares = surface_.shares();
    Probe probe;
    std::array<Vec3, 3> corners;
    Vec3 normal(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      probe.samples[k] = shares[back ? shares[triangle[k]].other_side : triangle[k]].sample;
      const Sample& sample = surface_.samples()[probe.samples[k]];
      corners[k] = surface_.sites()[sample.site].position;
      normal += sample.normal;
    }
    probe.area = 0.5 * glm::dot(facet_normal, glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const bool asked = std::any_of(probe.samples.begin(), probe.samples.end(),
                                   [&](std::uint32_t sample) { return fresh_[sample] != 0; });
    if (!asked || probe.area < least_area_) {
      return;
    }
    const Vec3 up = back ? -facet_normal : facet_normal;
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const double length = glm::length(normal);
    probe.receiver = {middle, middle + lift_ * up, length > 0 ? normal / length : up};
    probes_.push_back(probe);
  }

  const Surface& surface_;
  double least_area_;
  std::span<const std::uint8_t> fresh_;
  double lift_;
  std::pmr::vector<Probe>& probes_;
};

}  // namespace

std::pmr::vector<Probe> place_probes(const Surface& surface, double least_area, std::span<const std::uint8_t> fresh,
                                     double lift, Host& host) {
  const EvenRanges ranges = ranges_by_triangles(surface, host);
  std::pmr::vector<std::pmr::vector<Probe>> found(ranges.size(), &host.memory);
  ranges.for_each(host.jobs, [&](std::uint32_t range, std::uint32_t begin, std::uint32_t end) {
    ProbePlacer placer(surface, least_area, fresh, lift, found[range]);
    for (std::uint32_t facet = begin; facet < end; ++facet) {
      placer.place_on(facet);
    }
  });
  std::size_t count = 0;
  for (const auto& of_task : found) {
    count += of_task.size();
  }
  std::pmr::vector<Probe> probes(&host.memory);
  probes.reserve(count);
  for (const auto& of_task : found) {
    probes.insert(probes.end(), of_task.begin(), of_task.end());
  }
  return probes;
}

}  // namespace radvor
