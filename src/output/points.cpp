#include "output/points.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "output/closest_point.h"

namespace radvor {
namespace {

constexpr std::uint32_t k_block = 64;  // points a task

}  // namespace

/// The input's triangles, not the adaptive mesh's: fewer, and the same however far the light and its mesh have come.
struct PointIndex::State {
  State(const Surface& surface, std::pmr::memory_resource* memory)
      : triangles(memory), corners(memory), two_sided(memory) {
    const auto& facet_of = surface.facets().facet_of_triangle;
    for (std::uint32_t triangle = 0; triangle < facet_of.size(); ++triangle) {
      if (surface.triangles(facet_of[triangle]).empty()) {
        continue;  // does not receive
      }
      const auto& vertices = surface.welded().triangles[triangle].vertices;
      triangles.push_back(triangle);
      corners.insert(corners.end(), vertices.begin(), vertices.end());
      two_sided.push_back(radvor::two_sided(surface, facet_of[triangle]) ? 1 : 0);
    }
    closest.emplace(surface.welded().positions, corners, two_sided, memory);
  }

  std::pmr::vector<std::uint32_t> triangles;  ///< welded
  std::pmr::vector<std::uint32_t> corners;    ///< 3 a triangle
  std::pmr::vector<std::uint8_t> two_sided;   ///< 1 a triangle
  std::optional<ClosestPoints> closest;       ///< refers to the arrays above
};

PointIndex::PointIndex(const LitSurface& lit) : memory_(&lit.host.memory) {
  state_ = std::pmr::polymorphic_allocator<>(memory_).new_object<State>(lit.surface, memory_);
}

PointIndex::~PointIndex() {
  std::pmr::polymorphic_allocator<>(memory_).delete_object(state_);
}

void PointIndex::sample(const LitSurface& lit, Quantity quantity, std::uint32_t count, const double* positions,
                        const float* normals, double max_distance, float* rgb, std::uint8_t* found) const {
  const auto sample_one = [&](std::size_t i) {
    const Vec3 position(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    const Vec3 normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    Color value(0.0);
    const ClosestPoint closest = state_->closest->find(position, normal, max_distance);
    const bool any = closest.triangle != ClosestPoint::k_nothing;
    if (any) {
      const std::uint32_t triangle = state_->triangles[closest.triangle];
      const std::uint32_t facet = lit.surface.facets().facet_of_triangle[triangle];
      Vec3 on_triangle(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        on_triangle += closest.weights[static_cast<glm::length_t>(k)] *
                       lit.surface.welded().positions[lit.surface.welded().triangles[triangle].vertices[k]];
      }
      const Frame& frame = lit.surface.facets().facets[facet].frame;
      value = value_at(lit, quantity, lit.surface.locate(facet, frame.to_plane(on_triangle)), closest.back);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      rgb[3 * i + k] = static_cast<float>(value[static_cast<glm::length_t>(k)]);
    }
    if (found != nullptr) {
      found[i] = any ? 1 : 0;
    }
  };
  lit.host.jobs.for_each(count / k_block + (count % k_block > 0 ? 1 : 0), [&](std::uint32_t block) {
    const std::size_t last = std::min<std::size_t>(count, (std::size_t{block} + 1) * k_block);
    for (std::size_t i = std::size_t{block} * k_block; i < last; ++i) {
      sample_one(i);
    }
  });
}

}  // namespace radvor
