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

// The convex hull of two planar quadrilaterals, as planes that bound it: the quadrilaterals' own and, of all planes
// through an edge of one and a corner of the other, those that have both on one side (Haines and Wallace 1991).
class Hull {
 public:
  Hull(std::span<const Vec3> near, const Vec3& near_normal, std::span<const Vec3> far, const Vec3& far_normal,
       double lift) {
    for (const Vec3& corner : near) {
      bounds_.add(corner);
    }
    for (const Vec3& corner : far) {
      bounds_.add(corner);
    }
    add(near_normal, glm::dot(near_normal, near[0]) + lift);
    add(far_normal, glm::dot(far_normal, far[0]) + lift);
    add_sides(near, far);
    add_sides(far, near);
  }

  bool may_enter(const Box& box) const {
    if (!box.overlaps(bounds_)) {
      return false;
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const Vec3& n = planes_[i].normal;
      const double highest = n.x * (n.x > 0 ? box.high.x : box.low.x) + n.y * (n.y > 0 ? box.high.y : box.low.y) +
                             n.z * (n.z > 0 ? box.high.z : box.low.z);
      if (highest <= planes_[i].offset) {
        return false;
      }
    }
    return true;
  }

  bool may_enter(const std::array<Vec3, 3>& triangle) const {
    for (std::size_t i = 0; i < count_; ++i) {
      const Vec3& n = planes_[i].normal;
      if (std::max({glm::dot(n, triangle[0]), glm::dot(n, triangle[1]), glm::dot(n, triangle[2])}) <=
          planes_[i].offset) {
        return false;
      }
    }
    return true;
  }

 private:
  struct Plane {
    Vec3 normal;  // inwards
    double offset;
  };

  void add(const Vec3& normal, double offset) { planes_[count_++] = {normal, offset}; }

  void add_sides(std::span<const Vec3> edges, std::span<const Vec3> corners) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Vec3& a = edges[i];
      const Vec3& b = edges[(i + 1) % edges.size()];
      for (const Vec3& corner : corners) {
        Vec3 normal = glm::cross(b - a, corner - a);
        const double length = glm::length(normal);
        if (length == 0) {
          continue;
        }
        normal /= length;
        double least = 0, most = 0;
        const auto measure = [&](const Vec3& point) {
          const double height = glm::dot(normal, point - a);
          least = std::min(least, height);
          most = std::max(most, height);
        };
        std::for_each(edges.begin(), edges.end(), measure);
        std::for_each(corners.begin(), corners.end(), measure);
        const double rounding = 1e-12 * glm::length(corner - a);
        if (count_ < planes_.size() && least >= -rounding && most > rounding) {
          add(normal, glm::dot(normal, a) + least);
        } else if (count_ < planes_.size() && most <= rounding && least < -rounding) {
          add(-normal, -glm::dot(normal, a) - most);
        }
      }
    }
  }

  Box bounds_;
  std::array<Plane, 18> planes_;
  std::size_t count_ = 0;
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

bool OccluderTree::clear(std::span<const Vec3> receivers, const Vec3& receiver_normal, std::span<const Vec3> polygon,
                         const Vec3& normal, double lift) const {
  const Hull hull(receivers, receiver_normal, polygon, normal, lift);
  bool clear = true;
  boxes_.walk([&](const Box& box) { return clear && hull.may_enter(box); },
              [&](std::uint32_t index) { clear = clear && !hull.may_enter(triangle(index)); });
  return clear;
}

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
