#include "ply_file.h"

#include <array>
#include <bit>
#include <cstring>

#include "failure.h"
#include "output_file.h"

namespace bake {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as the machine has the numbers");

void write_header(OutputFile& out, std::size_t vertices, std::size_t faces) {
  out.text("ply\nformat binary_little_endian 1.0\ncomment radvor-bake: irradiance W m^-2, radiance W sr^-1 m^-2\n");
  out.text("element vertex " + std::to_string(vertices) + "\n");
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "irradiance_r", "irradiance_g", "irradiance_b",
                           "radiance_r", "radiance_g", "radiance_b"}) {
    out.text("property float " + std::string(name) + "\n");
  }
  out.text("element face " + std::to_string(faces) +
           "\nproperty list uchar uint vertex_indices\nproperty uint material\nproperty uint mesh\nend_header\n");
}

}  // namespace

void save_ply(const std::string& file, const std::vector<BakedMesh>& meshes) {
  std::size_t vertices = 0;
  std::size_t faces = 0;
  for (const BakedMesh& baked : meshes) {
    vertices += baked.mesh.vertex_count;
    faces += baked.mesh.triangle_count;
  }
  if (vertices > UINT32_MAX) {
    throw Failure(ExitCode::output, file + ": more vertices than 32-bit indices reach");
  }
  OutputFile out(file);
  write_header(out, vertices, faces);
  for (const BakedMesh& baked : meshes) {
    const radvor_output_mesh& mesh = baked.mesh;
    for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
      std::array<float, 12> row{};
      const float* columns[] = {mesh.positions, mesh.normals, mesh.irradiance, mesh.radiance};
      for (std::size_t c = 0; c < row.size(); ++c) {
        row[c] = columns[c / 3][3 * v + c % 3];
      }
      out.bytes(row.data(), sizeof row);
    }
  }
  std::uint32_t first = 0;
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const radvor_output_mesh& mesh = meshes[m].mesh;
    for (std::size_t t = 0; t < mesh.triangle_count; ++t) {
      const std::uint8_t corners = 3;
      const std::array<std::uint32_t, 5> row{first + mesh.indices[3 * t], first + mesh.indices[3 * t + 1],
                                             first + mesh.indices[3 * t + 2], mesh.materials[t],
                                             static_cast<std::uint32_t>(m)};
      out.bytes(&corners, 1);
      out.bytes(row.data(), sizeof row);
    }
    first += mesh.vertex_count;
  }
  out.close();
}

}  // namespace bake
