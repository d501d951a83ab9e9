// What radvor_scene points to, and the snapshot of it that a bake keeps.
#pragma once

#include "api/entry.h"
#include "scene/scene.h"

struct radvor_scene {
  explicit radvor_scene(radvor_context* owner) : context(owner), scene(&owner->host.memory) {}

  radvor_context* context;
  radvor::Scene scene;
  std::size_t vertices = 0, triangles = 0;  ///< of all meshes
};

namespace radvor::api {

/// A copy in the same memory; the copy constructors of std::pmr would take it from the process's default.
Scene copy_scene(const Scene& scene, std::pmr::memory_resource* memory);

}  // namespace radvor::api
