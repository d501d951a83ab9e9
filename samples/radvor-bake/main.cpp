// radvor-bake: an OBJ scene in, its light out. See docs/radvor-bake.md.
#include <chrono>
#include <cstdio>
#include <exception>
#include <glm/geometric.hpp>
#include <new>

#include "baked_scene.h"
#include "failure.h"
#include "gltf_file.h"
#include "obj_file.h"
#include "options.h"
#include "output_file.h"
#include "ply_file.h"
#include "preview.h"
#include "progress.h"
#include "stats_file.h"

namespace bake {
namespace {

/// Points lie on the surface as exactly as their files say; this much of the scene's diagonal is for their rounding
/// and for faces that are not planar. The nearest surface counts, so that more would do no harm in the open.
constexpr double k_point_distance = 1e-3;

void log_to_stderr(void* user, std::int32_t level, const char* words) {
  const bool quiet = *static_cast<const bool*>(user);
  if (level == RADVOR_LOG_ERROR || (level == RADVOR_LOG_WARNING && !quiet)) {
    std::fprintf(stderr, "radvor-bake: %s: %s\n", level == RADVOR_LOG_ERROR ? "error" : "warning", words);
  }
}

void print(const Warnings& warnings) {
  for (const std::string& words : warnings.words()) {
    std::fprintf(stderr, "%s (warning)\n", words.c_str());
  }
  if (warnings.count() > warnings.words().size()) {
    std::fprintf(stderr, "and %zu more warnings\n", warnings.count() - warnings.words().size());
  }
}

void write_meshes(const Options& options, const SceneData& scene, BakedScene& baked) {
  if (options.output.empty() && options.preview.empty()) {
    return;
  }
  const std::vector<BakedMesh> meshes = baked.meshes();
  if (options.output.ends_with(".glb")) {
    save_glb(options.output, scene, meshes);
  } else if (!options.output.empty()) {
    save_ply(options.output, meshes);
  }
  if (!options.preview.empty()) {
    std::vector<DrawnMesh> drawn;
    drawn.reserve(meshes.size());
    for (const BakedMesh& mesh : meshes) {
      drawn.push_back({mesh.mesh.positions, mesh.mesh.radiance, mesh.mesh.indices, mesh.mesh.triangle_count});
    }
    const double aspect = static_cast<double>(k_preview_width) / static_cast<double>(k_preview_height);
    const Camera camera = options.camera ? *options.camera : find_camera(scene, aspect);
    save_png(options.preview, draw_preview(drawn, camera, k_preview_width, k_preview_height, options.wireframe));
  }
}

void write_points(const Options& options, const Points& points, const SceneData& scene, const BakedScene& baked) {
  const Bounds box = bounds_of(scene);
  std::vector<float> rgb;
  std::vector<std::uint8_t> found;
  baked.measure(points, options.quantity, k_point_distance * glm::length(box.high - box.low), rgb, found);
  save_values(options.points_out, rgb, found);
}

int run(int argc, const char* const* argv) {
  const std::optional<Options> parsed = parse_options(argc, argv);
  if (!parsed) {
    return static_cast<int>(ExitCode::done);
  }
  const Options& options = *parsed;
  // What can be known to be wrong is said before the bake, not after.
  for (const std::string* file : {&options.output, &options.points_out, &options.stats, &options.preview}) {
    if (!file->empty()) {
      check_writable(*file);
    }
  }
  const Points points = options.points.empty() ? Points{} : load_points(options.points);
  Warnings warnings;
  const SceneData scene = load_obj(options.scene, warnings);
  if (!options.quiet) {
    print(warnings);
  }

  bool quiet = options.quiet;
  BakedScene baked(scene, options, log_to_stderr, &quiet);
  const StopSignals signals;
  ProgressLine line(options.quiet);
  Run done;
  const auto begin = std::chrono::steady_clock::now();
  done.result = baked.run(ProgressLine::call, &line);
  done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  line.clear();
  done.stats = baked.stats();
  if (!options.quiet) {
    std::fputs(summary(done, scene).c_str(), stdout);
  }

  write_meshes(options, scene, baked);
  if (!options.points.empty()) {
    write_points(options, points, scene, baked);
  }
  if (!options.stats.empty()) {
    OutputFile out(options.stats);
    out.text(stats_json(done, options, scene));
    out.close();
  }
  return done.result == RADVOR_CANCELLED ? 128 + StopSignals::caught() : static_cast<int>(ExitCode::done);
}

}  // namespace
}  // namespace bake

int main(int argc, char** argv) {
  try {
    return bake::run(argc, argv);
  } catch (const bake::Failure& failure) {
    std::fprintf(stderr, "radvor-bake: %s\n", failure.what());
    return static_cast<int>(failure.code());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "radvor-bake: out of memory\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "radvor-bake: %s\n", error.what());
  }
  return static_cast<int>(bake::ExitCode::bake);
}
