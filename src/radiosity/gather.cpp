#include "radiosity/gather.h"

#include <algorithm>
#include <array>

#include "radiosity/hemisphere.h"

namespace radvor {

Gather::Gather(const Scene& scene, const Facets& facets, std::span<const std::uint32_t> occluders, Host& host)
    : scene_(scene), facets_(facets), occluders_(occluders), host_(host), records_(&host.memory) {}

std::uint32_t Gather::add(std::uint32_t count) {
  const std::uint32_t first = size();
  records_.reserve(records_.size() + count);
  for (std::uint32_t i = 0; i < count; ++i) {
    records_.emplace_back(&host_.memory);
  }
  return first;
}

// Rays over a receiver's hemisphere; on_link(share) for each hit that shoots.
template <class OnLink>
Outlook Gather::look(const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed, const Surface& surface,
                     Tracer& tracer, OnLink&& on_link) const {
  const auto shares = surface.shares();
  const Net net(seed);
  const Basis basis(receiver.normal);
  // The golden ratio's multiples are spread evenly whatever their number.
  constexpr double k_golden = 0.6180339887498949;
  double draw = to_unit(mix(seed + 1));
  std::uint32_t open = 0, backs = 0;
  double inverse_distance = 0;
  for (std::uint32_t ray = 0; ray < ray_count; ++ray) {
    const Vec3 along = direction(basis, net.point(ray));
    const FirstHit hit = tracer.first_hit(receiver.lifted, along);
    if (hit.triangle == FirstHit::k_miss) {
      ++open;
      continue;
    }
    inverse_distance += 1 / hit.distance;
    const std::uint32_t facet = facets_.facet_of_triangle[occluders_[hit.triangle]];
    const Facet& described = facets_.facets[facet];
    if (!scene_.meshes[described.mesh].receives || (!hit.front && !scene_.materials[described.material].two_sided)) {
      ++backs;
      continue;
    }
    const FacetPoint point = surface.locate(facet, described.frame.to_plane(receiver.lifted + hit.distance * along));
    draw += k_golden;
    draw -= draw >= 1 ? 1 : 0;
    const std::size_t corner = draw < point.weights[0] ? 0 : draw < point.weights[0] + point.weights[1] ? 1 : 2;
    const std::uint32_t front = point.shares[corner];
    on_link(hit.front ? front : shares[front].other_side);
  }
  const double weight = 1.0 / ray_count;
  return {open * weight, backs * weight, inverse_distance * weight, weight};
}

void Gather::trace(std::uint32_t index, const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed,
                   const Surface& surface, Tracer& tracer) {
  Record& record = records_[index];
  record.links.clear();
  record.links.reserve(ray_count);
  record.outlook =
      look(receiver, ray_count, seed, surface, tracer, [&](std::uint32_t share) { record.links.push_back(share); });
}

Outlook Gather::glance(const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed, const Surface& surface,
                       std::span<const glm::vec3> radiosity, Tracer& tracer, Color& gathered) const {
  Color sum(0.0);
  const Outlook outlook =
      look(receiver, ray_count, seed, surface, tracer, [&](std::uint32_t share) { sum += Color(radiosity[share]); });
  gathered = sum * outlook.weight;
  return outlook;
}

void Gather::renumber(std::span<const std::uint32_t> now) {
  constexpr std::uint32_t k_block = 256;
  host_.jobs.for_each((size() + k_block - 1) / k_block, [&](std::uint32_t block) {
    const std::uint32_t end = std::min(size(), (block + 1) * k_block);
    for (std::uint32_t index = block * k_block; index < end; ++index) {
      for (std::uint32_t& share : records_[index].links) {
        share = now[share];
      }
    }
  });
}

Color Gather::gather(std::uint32_t index, std::span<const glm::vec3> radiosity) const {
  const Record& record = records_[index];
  std::array<double, 3> sum{};
  for (const std::uint32_t share : record.links) {
    const glm::vec3& sent = radiosity[share];
    sum[0] += sent.r;
    sum[1] += sent.g;
    sum[2] += sent.b;
  }
  return record.outlook.weight * Color(sum[0], sum[1], sum[2]);
}

}  // namespace radvor
