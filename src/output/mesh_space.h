// From world space back into a mesh's own: what an adaptive mesh's positions and normals are stored in.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/vector.h"
#include "scene/scene.h"
#include "scene/welded.h"
#include "surface/surface.h"

namespace radvor {

/// The result for a site depends on the site and the mesh alone, so that all facets of a mesh agree to the bit, and so
/// do all meshes that have the identity for a transform.
class MeshSpace {
 public:
  MeshSpace(const Scene& scene, const WeldedScene& welded, std::uint32_t mesh, std::pmr::memory_resource* memory);

  /// False where the transform flattens: no position can be told from its image then, ask a source triangle.
  bool invertible() const { return invertible_; }

  /// The mesh's own vertex at a welded vertex (the first of several), or k_none.
  std::uint32_t own_vertex(std::uint32_t welded_vertex) const;

  /// Through the inverse transform. invertible() holds.
  glm::vec3 position(const Vec3& world) const;

  /// Unit. Normals are perpendicular to what they were perpendicular to, on the same side: the way back takes the
  /// transposed transform. 0 where the transform flattens along the normal.
  glm::vec3 normal(const Vec3& world) const;

 private:
  const std::pmr::vector<std::uint32_t>& welded_of_;
  std::pmr::vector<std::uint32_t> own_;  ///< vertices of the mesh by welded vertex, the first of each
  Transform transform_;
  std::array<double, 9> inverse_{};  ///< of the linear part, row-major
  bool invertible_ = false;
};

}  // namespace radvor
