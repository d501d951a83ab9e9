// Scenes for tests, built a polygon at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>
#include <vector>

#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor::test {

class SceneBuilder {
 public:
  explicit SceneBuilder(std::pmr::memory_resource* memory) : scene(memory), memory_(memory) {
    scene.materials.resize(3);
    scene.materials[2].two_sided = true;
  }

  Mesh& mesh() { return scene.meshes.emplace_back(memory_); }

  /// A fan in the last mesh; vertices are not shared with other polygons, as engines split them.
  SceneBuilder& polygon(std::initializer_list<glm::vec3> corners, std::uint32_t material = 0) {
    return polygon(std::vector<glm::vec3>(corners), material);
  }
  SceneBuilder& polygon(const std::vector<glm::vec3>& corners, std::uint32_t material = 0) {
    if (scene.meshes.empty()) {
      mesh();
    }
    Mesh& m = scene.meshes.back();
    const auto first = static_cast<std::uint32_t>(m.positions.size());
    m.positions.insert(m.positions.end(), corners.begin(), corners.end());
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
      m.indices.insert(m.indices.end(), {first, first + i - 1, first + i});
      m.triangle_materials.push_back(material);
    }
    return *this;
  }

  /// Faces outward.
  SceneBuilder& box(glm::vec3 a, glm::vec3 b) {
    polygon({{a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}});
    polygon({{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}});
    polygon({{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}});
    polygon({{a.x, b.y, a.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}});
    polygon({{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}});
    return polygon({{b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z}});
  }

  /// Closed, along z, faces outward: side quads and two n-gons.
  SceneBuilder& cylinder(int sides, float radius, float height) {
    std::vector<glm::vec3> top, bottom;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      const auto x = static_cast<float>(radius * std::cos(angle));
      const auto y = static_cast<float>(radius * std::sin(angle));
      bottom.emplace_back(x, y, 0.0f);
      top.emplace_back(x, y, height);
    }
    for (std::size_t i = 0; i < bottom.size(); ++i) {
      const std::size_t j = (i + 1) % bottom.size();
      polygon({bottom[i], bottom[j], top[j], top[i]});
    }
    polygon(top);
    std::ranges::reverse(bottom);
    return polygon(bottom);
  }

  Scene scene;

 private:
  std::pmr::memory_resource* memory_;
};

/// The same triangles of each mesh in another order, each turned.
inline void shuffle(Scene& scene, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (Mesh& mesh : scene.meshes) {
    for (std::size_t i = mesh.triangle_materials.size(); i-- > 1;) {
      const std::size_t j = random() % (i + 1);
      std::swap(mesh.triangle_materials[i], mesh.triangle_materials[j]);
      std::swap_ranges(mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * i),
                       mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * i + 3),
                       mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * j));
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      std::rotate(mesh.indices.begin() + static_cast<std::ptrdiff_t>(i),
                  mesh.indices.begin() + static_cast<std::ptrdiff_t>(i + random() % 3),
                  mesh.indices.begin() + static_cast<std::ptrdiff_t>(i + 3));
    }
  }
}

}  // namespace radvor::test
