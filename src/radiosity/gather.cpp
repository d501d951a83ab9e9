#include "radiosity/gather.h"

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

void Gather::trace(std::uint32_t index, const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed,
                   Tracer& tracer) {
  Record& record = records_[index];
  record.hits.clear();
  record.hits.reserve(ray_count);
  record.weight = 1.0 / ray_count;
  record.seed = seed;
  const Net net(seed);
  const Basis basis(receiver.normal);
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
    const std::uint32_t triangle = occluders_[hit.triangle];
    const std::uint32_t facet = facets_.facet_of_triangle[triangle];
    const Facet& described = facets_.facets[facet];
    const Material& material = scene_.materials[described.material];
    if (!scene_.meshes[described.mesh].receives || (!hit.front && !material.two_sided)) {
      ++backs;
      continue;
    }
    const Vec2 point = described.frame.to_plane(receiver.lifted + hit.distance * along);
    record.hits.push_back({2 * facet + (hit.front ? 0 : 1), static_cast<float>(point.x), static_cast<float>(point.y)});
  }
  record.outlook = {open * record.weight, backs * record.weight, inverse_distance * record.weight};
}

void Gather::settle(std::uint32_t index, const Surface& surface) {
  Record& record = records_[index];
  const auto shares = surface.shares();
  record.links.reserve(record.hits.size());
  // The golden ratio's multiples are spread evenly whatever their number.
  constexpr double k_golden = 0.6180339887498949;
  double draw = to_unit(mix(record.seed + 1));
  for (const Hit& hit : record.hits) {
    draw += k_golden;
    draw -= draw >= 1 ? 1 : 0;
    const FacetPoint point = surface.locate(hit.facet_and_side / 2, Vec2(hit.u, hit.v));
    const std::size_t corner = draw < point.weights[0] ? 0 : draw < point.weights[0] + point.weights[1] ? 1 : 2;
    const std::uint32_t front = point.shares[corner];
    record.links.push_back((hit.facet_and_side & 1) != 0 ? shares[front].other_side : front);
  }
  std::pmr::vector<Hit>(record.hits.get_allocator()).swap(record.hits);
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
  return record.weight * Color(sum[0], sum[1], sum[2]);
}

}  // namespace radvor
