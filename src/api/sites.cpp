// radvor_scene_add_sites: points that lie on a mesh, checked against its triangles.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "api/checks.h"
#include "api/scene.h"
#include "scene/box_tree.h"
#include "scene/closest_weights.h"

using namespace radvor;
using namespace radvor::api;

namespace {

// A mesh's triangles in world space, and how far off them a point may be that is meant to lie on them.
class SurfaceOfMesh {
 public:
  SurfaceOfMesh(const Mesh& mesh, std::pmr::memory_resource* memory)
      : mesh_(mesh), positions_(memory), tree_(boxes(memory), memory) {
    const Vec3 size = bounds_.high - bounds_.low;
    const Vec3 farthest = glm::max(glm::abs(bounds_.low), glm::abs(bounds_.high));
    constexpr double k_share_of_size = 1e-6;
    constexpr double k_roundings = 4 * std::numeric_limits<float>::epsilon();
    touching_ = k_share_of_size * glm::length(size) + k_roundings * std::max({farthest.x, farthest.y, farthest.z});
  }

  bool has(const Vec3& point) const {
    double nearest = touching_ * touching_;
    bool found = false;
    tree_.walk_nearest(
        point, [&] { return nearest; },
        [&](std::uint32_t triangle) {
          const auto corner = [&](std::uint32_t k) -> const Vec3& {
            return positions_[mesh_.indices[3 * triangle + k]];
          };
          const Vec3 weights = closest_weights(point, corner(0), corner(1), corner(2));
          const Vec3 apart = point - (weights.x * corner(0) + weights.y * corner(1) + weights.z * corner(2));
          if (dot(apart, apart) <= nearest) {
            nearest = dot(apart, apart);
            found = true;
          }
        });
    return found;
  }

 private:
  std::pmr::vector<Box> boxes(std::pmr::memory_resource* memory) {
    positions_.reserve(mesh_.positions.size());
    for (const glm::vec3& position : mesh_.positions) {
      positions_.push_back(transform_point(mesh_.transform, Vec3(position)));
    }
    std::pmr::vector<Box> of_triangles(mesh_.indices.size() / 3, memory);
    for (std::size_t k = 0; k < mesh_.indices.size(); ++k) {
      of_triangles[k / 3].add(positions_[mesh_.indices[k]]);
      bounds_.add(positions_[mesh_.indices[k]]);
    }
    return of_triangles;
  }

  const Mesh& mesh_;
  Box bounds_;
  std::pmr::vector<Vec3> positions_;
  BoxTree tree_;
  double touching_;
};

}  // namespace

radvor_result radvor_scene_add_sites(radvor_scene* scene, uint32_t mesh, const double* positions, uint32_t count) {
  return enter(context_of(scene), __func__, [&] {
    auto& meshes = scene->scene.meshes;
    if (mesh >= meshes.size()) {
      throw Error(ErrorCode::invalid_argument, "there is no mesh %" PRIu32, mesh);
    }
    if (!meshes[mesh].receives) {
      throw Error(ErrorCode::invalid_argument, "mesh %" PRIu32 " does not receive", mesh);
    }
    if (count == 0) {
      return;
    }
    require(positions, "positions");
    std::pmr::memory_resource* memory = meshes[mesh].sites.get_allocator().resource();
    const SurfaceOfMesh surface(meshes[mesh], memory);
    std::pmr::vector<Vec3> sites(meshes[mesh].sites, memory);
    for (std::uint32_t k = 0; k < count; ++k) {
      const double* at = positions + std::size_t{3} * k;
      const Vec3 point(at[0], at[1], at[2]);
      if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
        throw Error(ErrorCode::invalid_geometry, "point %" PRIu32 ", (%g %g %g), is not finite", k, at[0], at[1],
                    at[2]);
      }
      if (!surface.has(point)) {
        throw Error(ErrorCode::invalid_geometry,
                    "point %" PRIu32 ", (%.9g %.9g %.9g), lies on no triangle of mesh %" PRIu32, k, at[0], at[1], at[2],
                    mesh);
      }
      sites.push_back(point);
    }
    meshes[mesh].sites.swap(sites);
  });
}
