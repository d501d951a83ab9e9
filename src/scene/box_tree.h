// A bounding volume hierarchy over axis-aligned boxes, split at the median of the longest axis: balanced, so that its
// depth, and the stack of a walk, is bounded whatever the input; built from the boxes alone, the same for the same
// boxes. Used for T-junctions, overlap of facets and nearest points.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

#include "base/vector.h"

namespace radvor {

struct Box {
  Vec3 low{std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity()};

  void add(const Vec3& point);
  void add(const Box& box);
  bool overlaps(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
           low.z <= other.high.z && other.low.z <= high.z;
  }
  /// Of the nearest point of the box, squared; 0 inside.
  double squared_distance(const Vec3& point) const;
};

class BoxTree {
 public:
  /// Boxes are known by their index from here on.
  BoxTree(std::span<const Box> boxes, std::pmr::memory_resource* memory);

  /// Calls visit(index) for the items of every leaf that enter(box) lets in, in an order that depends on the boxes
  /// alone.
  template <class Enter, class Visit>
  void walk(Enter&& enter, Visit&& visit) const {
    std::array<std::uint32_t, k_stack> stack;
    std::uint32_t size = 0;
    if (!nodes_.empty()) {
      stack[size++] = 0;
    }
    while (size > 0) {
      const Node& node = nodes_[stack[--size]];
      if (!enter(node.box)) {
        continue;
      }
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          visit(items_[i]);
        }
      } else {
        stack[size++] = node.first + 1;
        stack[size++] = node.first;
      }
    }
  }

  /// The same, nearer child first: visits the items of leaves whose box is no farther from `point` than bound(),
  /// a squared distance that may shrink as visit finds something.
  template <class Bound, class Visit>
  void walk_nearest(const Vec3& point, Bound&& bound, Visit&& visit) const {
    std::array<std::pair<double, std::uint32_t>, k_stack> stack;
    std::uint32_t size = 0;
    if (!nodes_.empty()) {
      stack[size++] = {nodes_[0].box.squared_distance(point), 0u};
    }
    while (size > 0) {
      const auto [distance, index] = stack[--size];
      if (distance > bound()) {
        continue;
      }
      const Node& node = nodes_[index];
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          visit(items_[i]);
        }
      } else {
        std::pair<double, std::uint32_t> near{nodes_[node.first].box.squared_distance(point), node.first};
        std::pair<double, std::uint32_t> far{nodes_[node.first + 1].box.squared_distance(point), node.first + 1};
        if (far.first < near.first) {
          std::swap(near, far);
        }
        stack[size++] = far;
        stack[size++] = near;
      }
    }
  }

 private:
  static constexpr std::uint32_t k_leaf = 4;
  static constexpr std::uint32_t k_stack = 40;  // one open sibling a level; halving 2^32 items takes 32 levels

  struct Node {
    Box box;
    std::uint32_t first;  ///< leaf: into items_; else the first of two children
    std::uint32_t count;  ///< 0: not a leaf
  };

  std::pmr::vector<Node> nodes_;
  std::pmr::vector<std::uint32_t> items_;
};

}  // namespace radvor
