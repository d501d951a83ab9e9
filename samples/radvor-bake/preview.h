// The picture of a bake: outgoing radiance, exposed and tone-mapped as a camera would, the mesh drawn over it on
// request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "camera.h"
#include "rasteriser.h"

namespace bake {

struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< sRGB, row by row from the top left
};

constexpr std::size_t k_preview_width = 960;
constexpr std::size_t k_preview_height = 720;

Picture draw_preview(const std::vector<DrawnMesh>& meshes, const Camera& camera, std::size_t width, std::size_t height,
                     bool wireframe);

/// Throws Failure (output).
void save_png(const std::string& file, const Picture& picture);

}  // namespace bake
