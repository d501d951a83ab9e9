#include "radiosity/occluder_tree.h"

#include <algorithm>

namespace radvor {

namespace {

// The pyramid from the eye to the polygon. Planes run through the eye, normals point inwards.
class Shaft {
 public:
  Shaft(const Vec3& eye, std::span<const Vec3> polygon, const Vec3& normal, double lift)
      : eye_(eye), polygon_(polygon), sides_(polygon.size()), lift_(lift) {
    bounds_.add(eye);
    Vec3 last = polygon.back() - eye;
    for (std::size_t i = 0; i < sides_; ++i) {
      const Vec3 corner = polygon[i] - eye;
      bounds_.add(polygon[i]);
      side_[i] = glm::cross(corner, last);
      last = corner;
    }
    base_ = normal;
    base_offset_ = glm::dot(normal, polygon[0] - eye) + lift;
  }

  bool may_enter(const Box& box) const {
    if (!box.overlaps(bounds_)) {
      return false;
    }
    const Vec3 low = box.low - eye_, high = box.high - eye_;
    const auto highest = [&](const Vec3& n) {
      return n.x * (n.x > 0 ? high.x : low.x) + n.y * (n.y > 0 ? high.y : low.y) + n.z * (n.z > 0 ? high.z : low.z);
    };
    for (std::size_t i = 0; i < sides_; ++i) {
      if (highest(side_[i]) <= 0) {
        return false;
      }
    }
    return highest(base_) > base_offset_;
  }

  bool may_be_hidden_by(const std::array<Vec3, 3>& triangle) const {
    const Vec3 a = triangle[0] - eye_, b = triangle[1] - eye_, c = triangle[2] - eye_;
    const auto highest = [&](const Vec3& n) { return std::max({glm::dot(n, a), glm::dot(n, b), glm::dot(n, c)}); };
    if (highest(base_) <= base_offset_) {
      return false;
    }
    for (std::size_t i = 0; i < sides_; ++i) {
      if (highest(side_[i]) <= 0) {
        return false;
      }
    }
    // Something of the polygon must lie beyond the triangle's plane.
    const Vec3 plane = glm::cross(b - a, c - a);
    const double offset = glm::dot(plane, a);
    const double sign = offset < 0 ? -1 : 1;
    const double least = lift_ * glm::length(plane);
    return std::any_of(polygon_.begin(), polygon_.end(),
                       [&](const Vec3& corner) { return sign * (glm::dot(plane, corner - eye_) - offset) > least; });
  }

 private:
  Vec3 eye_;
  std::span<const Vec3> polygon_;
  std::size_t sides_;
  double lift_;
  Box bounds_;
  Vec3 base_;
  double base_offset_;
  std::array<Vec3, OccluderTree::k_max_corners> side_;
};

std::pmr::vector<Box> boxes_of(const Occluders& occluders, std::pmr::memory_resource* memory) {
  std::pmr::vector<Box> boxes(occluders.corners.size() / 3, memory);
  for (std::size_t i = 0; i < 3 * boxes.size(); ++i) {
    boxes[i / 3].add(occluders.positions[occluders.corners[i]]);
  }
  return boxes;
}

}  // namespace

OccluderTree::OccluderTree(const Occluders& occluders, std::pmr::memory_resource* memory)
    : positions_(occluders.positions),
      corners_(occluders.corners.begin(), occluders.corners.end(), memory),
      boxes_(boxes_of(occluders, memory), memory) {}

std::optional<std::size_t> OccluderTree::between(const Vec3& eye, std::span<const Vec3> polygon, const Vec3& normal,
                                                 double lift, std::span<std::uint32_t> found) const {
  const Shaft shaft(eye, polygon, normal, lift);
  std::size_t count = 0;
  bool too_many = false;
  boxes_.walk([&](const Box& box) { return !too_many && shaft.may_enter(box); },
              [&](std::uint32_t index) {
                if (!shaft.may_be_hidden_by(triangle(index))) {
                  return;
                }
                if (count == found.size()) {
                  too_many = true;
                } else {
                  found[count++] = index;
                }
              });
  return too_many ? std::nullopt : std::optional(count);
}

}  // namespace radvor
