// A scene as arrays, the way radvor_scene_add_material and radvor_scene_add_mesh take it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace bake {

struct MaterialData {
  std::string name;
  glm::vec3 albedo{0.5f};
  glm::vec3 emission{0.0f};  ///< radiance
};

struct MeshData {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;      ///< as many as positions, or none: then from geometry and crease angle
  std::vector<glm::vec3> colors;       ///< as many as positions, or none
  std::vector<glm::vec2> uvs;          ///< as many as positions, or none
  std::vector<std::uint32_t> indices;  ///< 3 a triangle
  std::vector<std::uint32_t> triangle_materials;  ///< 1 a triangle, of SceneData::materials
};

struct SceneData {
  std::vector<MaterialData> materials;
  std::vector<MeshData> meshes;

  std::size_t triangle_count() const {
    std::size_t count = 0;
    for (const MeshData& mesh : meshes) {
      count += mesh.triangle_materials.size();
    }
    return count;
  }
};

/// Box of all positions that triangles use.
struct Bounds {
  glm::dvec3 low{0};
  glm::dvec3 high{0};
};

Bounds bounds_of(const SceneData& scene);

}  // namespace bake
