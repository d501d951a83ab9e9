#include "scene_data.h"

#include <glm/common.hpp>
#include <limits>

namespace bake {

Bounds bounds_of(const SceneData& scene) {
  Bounds bounds{glm::dvec3(std::numeric_limits<double>::infinity()),
                glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (const MeshData& mesh : scene.meshes) {
    for (const std::uint32_t index : mesh.indices) {
      const glm::dvec3 position(mesh.positions[index]);
      bounds.low = glm::min(bounds.low, position);
      bounds.high = glm::max(bounds.high, position);
    }
  }
  return bounds.low.x <= bounds.high.x ? bounds : Bounds{};
}

}  // namespace bake
