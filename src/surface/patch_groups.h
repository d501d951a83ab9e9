// Patches where facets are too small to have lattices of their own: neighbours of similar orientation shoot together.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/vector.h"

namespace radvor {

/// What is kept together: one side of a small facet, or a single share of a larger one.
struct PatchMember {
  Vec3 position;
  Vec3 normal;  ///< unit, on the member's side
  double area;
  bool emits;  ///< lights and what they light do not mix: patches shoot in order of power
};

/// How large a patch may grow.
struct PatchLimits {
  double area;    ///< scene units squared
  double extent;  ///< scene units, along each axis
};

/// Groups members top-down: a group that is too large, in area, extent or range of normals, is cut at the middle of
/// its longest axis in (position, normal). Returns the number of groups, and fills the group of each member; groups
/// are numbered as the cuts order them.
std::uint32_t group_members(std::span<const PatchMember> members, const PatchLimits& limits,
                            std::pmr::vector<std::uint32_t>& groups, std::pmr::memory_resource* memory);

}  // namespace radvor
