// Meshes made of quads and boxes: what the generated scenes are built from.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "scene_data.h"

namespace bench {

class MeshWriter {
 public:
  explicit MeshWriter(std::string name) { mesh_.name = std::move(name); }

  /// Counter-clockwise as seen from its front.
  void quad(const std::array<glm::vec3, 4>& corners, std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.insert(mesh_.positions.end(), corners.begin(), corners.end());
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) {
      mesh_.indices.push_back(first + i);
    }
    mesh_.triangle_materials.insert(mesh_.triangle_materials.end(), 2, material);
  }

  /// origin, and two sides; the front is where right x up points.
  void rectangle(const glm::vec3& origin, const glm::vec3& right, const glm::vec3& up, std::uint32_t material) {
    quad({origin, origin + right, origin + right + up, origin + up}, material);
  }

  bake::MeshData take() { return std::move(mesh_); }

 private:
  bake::MeshData mesh_;
};

}  // namespace bench
