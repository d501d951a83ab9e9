#include "radiosity/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "radiosity/hemisphere.h"

namespace radvor {

namespace {

// The corner of a hit's triangle that a ray's link stands for: drawn by the weights, with the golden ratio's multiples,
// which are spread evenly whatever their number.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : first_(to_unit(mix(seed + 1))) {}

  std::uint32_t share(const FacetPoint& point, std::uint32_t ray) const {
    constexpr double k_golden = 0.6180339887498949;
    const double turns = first_ + (ray + 1) * k_golden;
    const double draw = turns - std::floor(turns);
    return point.shares[draw < point.weights[0] ? 0 : draw < point.weights[0] + point.weights[1] ? 1 : 2];
  }

 private:
  double first_;
};

}  // namespace

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

// Rays over a receiver's hemisphere; on_link(ray, share) for each hit that shoots.
template <class OnLink>
Outlook Gather::look(const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed, const Surface& surface,
                     Tracer& tracer, OnLink&& on_link) const {
  const auto shares = surface.shares();
  const Net net(seed);
  const Basis basis(receiver.normal);
  const Draw draw(seed);
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
    const std::uint32_t front = draw.share(point, ray);
    on_link(ray, hit.front ? front : shares[front].other_side);
  }
  const double weight = 1.0 / ray_count;
  return {open * weight, backs * weight, inverse_distance * weight, weight};
}

void Gather::trace(std::uint32_t index, const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed,
                   const Surface& surface, Tracer& tracer) {
  Record& record = records_[index];
  record.links.assign(ray_count, k_none);
  record.outlook = look(receiver, ray_count, seed, surface, tracer,
                        [&](std::uint32_t ray, std::uint32_t share) { record.links[ray] = share; });
}

Outlook Gather::glance(const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed, const Surface& surface,
                       std::span<const glm::vec3> radiosity, Tracer& tracer, Color& gathered) const {
  Color sum(0.0);
  const Outlook outlook = look(receiver, ray_count, seed, surface, tracer,
                               [&](std::uint32_t, std::uint32_t share) { sum += Color(radiosity[share]); });
  gathered = sum * outlook.weight;
  return outlook;
}

void Gather::follow(std::uint32_t index, const Receiver& receiver, std::uint64_t seed, const Surface& surface,
                    const ShareChanges& changes) {
  const auto shares = surface.shares();
  const Net net(seed);
  const Basis basis(receiver.normal);
  const Draw draw(seed);
  std::pmr::vector<std::uint32_t>& links = records_[index].links;
  for (std::uint32_t ray = 0; ray < links.size(); ++ray) {
    if (links[ray] == k_none) {
      continue;
    }
    const std::uint32_t share = changes.now[links[ray]];
    links[ray] = share;
    if (changes.divided[share] == 0) {
      continue;
    }
    const Frame& frame = facets_.facets[shares[share].facet].frame;
    const Vec3 along = direction(basis, net.point(ray));
    // The receiver's normal may have turned a little with its cell: a ray that leads beside the facet now keeps its
    // link.
    const double distance = glm::dot(frame.origin - receiver.lifted, frame.normal) / glm::dot(along, frame.normal);
    if (distance > 0 && distance < std::numeric_limits<double>::infinity()) {
      const Vec2 hit = frame.to_plane(receiver.lifted + distance * along);
      if (const std::optional<FacetPoint> point = surface.find(shares[share].facet, hit)) {
        const std::uint32_t front = draw.share(*point, ray);
        links[ray] = shares[share].back ? shares[front].other_side : front;
      }
    }
  }
}

Color Gather::gather(std::uint32_t index, std::span<const glm::vec3> radiosity) const {
  const Record& record = records_[index];
  std::array<double, 3> sum{};
  for (const std::uint32_t share : record.links) {
    if (share == k_none) {
      continue;
    }
    const glm::vec3& sent = radiosity[share];
    sum[0] += sent.r;
    sum[1] += sent.g;
    sum[2] += sent.b;
  }
  return record.outlook.weight * Color(sum[0], sum[1], sum[2]);
}

}  // namespace radvor
