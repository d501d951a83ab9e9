// Scenes by name: files, and scenes that are made here, the same on every machine.
#pragma once

#include <string>

#include "scene_data.h"

namespace bench {

/// FILE.obj           as radvor-bake reads it, its warnings left unsaid
/// split:N:NAME       a scene, each triangle cut into 4^N of the same shape
/// city:TRIANGLES     a generated city of about so many triangles
/// hall:LAMPS:CELLS   a generated hall of LAMPS x LAMPS lamps of constant power in all; floor and ceiling are grids
///                    of CELLS x CELLS squares, no two of one height
/// Throws bake::Failure.
bake::SceneData load_scene(const std::string& name);

}  // namespace bench
