#include "radiosity/gather.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "base/prefetch.h"
#include "radiosity/hemisphere.h"

namespace radvor {

namespace {

// The corner of a hit's triangle that a ray's link stands for: drawn by the weights, with the golden ratio's multiples,
// which are spread evenly whatever their number. Corners are taken from the lowest share on, since their order in a
// triangle may turn when its facet is triangulated anew, and the ray is to draw the same.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : first_(to_unit(mix(seed + 1))) {}

  std::uint32_t share(const FacetPoint& point, std::uint32_t ray) const {
    constexpr double k_golden = 0.6180339887498949;
    const double turns = first_ + (ray + 1) * k_golden;
    const double draw = turns - std::floor(turns);
    const auto lowest = std::min_element(point.shares.begin(), point.shares.end());
    const std::size_t a = static_cast<std::size_t>(lowest - point.shares.begin()), b = (a + 1) % 3, c = (a + 2) % 3;
    return point.shares[draw < point.weights[a] ? a : draw < point.weights[a] + point.weights[b] ? b : c];
  }

 private:
  double first_;
};

}  // namespace

Gather::Gather(const Scene& scene, const Facets& facets, std::span<const std::uint32_t> occluders, Host& host)
    : scene_(scene),
      facets_(facets),
      occluders_(occluders),
      host_(host),
      records_(&host.memory),
      behind_(&host.memory) {}

std::uint32_t Gather::add(std::uint32_t count) {
  const std::uint32_t first = size();
  if (records_.capacity() < records_.size() + count) {
    records_.reserve(std::max(records_.size() + count, 2 * records_.capacity()));
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    records_.emplace_back(&host_.memory);
  }
  return first;
}

// Rays over a receiver's hemisphere, in packets that go much the same way; on_link(ray, share) for each hit that
// shoots.
template <class OnLink>
Outlook Gather::look(const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed, const Surface& surface,
                     Tracer& tracer, OnLink&& on_link) const {
  const auto shares = surface.shares();
  const Net net(seed);
  const Basis basis(receiver.normal);
  const Draw draw(seed);
  constexpr std::uint32_t k_packet = 16;
  std::array<std::uint32_t, k_packet> rays;
  std::array<Vec3, k_packet> along;
  std::array<FirstHit, k_packet> hits;
  std::array<std::uint32_t, k_packet> facets, shooting;
  std::array<PlanePoint, k_packet> points;
  std::array<FacetPoint, k_packet> found;
  std::uint32_t open = 0, backs = 0;
  double inverse_distance = 0;
  for (std::uint32_t first = 0; first < ray_count; first += k_packet) {
    const std::uint32_t count = std::min(k_packet, ray_count - first);
    for (std::uint32_t k = 0; k < count; ++k) {
      rays[k] = order_.index(ray_count, first + k);
      along[k] = direction(basis, net.point(rays[k]));
    }
    tracer.first_hits(receiver.lifted, std::span(along.data(), count), hits.data());
    for (std::uint32_t k = 0; k < count; ++k) {
      if (hits[k].triangle != FirstHit::k_miss) {
        facets[k] = facets_.facet_of_triangle[occluders_[hits[k].triangle]];
        prefetch(facets_.facets[facets[k]]);
      }
    }
    std::uint32_t met = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      const FirstHit& hit = hits[k];
      if (hit.triangle == FirstHit::k_miss) {
        ++open;
        continue;
      }
      inverse_distance += 1 / hit.distance;
      const Facet& described = facets_.facets[facets[k]];
      if (!scene_.meshes[described.mesh].receives || (!hit.front && !scene_.materials[described.material].two_sided)) {
        ++backs;
        continue;
      }
      points[met] = {facets[k], described.frame.to_plane(receiver.lifted + hit.distance * along[k])};
      shooting[met++] = k;
    }
    surface.locate(std::span(points.data(), met), found.data());
    for (std::uint32_t i = 0; i < met; ++i) {
      const std::uint32_t k = shooting[i];
      const std::uint32_t front = draw.share(found[i], rays[k]);
      on_link(rays[k], hits[k].front ? front : shares[front].other_side);
    }
  }
  const double weight = 1.0 / ray_count;
  return {open * weight, backs * weight, inverse_distance * weight, weight};
}

void Gather::trace(std::uint32_t index, const Receiver& receiver, std::uint32_t ray_count, std::uint64_t seed,
                   const Surface& surface, Tracer& tracer) {
  Record& record = records_[index];
  record.from = receiver.lifted;
  record.normal = receiver.normal;
  record.seed = seed;
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

void Gather::follow(const ShareChanges& changes) {
  assert(caught_up_ == 0);
  for (Behind& behind : behind_) {
    behind.moves.follow(changes, host_);
  }
  if (const std::uint32_t known = behind_.empty() ? 0 : behind_.back().end; known < size()) {
    behind_.push_back({size(), ShareMoves(changes, host_)});
  }
}

bool Gather::catch_up(const Surface& surface, std::uint64_t links) {
  constexpr std::size_t k_block = 8;
  for (const Behind& behind : behind_) {
    const std::uint32_t first = caught_up_;
    std::uint64_t looked_at = 0;
    for (; caught_up_ < behind.end && looked_at < links; ++caught_up_) {
      looked_at += records_[caught_up_].links.size();
    }
    links -= std::min(links, looked_at);
    if (first < caught_up_) {
      host_.jobs.for_ranges(caught_up_ - first, k_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          catch_up(records_[first + k], surface, behind.moves);
        }
      });
    }
  }
  if (!behind_.empty() && caught_up_ < behind_.back().end) {
    return false;
  }
  behind_.clear();
  caught_up_ = 0;
  return true;
}

void Gather::catch_up(Record& record, const Surface& surface, const ShareMoves& moves) const {
  const auto shares = surface.shares();
  const Net net(record.seed);
  const Basis basis(record.normal);
  const Draw draw(record.seed);
  for (std::uint32_t ray = 0; ray < record.links.size(); ++ray) {
    std::uint32_t& link = record.links[ray];
    if (link == k_none) {
      continue;
    }
    const bool divided = moves.is_divided(link);
    link = moves.now(link);
    if (!divided) {
      continue;
    }
    const Share& share = shares[link];
    const Frame& frame = facets_.facets[share.facet].frame;
    const Vec3 along = direction(basis, net.point(ray));
    const double distance = glm::dot(frame.origin - record.from, frame.normal) / glm::dot(along, frame.normal);
    if (distance > 0 && distance < std::numeric_limits<double>::infinity()) {
      const Vec2 hit = frame.to_plane(record.from + distance * along);
      if (const std::optional<FacetPoint> point = surface.find(share.facet, hit)) {
        const std::uint32_t front = draw.share(*point, ray);
        link = share.back ? shares[front].other_side : front;
      }
    }
  }
}

Color Gather::gather(std::uint32_t index, std::span<const glm::vec3> radiosity, std::uint32_t link_count) const {
  assert(link_count > 0 && link_count <= records_[index].links.size());
  std::array<double, 3> sum{};
  for (const std::uint32_t share : std::span(records_[index].links).first(link_count)) {
    if (share == k_none) {
      continue;
    }
    const glm::vec3& sent = radiosity[share];
    sum[0] += sent.r;
    sum[1] += sent.g;
    sum[2] += sent.b;
  }
  return Color(sum[0], sum[1], sum[2]) / static_cast<double>(link_count);
}

double Gather::spread(std::uint32_t index, std::span<const glm::vec3> radiosity) const {
  double sum = 0, squares = 0;
  for (const std::uint32_t share : records_[index].links) {
    if (share != k_none) {
      const glm::vec3& sent = radiosity[share];
      const double all = static_cast<double>(sent.r) + sent.g + sent.b;
      sum += all;
      squares += all * all;
    }
  }
  const double weight = records_[index].outlook.weight, mean = sum * weight;
  return mean > 0 ? std::sqrt(std::max(0.0, squares * weight - mean * mean)) / mean : 0;
}

}  // namespace radvor
