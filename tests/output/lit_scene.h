// Scenes for the tests of the outputs: built from triangles, taken through welding, facets and sites as a bake does,
// and lit by a function of position and normal, so that every answer is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory_resource>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "output/lit_surface.h"
#include "support/made_facets.h"
#include "surface/spacing.h"
#include "surface/surface.h"

namespace radvor::output_test {

/// What scenes of tests are kept in.
inline std::pmr::memory_resource* heap() {
  return std::pmr::new_delete_resource();
}

inline Mesh mesh_of(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices, std::uint32_t material = 0) {
  Mesh mesh(heap());
  mesh.positions.assign(positions.begin(), positions.end());
  mesh.indices.assign(indices.begin(), indices.end());
  mesh.triangle_materials.assign(indices.size() / 3, material);
  return mesh;
}

/// Corners a, b, c, d counter-clockwise.
inline Mesh quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, std::uint32_t material = 0) {
  return mesh_of({a, b, c, d}, {0, 1, 2, 0, 2, 3}, material);
}

/// A grid of columns x rows unit squares in z = 0, facing up, UV = position / (columns, rows).
inline Mesh grid(std::uint32_t columns, std::uint32_t rows) {
  Mesh mesh(heap());
  for (std::uint32_t y = 0; y <= rows; ++y) {
    for (std::uint32_t x = 0; x <= columns; ++x) {
      const glm::vec2 at(static_cast<float>(x), static_cast<float>(y));
      mesh.positions.push_back({at, 0.0f});
      mesh.uvs.push_back(at / glm::vec2(static_cast<float>(columns), static_cast<float>(rows)));
    }
  }
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      const std::uint32_t a = y * (columns + 1) + x;
      const std::uint32_t c = a + columns + 2;
      for (const std::uint32_t index : {a, a + 1, c, a, c, c - 1}) {
        mesh.indices.push_back(index);
      }
    }
  }
  mesh.triangle_materials.assign(mesh.indices.size() / 3, 0);
  return mesh;
}

/// An axis-aligned box of 8 vertices and 12 triangles that face outward.
inline Mesh box(glm::vec3 low, glm::vec3 high) {
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({(i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z});
  }
  return mesh_of(corners, {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                           2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5});
}

/// Front faces on the other side.
inline Mesh inside_out(Mesh mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  }
  return mesh;
}

/// A tube about z of radius 1 and height 2, open at both ends, facing outward.
inline Mesh tube(std::uint32_t sides) {
  Mesh mesh(heap());
  for (const float z : {0.0f, 2.0f}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      mesh.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), z});
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    for (const std::uint32_t index : {i, next, sides + next, i, sides + next, sides + i}) {
      mesh.indices.push_back(index);
    }
  }
  mesh.triangle_materials.assign(mesh.indices.size() / 3, 0);
  return mesh;
}

/// The same closed by two fans.
inline Mesh cylinder(std::uint32_t sides) {
  Mesh mesh = tube(sides);
  mesh.positions.push_back({0, 0, 0});
  mesh.positions.push_back({0, 0, 2});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    for (const std::uint32_t index : {2 * sides, next, i, 2 * sides + 1, sides + i, sides + next}) {
      mesh.indices.push_back(index);
    }
  }
  mesh.triangle_materials.assign(mesh.indices.size() / 3, 0);
  return mesh;
}

using Light = std::function<Color(const Vec3& position, const Vec3& normal)>;

/// A scene's surface and the light on it. Its parts refer to each other, so it stays where it was made.
class LitScene {
 public:
  LitScene(std::vector<Mesh> meshes, double patch_spacing, std::vector<Material> materials = {Material{}})
      : made_(assemble(std::move(meshes), materials), 2, Log(&LitScene::keep, &messages)),
        surface_(made_.scene, made_.welded, with_contacts(options(patch_spacing)), options(patch_spacing), made_.host),
        direct_(surface_.samples().size(), Color(0.0)),
        indirect_(direct_) {}
  LitScene(const LitScene&) = delete;
  LitScene& operator=(const LitScene&) = delete;

  /// Direct light by a function of the sample.
  LitScene& shine_samples(const std::function<Color(const Sample&)>& light) {
    std::ranges::transform(surface_.samples(), direct_.begin(), light);
    return *this;
  }

  /// Direct light by a function of the site.
  LitScene& shine(const Light& light) {
    return shine_samples(
        [&](const Sample& sample) { return light(surface_.sites()[sample.site].position, sample.normal); });
  }

  LitScene& shine_indirectly(const Light& light) {
    direct_.swap(indirect_);
    shine(light);
    direct_.swap(indirect_);
    return *this;
  }

  LitSurface lit() { return {surface_, direct_, indirect_, made_.host}; }
  const Scene& scene() const { return made_.scene; }
  const WeldedScene& welded() const { return made_.welded; }
  const Facets& facets() const { return made_.facets; }
  const Surface& surface() const { return surface_; }
  Host& host() { return made_.host; }

  std::vector<std::string> messages;  ///< what was logged

 private:
  static void keep(void* user, std::int32_t, const char* text) {
    static_cast<std::vector<std::string>*>(user)->emplace_back(text);
  }

  static Scene assemble(std::vector<Mesh> meshes, const std::vector<Material>& materials) {
    Scene scene(heap());
    scene.materials.assign(materials.begin(), materials.end());
    for (Mesh& mesh : meshes) {
      scene.meshes.push_back(std::move(mesh));
    }
    return scene;
  }

  const Facets& with_contacts(const SurfaceOptions& options) {
    made_.add_contacts(ContactLimits::at_spacing(finest_spacing(options)));
    return made_.facets;
  }

  static SurfaceOptions options(double patch_spacing) {
    SurfaceOptions options;
    options.patch_spacing = patch_spacing;
    options.element_levels = 0;
    options.min_spacing = patch_spacing / 4;
    return options;
  }

  test::MadeFacets made_;
  Surface surface_;
  std::vector<Color> direct_, indirect_;
};

}  // namespace radvor::output_test
