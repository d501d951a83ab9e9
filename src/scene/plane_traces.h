// The trace that a triangle leaves in a facet's plane: where it cuts through the plane, stands on it, lies in it, or
// ends closely above it.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "scene/facets.h"
#include "scene/welded.h"

namespace radvor {

/// A segment in a facet's frame, not clipped to the facet and not snapped.
struct Trace {
  Vec2 a, b;
  double gap;           ///< 0: touches or cuts; else how high above the plane it is
  std::uint32_t facet;  ///< that touches or cuts; k_none: it is near
};

/// A facet as what others leave traces on.
class TracedPlane {
 public:
  /// reach: what is no higher above the plane is close to it.
  TracedPlane(const WeldedScene& welded, const Facets& facets, std::uint32_t facet, bool two_sided, double reach);

  /// Appends what a triangle of another facet leaves. Traces that are edges of the facet's own triangles are left out:
  /// they are its outline. A facet with one side sees nothing that stays behind its plane.
  void trace(std::uint32_t triangle, std::pmr::vector<Trace>& traces) const;

  /// How far off the plane still counts as in it.
  double tolerance() const { return tolerance_; }
  /// Of the facet's corners.
  double precision() const { return precision_; }

  const Frame& frame() const { return frame_; }
  double height(const Vec3& point) const { return dot(point - frame_.origin, frame_.normal); }
  /// Projected, not snapped.
  Vec2 project(const Vec3& point) const {
    return {dot(point - frame_.origin, frame_.u), dot(point - frame_.origin, frame_.v)};
  }

 private:
  struct Corner {
    Vec3 position;
    double height;
    int side;  ///< -1, 0, 1: below, in, above the plane
  };
  void trace_cut(std::uint32_t triangle, const std::array<Corner, 3>& corners, std::pmr::vector<Trace>& traces) const;
  void trace_edges(std::uint32_t triangle, std::pmr::vector<Trace>& traces) const;
  void trace_near(std::uint32_t triangle, std::pmr::vector<Trace>& traces) const;
  bool is_end_of_contact(std::uint32_t edge) const;
  bool is_silhouette(std::uint32_t edge) const;
  bool lies_in_plane(std::uint32_t vertex) const;
  bool lies_in_plane(const Triangle& triangle) const;

  const WeldedScene& welded_;
  const Facets& facets_;
  std::uint32_t facet_;
  const Frame& frame_;
  bool two_sided_;
  double precision_ = 0, size_ = 0, tolerance_ = 0, reach_;
};

}  // namespace radvor
