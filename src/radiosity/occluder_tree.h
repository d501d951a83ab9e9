// The triangles that may stand between a point and a polygon: those that reach into the shaft, the pyramid from the one
// to the other (after Haines and Wallace 1991).
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"
#include "scene/box_tree.h"
#include "visibility/visibility.h"

namespace radvor {

/// Immutable; may be asked by many threads at once, allocates nothing then.
class OccluderTree {
 public:
  static constexpr std::size_t k_max_corners = 12;  ///< of the polygon at the end of a shaft

  /// Copies the corners; `occluders.positions` must outlive the tree.
  OccluderTree(const Occluders& occluders, std::pmr::memory_resource* memory);

  /// Writes the triangles that may hide a part of the convex polygon (counter-clockwise about its unit normal, `eye` in
  /// front of it) from `eye` to `found`, in an order that depends on the scene alone, and returns their number; none if
  /// there are more than `found` has room for. All that hide something are among them, but for what VisiblePolygon's
  /// `lift` leaves out; most of the others are not.
  std::optional<std::size_t> between(const Vec3& eye, std::span<const Vec3> polygon, const Vec3& normal, double lift,
                                     std::span<std::uint32_t> found) const;

  /// Whether nothing stands between any point of a convex polygon of receivers and any point of another polygon: no
  /// triangle reaches into the convex hull of the two, in front of both their planes by more than lift. False where it
  /// cannot tell. Both have at most 4 corners, counter-clockwise about their unit normals.
  bool clear(std::span<const Vec3> receivers, const Vec3& receiver_normal, std::span<const Vec3> polygon,
             const Vec3& normal, double lift) const;

  std::array<Vec3, 3> triangle(std::uint32_t index) const {
    return {positions_[corners_[3 * std::size_t{index}]], positions_[corners_[3 * std::size_t{index} + 1]],
            positions_[corners_[3 * std::size_t{index} + 2]]};
  }

 private:
  std::span<const Vec3> positions_;
  std::pmr::vector<std::uint32_t> corners_;
  BoxTree boxes_;
};

}  // namespace radvor
