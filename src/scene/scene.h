// A scene as the host gave it: materials, meshes, lights. Checked by src/api before it gets here; nothing is welded,
// repaired or thrown away yet.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/vector.h"

namespace radvor {

struct Material {
  Color albedo{0.0};    ///< diffuse reflectance, 0..1
  Color emission{0.0};  ///< emitted radiance, W sr^-1 m^-2, >= 0
  bool two_sided = false;
};

/// 3x4 row-major affine map, object to world.
using Transform = std::array<double, 12>;
inline constexpr Transform k_identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

struct Mesh {
  explicit Mesh(std::pmr::memory_resource* memory)
      : positions(memory),
        normals(memory),
        colors(memory),
        uvs(memory),
        indices(memory),
        triangle_materials(memory),
        sites(memory) {}

  std::pmr::vector<glm::vec3> positions;               ///< object space, finite
  std::pmr::vector<glm::vec3> normals;                 ///< object space, as given; empty: none
  std::pmr::vector<glm::vec3> colors;                  ///< multiply the albedo; empty: 1
  std::pmr::vector<glm::vec2> uvs;                     ///< empty: none
  std::pmr::vector<std::uint32_t> indices;             ///< 3 a triangle, wound as given
  std::pmr::vector<std::uint32_t> triangle_materials;  ///< 1 a triangle, always filled
  std::pmr::vector<Vec3> sites;                        ///< wanted by the host: world space, on it but for rounding
  Transform transform = k_identity;                    ///< invertible or not: a flattened mesh has zero-area triangles
  bool receives = true;                                ///< not RADVOR_MESH_NO_RECEIVE
  bool casts = true;                                   ///< not RADVOR_MESH_NO_CAST
  bool clockwise = false;                              ///< RADVOR_MESH_CLOCKWISE: front faces wind clockwise
};

enum class LightType : std::uint32_t { point = 0, spot = 1, directional = 2, sky = 3 };

struct Light {
  LightType type = LightType::point;
  Vec3 position{0.0};
  Vec3 direction{0.0, -1.0, 0.0};  ///< unit; the way the light travels; sky: up
  Color color{0.0};                ///< point, spot: W sr^-1; directional: W m^-2 facing; sky: W sr^-1 m^-2
  double radius = 0;               ///< point, spot: of the luminous sphere
  double inner_angle = 0;          ///< spot, radians from the axis
  double outer_angle = 0;
  double angle = 0;  ///< directional: angular diameter, radians
};

struct Scene {
  explicit Scene(std::pmr::memory_resource* memory) : materials(memory), meshes(memory), lights(memory) {}

  std::pmr::vector<Material> materials;
  std::pmr::vector<Mesh> meshes;
  std::pmr::vector<Light> lights;
};

/// World position of a mesh's vertex, in double: far-off transforms lose nothing.
inline Vec3 transform_point(const Transform& t, const Vec3& p) {
  return {t[0] * p.x + t[1] * p.y + t[2] * p.z + t[3], t[4] * p.x + t[5] * p.y + t[6] * p.z + t[7],
          t[8] * p.x + t[9] * p.y + t[10] * p.z + t[11]};
}

/// Whether the map turns counter-clockwise into clockwise.
inline bool mirrors(const Transform& t) {
  return t[0] * (t[5] * t[10] - t[6] * t[9]) - t[1] * (t[4] * t[10] - t[6] * t[8]) +
             t[2] * (t[4] * t[9] - t[5] * t[8]) <
         0;
}

}  // namespace radvor
