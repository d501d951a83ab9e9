// The mesh that radvor makes of a scene, before any light, as OBJ and MTL: so that another baker gets the same
// receivers.
#include <cstdio>

#include "baked_scene.h"
#include "failure.h"
#include "modes.h"
#include "output_file.h"
#include "scene_source.h"

namespace bench {
namespace {

void write_numbers(bake::OutputFile& out, const char* keyword, const float* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    out.text(keyword);
    for (std::size_t c = 0; c < 3; ++c) {
      out.text(" ");
      out.number(values[3 * i + c]);
    }
    out.text("\n");
  }
}

void write_color(bake::OutputFile& out, const char* keyword, const glm::vec3& color) {
  write_numbers(out, keyword, &color.x, 1);
}

}  // namespace

int mesh_mode(int argc, const char* const* argv) {
  const std::optional<bake::Options> options = bake::parse_options(argc, argv);
  if (!options) {
    return 0;
  }
  const bake::SceneData scene = load_scene(options->scene);
  bake::BakedScene baked(scene, *options, nullptr, nullptr);
  baked.create();
  // --stats names the file: there are no statistics of a bake that wasn't.
  bake::OutputFile out(options->stats);
  bake::OutputFile materials(options->stats + ".mtl");
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    materials.text("newmtl " + std::to_string(i) + "\n");
    write_color(materials, "Kd", scene.materials[i].albedo);
    write_color(materials, "Ke", scene.materials[i].emission);
  }
  materials.close();
  std::size_t first = 1;
  std::size_t triangles = 0;
  for (const bake::BakedMesh& mesh : baked.meshes()) {
    write_numbers(out, "v", mesh.mesh.positions, mesh.mesh.vertex_count);
    write_numbers(out, "vn", mesh.mesh.normals, mesh.mesh.vertex_count);
    for (std::size_t t = 0; t < mesh.mesh.triangle_count; ++t) {
      out.text("usemtl " + std::to_string(mesh.mesh.materials[t]) + "\nf");
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::string index = std::to_string(first + mesh.mesh.indices[3 * t + corner]);
        out.text(" " + index + "//" + index);
      }
      out.text("\n");
    }
    first += mesh.mesh.vertex_count;
    triangles += mesh.mesh.triangle_count;
  }
  out.close();
  std::printf("{\"vertices\": %zu, \"triangles\": %zu}\n", first - 1, triangles);
  return 0;
}

}  // namespace bench
