#include "radiosity/receiver_blocks.h"

#include <algorithm>
#include <functional>

#include "base/sort.h"

namespace radvor {

namespace {

// Spreads the lower 16 bits to the even places.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | (bits << 8)) & 0x00ff00ffu;
  bits = (bits | (bits << 4)) & 0x0f0f0f0fu;
  bits = (bits | (bits << 2)) & 0x33333333u;
  return (bits | (bits << 1)) & 0x55555555u;
}

struct Key {
  std::uint32_t facet;
  bool back;
  std::uint32_t curve;
  std::uint32_t sample;

  bool operator<(const Key& other) const {
    return facet != other.facet   ? facet < other.facet
           : back != other.back   ? back < other.back
           : curve != other.curve ? curve < other.curve
                                  : sample < other.sample;
  }
};

bool is_back(const Sample& sample, const Facet& facet) {
  return glm::dot(sample.facet_normal, facet.frame.normal) < 0;
}

}  // namespace

ReceiverBlocks::ReceiverBlocks(const Surface& surface, std::span<const Receiver> receivers,
                               std::span<const std::uint32_t> chosen, Host& host)
    : order_(&host.memory) {
  const auto samples = surface.samples();
  const auto& facets = surface.facets().facets;
  const auto in_plane = [&](std::uint32_t sample) {
    const Frame& frame = facets[samples[sample].facet].frame;
    const Vec3 apart = receivers[sample].lifted - frame.origin;
    return Vec2(glm::dot(apart, frame.u), glm::dot(apart, frame.v));
  };
  struct Bounds {
    Vec2 low{1e300}, high{-1e300};
  };
  std::pmr::vector<Bounds> bounds(facets.size(), &host.memory);
  for (const std::uint32_t s : chosen) {
    Bounds& b = bounds[samples[s].facet];
    b.low = glm::min(b.low, in_plane(s));
    b.high = glm::max(b.high, in_plane(s));
  }
  std::pmr::vector<Key> keys(&host.memory);
  keys.reserve(chosen.size());
  for (const std::uint32_t s : chosen) {
    const Bounds& b = bounds[samples[s].facet];
    const double extent = std::max({b.high.x - b.low.x, b.high.y - b.low.y, 1e-300});
    const Vec2 unit = (in_plane(s) - b.low) * (65535.0 / extent);
    const std::uint32_t curve =
        spread(static_cast<std::uint32_t>(unit.x)) | (spread(static_cast<std::uint32_t>(unit.y)) << 1);
    keys.push_back({samples[s].facet, is_back(samples[s], facets[samples[s].facet]), curve, s});
  }
  sort_side_by_side(keys, host.jobs, std::less<>());
  order_.reserve(keys.size());
  for (const Key& key : keys) {
    order_.push_back(key.sample);
  }
}

}  // namespace radvor
