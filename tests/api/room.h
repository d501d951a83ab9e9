// Small scenes for the tests of the C ABI, as arrays that an engine would have.
#pragma once

#include <gtest/gtest.h>
#include <radvor.h>

#include <cstdint>
#include <vector>

#include "api/engine.h"

namespace radvor::test {

inline radvor_material_desc gray(float albedo, float emission = 0) {
  radvor_material_desc desc{};
  desc.struct_size = sizeof desc;
  for (int channel = 0; channel < 3; ++channel) {
    desc.albedo[channel] = albedo;
    desc.emission[channel] = emission;
  }
  return desc;
}

/// A floor of 1 by 1 at y = 0, facing up, and a smaller square lamp above it, facing down.
struct FloorAndLamp {
  std::vector<float> positions = {0,     0, 0,     0,     0, 1,     1,     0, 1,     1,     0, 0,
                                  0.25f, 1, 0.25f, 0.75f, 1, 0.25f, 0.75f, 1, 0.75f, 0.25f, 1, 0.75f};
  std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  std::vector<std::uint32_t> materials = {0, 0, 1, 1};

  radvor_mesh_desc desc() const {
    radvor_mesh_desc desc{};
    desc.struct_size = sizeof desc;
    desc.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    desc.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
    desc.positions = positions.data();
    desc.indices = indices.data();
    desc.triangle_materials = materials.data();
    return desc;
  }
};

/// A scene with the materials 0 (gray) and 1 (emits); nothing else yet.
class SceneOf {
 public:
  explicit SceneOf(const Engine& engine) {
    EXPECT_EQ(radvor_scene_create(engine.context(), &scene_), RADVOR_OK) << engine.error();
    const radvor_material_desc materials[] = {gray(0.5f), gray(0.5f, 4)};
    for (std::uint32_t i = 0; i < 2; ++i) {
      std::uint32_t id = RADVOR_NONE;
      EXPECT_EQ(radvor_scene_add_material(scene_, &materials[i], &id), RADVOR_OK) << engine.error();
      EXPECT_EQ(id, i);
    }
  }
  ~SceneOf() { radvor_scene_destroy(scene_); }
  SceneOf(const SceneOf&) = delete;
  SceneOf& operator=(const SceneOf&) = delete;

  operator radvor_scene*() const { return scene_; }  // NOLINT(google-explicit-constructor)

  std::uint32_t add(const radvor_mesh_desc& desc) const {
    std::uint32_t id = RADVOR_NONE;
    EXPECT_EQ(radvor_scene_add_mesh(scene_, &desc, &id), RADVOR_OK);
    return id;
  }

 private:
  radvor_scene* scene_ = nullptr;
};

/// Options for a bake of a few milliseconds.
inline radvor_bake_options coarse() {
  radvor_bake_options options{};
  options.struct_size = sizeof options;
  options.tolerance = 0.2f;
  options.patch_spacing = 0.5f;
  options.min_spacing = 0.2f;
  options.element_levels = 1;
  return options;
}

/// The mesh is refined more than once.
inline radvor_bake_options refined() {
  radvor_bake_options options = coarse();
  options.tolerance = 0.03f;
  options.min_spacing = 0.03f;
  return options;
}

}  // namespace radvor::test
