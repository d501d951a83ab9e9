#include "scene/overlap.h"

#include <algorithm>
#include <vector>

#include "scene/box_tree.h"

namespace radvor {
namespace {

using Triangle2 = std::array<Vec2, 3>;

// Whether a line along a side of `a` has all of `b` on its outside, or less than the tolerance inside.
bool a_side_separates(const Triangle2& a, const Triangle2& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 side = a[(i + 1) % 3] - a[i];
    const double deepest = std::max({cross(side, b[0] - a[i]), cross(side, b[1] - a[i]), cross(side, b[2] - a[i])});
    if (deepest <= tolerance * length(side)) {
      return true;
    }
  }
  return false;
}

bool overlap(const Triangle2& a, const Triangle2& b, double tolerance) {
  return !a_side_separates(a, b, tolerance) && !a_side_separates(b, a, tolerance);
}

}  // namespace

bool triangles_overlap(std::span<const Triangle2> triangles, double tolerance, std::pmr::memory_resource* memory) {
  constexpr std::size_t k_few = 16;
  if (triangles.size() <= k_few) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t j = i + 1; j < triangles.size(); ++j) {
        if (overlap(triangles[i], triangles[j], tolerance)) {
          return true;
        }
      }
    }
    return false;
  }
  std::pmr::vector<Box> boxes(triangles.size(), memory);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const Vec2& p : triangles[i]) {
      boxes[i].add(Vec3(p, 0.0));
    }
  }
  const BoxTree tree(boxes, memory);
  bool found = false;
  for (std::uint32_t i = 0; i < triangles.size() && !found; ++i) {
    tree.walk([&](const Box& box) { return !found && box.overlaps(boxes[i]); },
              [&](std::uint32_t j) { found = found || (j > i && overlap(triangles[i], triangles[j], tolerance)); });
  }
  return found;
}

}  // namespace radvor
