// Random points on a scene's surface, uniform by area, for scenes that came without a reference; and its size.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "low_discrepancy.h"
#include "modes.h"
#include "output_file.h"
#include "scene_source.h"

namespace bench {
namespace {

struct Triangle {
  glm::dvec3 a, b, c;
  glm::vec3 normals[3];
  bool emits;
};

/// Triangles with area.
std::vector<Triangle> triangles_of(const bake::SceneData& scene) {
  std::vector<Triangle> triangles;
  for (const bake::MeshData& mesh : scene.meshes) {
    for (std::size_t t = 0; t < mesh.triangle_materials.size(); ++t) {
      const std::uint32_t* i = &mesh.indices[3 * t];
      Triangle triangle{mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]], {}, false};
      const glm::dvec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
      if (!(glm::length(normal) > 0)) {
        continue;
      }
      for (std::size_t corner = 0; corner < 3; ++corner) {
        triangle.normals[corner] = mesh.normals.empty() ? glm::vec3(glm::normalize(normal)) : mesh.normals[i[corner]];
      }
      triangle.emits = scene.materials[mesh.triangle_materials[t]].emission != glm::vec3(0);
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

double area(const Triangle& t) {
  return 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
}

}  // namespace

int points_mode(const std::string& name, std::uint32_t count, const std::string& file) {
  // Emitters are left out, as those of ../shared/scenes do.
  std::vector<Triangle> triangles = triangles_of(load_scene(name));
  std::erase_if(triangles, [](const Triangle& triangle) { return triangle.emits; });
  std::vector<double> sums;
  double sum = 0;
  for (const Triangle& triangle : triangles) {
    sums.push_back(sum += area(triangle));
  }
  bake::OutputFile out(file);
  out.text("x,y,z,nx,ny,nz\n");
  for (std::uint32_t i = 0; i < count; ++i) {
    const double at = (i + static_cast<double>(unit(mixed(i, 11)))) / count * sum;
    const auto found = std::upper_bound(sums.begin(), sums.end() - 1, at) - sums.begin();
    const Triangle& t = triangles[static_cast<std::size_t>(found)];
    const float root = std::sqrt(unit(mixed(i, 12)));
    const float v = root * unit(mixed(i, 13));
    const glm::vec3 weights(1 - root, root - v, v);
    const glm::dvec3 position = glm::dvec3(weights).x * t.a + glm::dvec3(weights).y * t.b + glm::dvec3(weights).z * t.c;
    const glm::vec3 normal =
        glm::normalize(weights.x * t.normals[0] + weights.y * t.normals[1] + weights.z * t.normals[2]);
    char line[256];
    std::snprintf(line, sizeof line, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", position.x, position.y, position.z,
                  static_cast<double>(normal.x), static_cast<double>(normal.y), static_cast<double>(normal.z));
    out.text(line);
  }
  out.close();
  return 0;
}

int describe_mode(const std::string& name) {
  const bake::SceneData scene = load_scene(name);
  double sum = 0;
  for (const Triangle& triangle : triangles_of(scene)) {
    sum += area(triangle);
  }
  const bake::Bounds box = bake::bounds_of(scene);
  std::printf("{\"triangles\": %zu, \"area\": %.9g, \"diagonal\": %.9g}\n", scene.triangle_count(), sum,
              glm::length(box.high - box.low));
  return 0;
}

}  // namespace bench
