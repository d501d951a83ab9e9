// glTF 2.0 binary (.glb): the adaptive mesh for engines and viewers.
//
// Materials are unlit (KHR_materials_unlit) and keep the albedo as base colour; COLOR_0 = irradiance / pi * scale, so
// that a viewer shows albedo * irradiance / pi. The scale, the same for the whole file, makes the brightest vertex 1;
// it is in the extras of the scene and of every mesh as "radvor_color_scale". The irradiance itself (W m^-2) is the
// attribute _RADVOR_IRRADIANCE. What lamps emit is in emissiveFactor (times KHR_materials_emissive_strength).
#pragma once

#include <string>
#include <vector>

#include "baked_scene.h"
#include "scene_data.h"

namespace bake {

/// meshes: of the scene. Throws Failure (output).
void save_glb(const std::string& file, const SceneData& scene, const std::vector<BakedMesh>& meshes);

}  // namespace bake
