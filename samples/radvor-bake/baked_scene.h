// The scene inside radvor, its bake, and what comes out: handles with owners, results as exceptions.
#pragma once

#include <radvor.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "options.h"
#include "point_files.h"
#include "scene_data.h"

namespace bake {

/// The adaptive mesh of an input mesh; the pointers live as long as the BakedScene.
struct BakedMesh {
  const MeshData* source;
  radvor_output_mesh mesh;
};

class BakedScene {
 public:
  using Log = void (*)(void* user, std::int32_t level, const char* words);
  using Progress = std::int32_t (*)(void* user, const radvor_progress* progress);

  /// Keeps references to scene. Throws Failure (bake) with radvor's reason, as every function here.
  BakedScene(const SceneData& scene, const Options& options, Log log, void* log_user);

  /// RADVOR_OK, RADVOR_CANCELLED or RADVOR_TIME_SPENT: there are results after each.
  radvor_result run(Progress progress, void* progress_user);

  /// The same in slices: all geometry, still dark; then as many seconds of light at a time.
  radvor_result create();
  radvor_result advance(double seconds);

  std::vector<BakedMesh> meshes();
  radvor_stats stats() const;

  /// The value at each vertex of all meshes, 3 floats a vertex.
  std::vector<float> vertices(std::uint32_t quantity) const;

  /// rgb: 3 a point; found: 1 a point.
  void measure(const Points& points, std::uint32_t quantity, double max_distance, std::vector<float>& rgb,
               std::vector<std::uint8_t>& found) const;

 private:
  void add_materials();
  void add_mesh(const MeshData& mesh);
  void check(radvor_result result, const std::string& what) const;

  template <auto destroy>
  struct Destroy {
    template <class Handle>
    void operator()(Handle* handle) const noexcept {
      destroy(handle);
    }
  };

  const SceneData& data_;
  radvor_bake_options options_;
  std::unique_ptr<radvor_context, Destroy<radvor_context_destroy>> context_;
  std::unique_ptr<radvor_scene, Destroy<radvor_scene_destroy>> scene_;
  std::unique_ptr<radvor_solution, Destroy<radvor_solution_destroy>> solution_;
};

}  // namespace bake
