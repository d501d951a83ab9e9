#include "scene/position_welding.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scene/box_tree.h"
#include "scene/disjoint_sets.h"
#include "scene/index_table.h"

namespace radvor {
namespace {

std::uint64_t hash_position(const Vec3& p) {
  return hash(std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y), std::bit_cast<std::uint64_t>(p.z));
}

// Half a float ulp a coordinate, carried through the transform, and the rounding of the transform itself.
double precision_of(const Transform& t, const Vec3& p) {
  constexpr double k_float = 0x1p-24;
  constexpr double k_double = 0x1p-51;
  Vec3 moved;
  for (glm::length_t row = 0; row < 3; ++row) {
    const double* r = t.data() + std::size_t{4} * static_cast<std::size_t>(row);
    const double terms = std::abs(r[0] * p.x) + std::abs(r[1] * p.y) + std::abs(r[2] * p.z);
    moved[row] = terms * k_float + (terms + std::abs(r[3])) * k_double;
  }
  return length(moved);
}

WeldedPositions weld_equal(const Scene& scene, std::pmr::memory_resource* memory) {
  WeldedPositions result(memory);
  std::size_t count = 0;
  for (const Mesh& mesh : scene.meshes) {
    count += mesh.positions.size();
  }
  result.positions.reserve(count);
  result.precision.reserve(count);
  IndexTable table(count, memory);
  for (const Mesh& mesh : scene.meshes) {
    auto& vertex_of = result.vertex_of.emplace_back(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vec3 local(mesh.positions[i]);
      const Vec3 p = transform_point(mesh.transform, local) + 0.0;  // -0 becomes 0
      const auto next = static_cast<std::uint32_t>(result.positions.size());
      const std::uint32_t vertex = table.find_or_insert(
          hash_position(p), next, [&](std::uint32_t other) { return result.positions[other] == p; });
      if (vertex == next) {
        result.positions.push_back(p);
        result.precision.push_back(0);
      }
      result.precision[vertex] = std::max(result.precision[vertex], precision_of(mesh.transform, local));
      vertex_of[i] = vertex;
    }
  }
  return result;
}

// Makes each set one point. Its smallest member comes first: it takes the next number, then gathers from the others.
void merge(WeldedPositions& welded, DisjointSets& sets, std::pmr::memory_resource* memory) {
  const auto count = static_cast<std::uint32_t>(welded.positions.size());
  std::pmr::vector<std::uint32_t> renumbered(count, memory);
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t root = sets.find(i);
    const Vec3 p = welded.positions[i];
    const double precision = welded.precision[i];
    if (root == i) {
      renumbered[i] = kept;
      welded.positions[kept] = p;
      welded.precision[kept] = precision;
      ++kept;
      continue;
    }
    const std::uint32_t vertex = renumbered[i] = renumbered[root];
    if (lies_before(p, welded.positions[vertex])) {
      welded.positions[vertex] = p;
    }
    welded.precision[vertex] = std::max(welded.precision[vertex], precision);
  }
  welded.positions.resize(kept);
  welded.precision.resize(kept);
  for (auto& vertex_of : welded.vertex_of) {
    for (std::uint32_t& vertex : vertex_of) {
      vertex = renumbered[vertex];
    }
  }
}

void weld_near(WeldedPositions& welded, double distance, std::pmr::memory_resource* memory) {
  const auto count = static_cast<std::uint32_t>(welded.positions.size());
  std::pmr::vector<Box> boxes(count, memory);
  for (std::uint32_t i = 0; i < count; ++i) {
    boxes[i].add(welded.positions[i]);
  }
  const BoxTree tree(boxes, memory);
  DisjointSets sets(count, memory);
  const double squared = distance * distance;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3& p = welded.positions[i];
    tree.walk([&](const Box& box) { return box.squared_distance(p) <= squared; },
              [&](std::uint32_t other) {
                const Vec3 apart = welded.positions[other] - p;
                if (other > i && dot(apart, apart) <= squared) {
                  sets.unite(i, other);
                }
              });
  }
  merge(welded, sets, memory);
}

// Whether there were any. Merging moves points, which may shorten other sides.
bool weld_short_sides(const Scene& scene, WeldedPositions& welded, std::pmr::memory_resource* memory) {
  std::pmr::vector<std::pair<std::uint32_t, std::uint32_t>> sides(memory);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const auto& indices = scene.meshes[m].indices;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const std::uint32_t a = welded.vertex_of[m][indices[i]];
      const std::uint32_t b = welded.vertex_of[m][indices[i % 3 == 2 ? i - 2 : i + 1]];
      const Vec3 side = welded.positions[b] - welded.positions[a];
      const double touching = touching_distance(welded.precision[a] + welded.precision[b], 0);
      if (a != b && dot(side, side) <= touching * touching) {
        sides.emplace_back(a, b);
      }
    }
  }
  if (sides.empty()) {
    return false;
  }
  DisjointSets sets(static_cast<std::uint32_t>(welded.positions.size()), memory);
  for (const auto& [a, b] : sides) {
    sets.unite(a, b);
  }
  merge(welded, sets, memory);
  return true;
}

}  // namespace

WeldedPositions weld_positions(const Scene& scene, double weld_distance, std::pmr::memory_resource* memory) {
  WeldedPositions welded = weld_equal(scene, memory);
  if (weld_distance > 0) {
    weld_near(welded, weld_distance, memory);
  }
  while (weld_short_sides(scene, welded, memory)) {
  }
  return welded;
}

}  // namespace radvor
