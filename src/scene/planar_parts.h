// Which triangles lie in one plane with their neighbours: the first guess at facets.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "scene/welded.h"

namespace radvor {

/// Triangles in groups, each in ascending order, the groups ordered by their first triangle.
struct TriangleGroups {
  explicit TriangleGroups(std::pmr::memory_resource* memory) : triangles(memory), first(memory) {}

  std::pmr::vector<std::uint32_t> triangles;
  std::pmr::vector<std::uint32_t> first;  ///< per group (and one past the last)

  std::size_t size() const { return first.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return std::span(triangles).subspan(first[group], first[group + 1] - first[group]);
  }
};

/// Groups triangles by a label each; labels are below their number.
TriangleGroups group_by(std::span<const std::uint32_t> labels, std::pmr::memory_resource* memory);

/// Whether two triangles lie in one plane: the vertices of one in the better known plane of the other (a sliver's own
/// plane says little), with normals within ten degrees.
bool coplanar(const WeldedScene& welded, const Triangle& a, const Triangle& b);

/// Splits the triangles into sets that joined edges connect, that lie in one plane each. Sets do not depend on the
/// order of the triangles. joins[e] marks the edges, of two uses each, that may be grown over; neighbours are coplanar.
/// Where neighbours are pairwise coplanar but the whole is not (finely tessellated curves), sets grow from the largest
/// triangle left, in its plane.
TriangleGroups planar_parts(const WeldedScene& welded, const std::pmr::vector<bool>& joins,
                            std::pmr::memory_resource* memory);

}  // namespace radvor
