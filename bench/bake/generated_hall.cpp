// A hall whose lamps and triangles can be multiplied without changing its light: LAMPS x LAMPS lamps of the same area
// in all hang over a floor of CELLS x CELLS slabs, each at a height of its own so that no two are one facet.
#include "generated_scenes.h"
#include "low_discrepancy.h"
#include "mesh_writer.h"

namespace bench {
namespace {

constexpr float k_side = 20, k_height = 6, k_lamp_height = 5.5f;
constexpr float k_lamps_side = 2;      // of a square of the area of all lamps
constexpr float k_unevenness = 0.02f;  // of the slabs
constexpr std::uint32_t k_plaster = 0, k_slab = 1, k_lamp = 2;

void add_room(MeshWriter& mesh) {
  const glm::vec3 x(k_side, 0, 0), z(0, 0, k_side), up(0, k_height, 0);
  const glm::vec3 low(0, -k_unevenness, 0), walls = up - low;
  mesh.rectangle(up, x, z, k_plaster);
  mesh.rectangle(low, x, walls, k_plaster);
  mesh.rectangle(low + x, z, walls, k_plaster);
  mesh.rectangle(low + x + z, -x, walls, k_plaster);
  mesh.rectangle(low + z, -z, walls, k_plaster);
}

void add_pillar(MeshWriter& mesh, const glm::vec3& foot) {
  const glm::vec3 x(0.8f, 0, 0), z(0, 0, 0.8f), up(0, k_height + k_unevenness, 0);
  mesh.rectangle(foot + x, -x, up, k_plaster);
  mesh.rectangle(foot, z, up, k_plaster);
  mesh.rectangle(foot + z, x, up, k_plaster);
  mesh.rectangle(foot + z + x, -z, up, k_plaster);
}

}  // namespace

bake::SceneData generated_hall(std::size_t lamps, std::size_t cells) {
  bake::SceneData scene;
  scene.materials.push_back({"plaster", glm::vec3(0.7f), glm::vec3(0)});
  scene.materials.push_back({"slab", glm::vec3(0.4f, 0.35f, 0.3f), glm::vec3(0)});
  scene.materials.push_back({"lamp", glm::vec3(0), glm::vec3(20, 18, 15)});
  MeshWriter room("room");
  add_room(room);
  for (const float x : {5.0f, 14.2f}) {
    for (const float z : {5.0f, 14.2f}) {
      add_pillar(room, {x, -k_unevenness, z});
    }
  }
  scene.meshes.push_back(room.take());

  MeshWriter floor("floor");
  const float cell = k_side / static_cast<float>(cells);
  for (std::size_t row = 0; row < cells; ++row) {
    for (std::size_t column = 0; column < cells; ++column) {
      const std::uint32_t random = mixed(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column));
      const glm::vec3 corner(cell * static_cast<float>(column), -k_unevenness * unit(random),
                             cell * static_cast<float>(row));
      floor.rectangle(corner, {0, 0, cell}, {cell, 0, 0}, k_slab);
    }
  }
  scene.meshes.push_back(floor.take());

  MeshWriter lights("lamps");
  const float pitch = k_side / static_cast<float>(lamps);
  const float lamp = k_lamps_side / static_cast<float>(lamps);
  for (std::size_t row = 0; row < lamps; ++row) {
    for (std::size_t column = 0; column < lamps; ++column) {
      const glm::vec3 corner(pitch * (static_cast<float>(column) + 0.5f) - lamp / 2, k_lamp_height,
                             pitch * (static_cast<float>(row) + 0.5f) - lamp / 2);
      lights.rectangle(corner, {lamp, 0, 0}, {0, 0, lamp}, k_lamp);
    }
  }
  scene.meshes.push_back(lights.take());
  return scene;
}

}  // namespace bench
