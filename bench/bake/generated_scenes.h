// Scenes that are made here; scene_source.h says how they are named.
#pragma once

#include <cstddef>

#include "scene_data.h"

namespace bench {

/// Fewest triangles: one block. Sun and sky are given beside it.
bake::SceneData generated_city(std::size_t triangles);

/// lamps and cells: along each side, at least 1.
bake::SceneData generated_hall(std::size_t lamps, std::size_t cells);

/// Each triangle of a scene in four of its shape.
bake::SceneData quartered(const bake::SceneData& scene);

}  // namespace bench
