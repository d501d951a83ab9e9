#include "scene/box_tree.h"

#include <algorithm>
#include <numeric>

namespace radvor {

void Box::add(const Vec3& point) {
  low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
  high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
}

void Box::add(const Box& box) {
  add(box.low);
  add(box.high);
}

double Box::squared_distance(const Vec3& point) const {
  const Vec3 beyond{std::max({low.x - point.x, point.x - high.x, 0.0}),
                    std::max({low.y - point.y, point.y - high.y, 0.0}),
                    std::max({low.z - point.z, point.z - high.z, 0.0})};
  return dot(beyond, beyond);
}

BoxTree::BoxTree(std::span<const Box> boxes, std::pmr::memory_resource* memory)
    : nodes_(memory), items_(boxes.size(), memory) {
  if (boxes.empty()) {
    return;
  }
  // What is split lies side by side: a number to order by, and whose it is.
  struct Key {
    double at;
    std::uint32_t item;
    bool operator<(const Key& other) const { return at != other.at ? at < other.at : item < other.item; }
  };
  std::pmr::vector<Key> keys(boxes.size(), memory);
  std::pmr::vector<Vec3> centres(boxes.size(), memory);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    centres[i] = boxes[i].low + boxes[i].high;  // twice the centre orders as well
  }
  std::iota(items_.begin(), items_.end(), 0u);
  nodes_.reserve(2 * (boxes.size() / (k_leaf / 2 + 1)) + 2);
  nodes_.push_back({Box{}, 0, static_cast<std::uint32_t>(boxes.size())});

  // Breadth first: a node's range is split when its turn comes, its children are appended.
  for (std::size_t at = 0; at < nodes_.size(); ++at) {
    const std::uint32_t first = nodes_[at].first;
    const std::uint32_t count = nodes_[at].count;
    if (count <= k_leaf) {
      for (std::uint32_t i = first; i < first + count; ++i) {
        nodes_[at].box.add(boxes[items_[i]]);
      }
      continue;
    }
    Box spread;
    for (std::uint32_t i = first; i < first + count; ++i) {
      spread.add(centres[items_[i]]);
    }
    const Vec3 size = spread.high - spread.low;
    const glm::length_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    for (std::uint32_t i = 0; i < count; ++i) {
      keys[i] = {centres[items_[first + i]][axis], items_[first + i]};
    }
    std::nth_element(keys.begin(), keys.begin() + half, keys.begin() + count);
    for (std::uint32_t i = 0; i < count; ++i) {
      items_[first + i] = keys[i].item;
    }
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_[at].first = children;
    nodes_[at].count = 0;
    nodes_.push_back({Box{}, first, half});
    nodes_.push_back({Box{}, first + half, count - half});
  }
  for (std::size_t at = nodes_.size(); at-- > 0;) {  // children come after their node
    if (nodes_[at].count == 0) {
      nodes_[at].box.add(nodes_[nodes_[at].first].box);
      nodes_[at].box.add(nodes_[nodes_[at].first + 1].box);
    }
  }
}

}  // namespace radvor
