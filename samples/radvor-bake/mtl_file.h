// Wavefront MTL materials: Kd is the albedo, Ke the emitted radiance; the rest does not concern diffuse light.
#pragma once

#include <string>
#include <vector>

#include "scene_data.h"
#include "warnings.h"

namespace bake {

/// Appends the materials of the file. Throws Failure (input) with file and line where a colour is no colour;
/// values outside 0..1 (albedo) or below 0 (emission) are clamped with a warning.
void load_mtl(const std::string& file, std::vector<MaterialData>& materials, Warnings& warnings);

}  // namespace bake
