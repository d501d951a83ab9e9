// What a facet looks like at a site: its shading normal and albedo, taken from the triangle it came from.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "surface/facet_draft.h"

namespace radvor {

/// So that every scene converges.
inline constexpr double k_most_albedo = 0.99;

struct Shading {
  Vec3 normal;   ///< unit, on the front
  Color albedo;  ///< at most k_most_albedo
  bool clamped;  ///< it was more
};

class FacetShading {
 public:
  explicit FacetShading(const FacetInput& input);

  /// At a site on a side of a source triangle: interpolated along the side, between its ends in the order of their
  /// positions, so that what is equal on both sides of an edge stays equal to the bit.
  Shading on_side(const SourceSide& source, const Vec3& position) const;
  /// At a corner of a source triangle.
  Shading at_corner(std::uint32_t triangle, std::uint32_t corner) const;
  /// At a site inside the facet.
  Shading inside(const Vec2& point);

 private:
  Shading blend(std::uint32_t triangle, const Vec3& weights) const;
  void build_grid();

  const FacetInput& in_;
  bool varies_;  // normals or colours
  // Source triangles by cells of a grid over the facet, built when it is first needed.
  Vec2 low_{0.0}, cell_{1.0};
  std::uint32_t columns_ = 0, rows_ = 0;
  std::pmr::vector<std::array<Vec2, 3>> corners_;
  std::pmr::vector<std::uint32_t> first_, members_;
};

}  // namespace radvor
