// The adaptive mesh of one input mesh, ready to draw: watertight where the input is, without T-vertices.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "output/lit_surface.h"

namespace radvor {

/// Arrays of radvor_output_mesh. Vertices are split where normals, UVs or light are discontinuous.
struct AdaptiveMesh {
  explicit AdaptiveMesh(std::pmr::memory_resource* memory)
      : positions(memory),
        normals(memory),
        uvs(memory),
        irradiance(memory),
        radiance(memory),
        indices(memory),
        materials(memory),
        source_triangles(memory),
        source_weights(memory) {}

  std::pmr::vector<glm::vec3> positions;  ///< in the mesh's own space; input corners keep their bits
  std::pmr::vector<glm::vec3> normals;    ///< in the mesh's own space, unit
  std::pmr::vector<glm::vec2> uvs;        ///< empty where the input had none
  std::pmr::vector<glm::vec3> irradiance;
  std::pmr::vector<glm::vec3> radiance;
  std::pmr::vector<std::uint32_t> indices;           ///< 3 a triangle, wound as the input
  std::pmr::vector<std::uint32_t> materials;         ///< 1 a triangle
  std::pmr::vector<std::uint32_t> source_triangles;  ///< 1 a triangle
  std::pmr::vector<float> source_weights;            ///< 9 a triangle
};

/// From the light as it is now. A mesh that does not receive has an empty one.
AdaptiveMesh make_adaptive_mesh(const LitSurface& lit, std::uint32_t mesh);

}  // namespace radvor
