#include "radiosity/receiver_blocks.h"

#include <algorithm>

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

ReceiverBlocks::ReceiverBlocks(const Surface& surface, std::span<const Receiver> receivers, Host& host)
    : order_(&host.memory), planes_(&host.memory) {
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
  for (std::uint32_t s = 0; s < samples.size(); ++s) {
    Bounds& b = bounds[samples[s].facet];
    b.low = glm::min(b.low, in_plane(s));
    b.high = glm::max(b.high, in_plane(s));
  }
  std::pmr::vector<Key> keys(&host.memory);
  keys.reserve(samples.size());
  for (std::uint32_t s = 0; s < samples.size(); ++s) {
    const Bounds& b = bounds[samples[s].facet];
    const double extent = std::max({b.high.x - b.low.x, b.high.y - b.low.y, 1e-300});
    const Vec2 unit = (in_plane(s) - b.low) * (65535.0 / extent);
    const std::uint32_t curve =
        spread(static_cast<std::uint32_t>(unit.x)) | (spread(static_cast<std::uint32_t>(unit.y)) << 1);
    keys.push_back({samples[s].facet, is_back(samples[s], facets[samples[s].facet]), curve, s});
  }
  std::sort(keys.begin(), keys.end());
  for (const Key& key : keys) {
    order_.push_back(key.sample);
  }

  planes_.resize(count());
  for (std::uint32_t index = 0; index < count(); ++index) {
    const auto own = block(index);
    const Sample& first = samples[own[0]];
    const Facet& facet = facets[first.facet];
    const bool one_plane = std::all_of(own.begin(), own.end(), [&](std::uint32_t s) {
      // The shading normal too: a horizon other than the plane's would let light in from behind it.
      return samples[s].facet == first.facet && samples[s].facet_normal == first.facet_normal &&
             samples[s].normal == samples[s].facet_normal;
    });
    if (!one_plane) {
      continue;
    }
    Bounds b;
    for (const std::uint32_t s : own) {
      b.low = glm::min(b.low, in_plane(s));
      b.high = glm::max(b.high, in_plane(s));
    }
    const Vec3 base = facet.frame.origin +
                      first.facet_normal * glm::dot(receivers[own[0]].lifted - facet.frame.origin, first.facet_normal);
    const auto at = [&](double x, double y) { return base + x * facet.frame.u + y * facet.frame.v; };
    Plane plane{{at(b.low.x, b.low.y), at(b.high.x, b.low.y), at(b.high.x, b.high.y), at(b.low.x, b.high.y)},
                first.facet_normal};
    if (is_back(first, facet)) {
      std::reverse(plane.rectangle.begin(), plane.rectangle.end());
    }
    planes_[index] = plane;
  }
}

std::span<const std::uint32_t> ReceiverBlocks::block(std::uint32_t index) const {
  const std::size_t begin = std::size_t{index} * k_size;
  return std::span(order_).subspan(begin, std::min<std::size_t>(k_size, order_.size() - begin));
}

void ReceiverBlocks::find_clear_roots(std::uint32_t block, const ShootingTree& tree,
                                      std::span<const std::uint32_t> roots, const OccluderTree& occluders, double lift,
                                      std::pmr::vector<std::uint8_t>& clear) const {
  clear.clear();
  if (!planes_[block]) {
    return;
  }
  const Plane& plane = *planes_[block];
  clear.assign(roots.size(), 0);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (roots[i] == k_none || !tree.nodes()[roots[i]].flat) {
      continue;
    }
    const TreeNode& node = tree.nodes()[roots[i]];
    const auto rectangle = bounding_rectangle(node);
    const bool behind = std::all_of(rectangle.begin(), rectangle.end(), [&](const Vec3& corner) {
      return glm::dot(plane.normal, corner - plane.rectangle[0]) <= 0;
    });
    // Where no receiver sees the root, there is nothing to ask.
    clear[i] = behind || occluders.clear(plane.rectangle, plane.normal, rectangle, node.piece.normal, lift);
  }
}

}  // namespace radvor
