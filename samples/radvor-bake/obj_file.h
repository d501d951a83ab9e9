// Wavefront OBJ scenes as people have them: any polygons, relative indices, missing materials and files.
#pragma once

#include <string>

#include "scene_data.h"
#include "warnings.h"

namespace bake {

/// One mesh for each object and group of the file (faces with and without normals, and with and without UVs, apart),
/// with one vertex for each combination of position, normal and UV that its faces name. The first material is the
/// one for faces whose material or file is missing: albedo 0.5. Throws Failure (input) with file and line.
SceneData load_obj(const std::string& file, Warnings& warnings);

}  // namespace bake
