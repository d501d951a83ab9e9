#include "output/mesh_space.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radvor {

MeshSpace::MeshSpace(const Scene& scene, const WeldedScene& welded, std::uint32_t mesh,
                     std::pmr::memory_resource* memory)
    : welded_of_(welded.vertex_of[mesh]), own_(welded_of_.size(), memory), transform_(scene.meshes[mesh].transform) {
  std::iota(own_.begin(), own_.end(), 0u);
  std::ranges::sort(own_, [&](std::uint32_t a, std::uint32_t b) {
    return welded_of_[a] != welded_of_[b] ? welded_of_[a] < welded_of_[b] : a < b;
  });
  const auto welded_together = [this](std::uint32_t a, std::uint32_t b) { return welded_of_[a] == welded_of_[b]; };
  own_.erase(std::unique(own_.begin(), own_.end(), welded_together), own_.end());

  const Transform& t = transform_;
  const Vec3 x{t[0], t[4], t[8]};  // images of the axes
  const Vec3 y{t[1], t[5], t[9]};
  const Vec3 z{t[2], t[6], t[10]};
  const std::array<Vec3, 3> rows = {cross(y, z), cross(z, x), cross(x, y)};
  const double determinant = dot(x, rows[0]);
  constexpr double k_flat = 1e-10;  // of the volume that axes of these lengths could span: no float survives that
  invertible_ = std::abs(determinant) > k_flat * length(x) * length(y) * length(z);
  if (!invertible_) {
    return;
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      inverse_[3 * row + column] = rows[row][static_cast<glm::length_t>(column)] / determinant;
    }
  }
}

std::uint32_t MeshSpace::own_vertex(std::uint32_t welded_vertex) const {
  const auto found =
      std::ranges::lower_bound(own_, welded_vertex, {}, [this](std::uint32_t vertex) { return welded_of_[vertex]; });
  return found != own_.end() && welded_of_[*found] == welded_vertex ? *found : k_none;
}

glm::vec3 MeshSpace::position(const Vec3& world) const {
  const Vec3 p = world - Vec3(transform_[3], transform_[7], transform_[11]);
  const std::array<double, 9>& m = inverse_;
  return {static_cast<float>(m[0] * p.x + m[1] * p.y + m[2] * p.z),
          static_cast<float>(m[3] * p.x + m[4] * p.y + m[5] * p.z),
          static_cast<float>(m[6] * p.x + m[7] * p.y + m[8] * p.z)};
}

glm::vec3 MeshSpace::normal(const Vec3& world) const {
  const Transform& t = transform_;
  const Vec3 n{t[0] * world.x + t[4] * world.y + t[8] * world.z, t[1] * world.x + t[5] * world.y + t[9] * world.z,
               t[2] * world.x + t[6] * world.y + t[10] * world.z};
  const double size = length(n);
  return size > 0 ? glm::vec3(n / size) : glm::vec3(0.0f);
}

}  // namespace radvor
