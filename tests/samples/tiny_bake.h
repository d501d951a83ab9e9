// A bake made up by hand: what the exporters and the preview are given, without baking.
#pragma once

#include <vector>

#include "baked_scene.h"

namespace bake::test {

/// Two meshes: a unit square at z = 0 of two materials, with UVs, and a triangle at z = 1 without.
class TinyBake {
 public:
  TinyBake() {
    scene.materials = {{"default", glm::vec3(0.5f), glm::vec3(0)}, {"lamp", glm::vec3(0.25f), glm::vec3(8, 4, 2)}};
    scene.meshes.resize(2);
    scene.meshes[0].name = "square";
    scene.meshes[1].name = "tri\xE4ngle";  // Latin-1, which is no UTF-8
    for (std::size_t m = 0; m < 2; ++m) {
      radvor_output_mesh& mesh = outputs_[m];
      mesh.struct_size = sizeof mesh;
      mesh.vertex_count = m == 0 ? 4 : 3;
      mesh.triangle_count = m == 0 ? 2 : 1;
      mesh.positions = m == 0 ? square_positions_.data() : triangle_positions_.data();
      mesh.normals = normals_.data();
      mesh.uvs = m == 0 ? uvs_.data() : nullptr;
      mesh.irradiance = irradiance_.data() + (m == 0 ? 0 : 12);
      mesh.radiance = radiance_.data();
      mesh.indices = indices_.data();
      mesh.materials = materials_.data();
    }
  }

  std::vector<BakedMesh> meshes() const { return {{&scene.meshes[0], outputs_[0]}, {&scene.meshes[1], outputs_[1]}}; }

  SceneData scene;

 private:
  radvor_output_mesh outputs_[2] = {};
  std::vector<float> square_positions_{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<float> triangle_positions_{0, 0, 1, 1, 0, 1, 1, 1, 1};
  std::vector<float> normals_{0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 1};
  std::vector<float> uvs_{0, 0, 1, 0, 1, 1, 0, 1};
  std::vector<float> irradiance_{1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 0, 0, 0, 10, 5, 1, 0, 0, 0};
  std::vector<float> radiance_{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  std::vector<std::uint32_t> indices_{0, 1, 2, 0, 2, 3};
  std::vector<std::uint32_t> materials_{1, 0};
};

}  // namespace bake::test
