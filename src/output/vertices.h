// Light at the engine's own vertices, in its own order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "output/quantity.h"

namespace radvor {

enum class VertexMode : std::uint32_t {
  sample = 0,  ///< the value at the vertex: mean of the samples that meet there, weighted by the triangles' angles
  fit = 1      ///< least squares over the surface: best once interpolated over the engine's triangles
};

/// Writes 3 floats for each vertex of a mesh, `stride` bytes apart. back: of two-sided surfaces (0 elsewhere). Vertices
/// that no kept triangle uses take the light at their position where another triangle of the mesh has it, else 0.
void write_vertices(const LitSurface& lit, std::uint32_t mesh, Quantity quantity, bool back, VertexMode mode,
                    float* rgb, std::size_t stride);

}  // namespace radvor
