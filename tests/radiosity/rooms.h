// Small scenes for tests of transport: rooms, boxes, prisms, in one mesh each.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "scene/scene.h"

namespace radvor {

class SceneBuilder {
 public:
  SceneBuilder() : scene(std::pmr::get_default_resource()), mesh_(std::pmr::get_default_resource()) {}

  std::uint32_t material(const Color& albedo, const Color& emission = Color(0.0), bool two_sided = false) {
    scene.materials.push_back({albedo, emission, two_sided});
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  }

  void triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t material) {
    for (const Vec3& corner : {a, b, c}) {
      mesh_.indices.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
      mesh_.positions.push_back(glm::vec3(corner));
    }
    mesh_.triangle_materials.push_back(material);
  }

  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, std::uint32_t material) {
    triangle(a, b, c, material);
    triangle(a, c, d, material);
  }

  /// A prism over a counter-clockwise polygon in the xy plane, triangulated as a fan about its first corner (which must
  /// see all others). inwards: a room, else a solid.
  void prism(const std::vector<Vec2>& outline, double low, double high, bool inwards, std::uint32_t material) {
    const std::size_t n = outline.size();
    const auto at = [&](std::size_t i, double z) { return Vec3(outline[i % n].x, outline[i % n].y, z); };
    for (std::size_t i = 0; i < n; ++i) {
      oriented({at(i, low), at(i + 1, low), at(i + 1, high)}, inwards, material);
      oriented({at(i, low), at(i + 1, high), at(i, high)}, inwards, material);
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
      oriented({at(0, high), at(i, high), at(i + 1, high)}, inwards, material);
      oriented({at(0, low), at(i + 1, low), at(i, low)}, inwards, material);
    }
  }

  void box(const Vec3& low, const Vec3& high, bool inwards, std::uint32_t material) {
    prism({{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}, low.z, high.z, inwards, material);
  }

  /// The only light: a sky of that radiance all around, W sr^-1 m^-2.
  void under_sky(const Color& radiance) {
    Light sky;
    sky.type = LightType::sky;
    sky.color = radiance;
    scene.lights = {sky};
  }

  /// The scene with what was added as one mesh; the builder is empty after.
  Scene take() {
    scene.meshes.push_back(std::move(mesh_));
    return std::move(scene);
  }

  Mesh& mesh() { return mesh_; }

  Scene scene;

 private:
  void oriented(const std::array<Vec3, 3>& t, bool inwards, std::uint32_t material) {
    if (inwards) {
      triangle(t[0], t[2], t[1], material);
    } else {
      triangle(t[0], t[1], t[2], material);
    }
  }

  Mesh mesh_;
};

/// The L of a 2 x 2 x 1 room without one quarter; its first corner is the reflex one, which sees all others.
inline std::vector<Vec2> l_shape() {
  return {{1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}, {2, 1}};
}

}  // namespace radvor
