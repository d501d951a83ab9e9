// PLY, binary, little-endian: all meshes as one, with the light as floats, for tools that read columns.
#pragma once

#include <string>
#include <vector>

#include "baked_scene.h"

namespace bake {

/// A vertex: x y z, nx ny nz, irradiance_r _g _b (W m^-2), radiance_r _g _b (W sr^-1 m^-2). A face: vertex_indices,
/// material (of the scene), mesh. Throws Failure (output).
void save_ply(const std::string& file, const std::vector<BakedMesh>& meshes);

}  // namespace bake
