// The experiment baked by radvor, through the public API alone.
#pragma once

#include <radvor.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "exact_shadow.h"

namespace paper {

/// Throws std::runtime_error with the context's words.
void check(radvor_result result, const radvor_context* context, const char* what);

template <auto destroy>
struct Destroy {
  template <class Handle>
  void operator()(Handle* handle) const noexcept {
    destroy(handle);
  }
};
using Context = std::unique_ptr<radvor_context, Destroy<radvor_context_destroy>>;
using Scene = std::unique_ptr<radvor_scene, Destroy<radvor_scene_destroy>>;
using Solution = std::unique_ptr<radvor_solution, Destroy<radvor_solution_destroy>>;
using Delaunay = std::unique_ptr<radvor_delaunay, Destroy<radvor_delaunay_destroy>>;

Context make_context();

/// The floor as it came out: what one would draw.
struct Floor {
  std::vector<glm::dvec2> sites;         ///< vertices at one place are one site
  std::vector<double> irradiance;        ///< 1 a site
  std::vector<std::uint32_t> triangles;  ///< 3 a triangle, counter-clockwise
};

class FloorBake {
 public:
  FloorBake(const Experiment& experiment, radvor_bake_options options);

  const Floor& floor() const { return floor_; }
  /// Irradiance at points, by interpolation in the baked mesh.
  std::vector<double> measure(const std::vector<glm::dvec2>& points) const;
  radvor_stats stats() const;

 private:
  void add_mesh(const std::vector<glm::vec3>& corners, std::uint32_t material, std::uint32_t flags);
  void read_floor();

  Context context_;
  Scene scene_;
  Solution solution_;
  Floor floor_;
};

}  // namespace paper
