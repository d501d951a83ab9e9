// A city: blocks of pavement between streets, a building on each, its windows set back into the walls. Walls with many
// holes, narrow courts of shade beside open streets, and as many triangles as asked for.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "generated_scenes.h"
#include "low_discrepancy.h"
#include "mesh_writer.h"

namespace bench {
namespace {

constexpr float k_cell = 3;         // a window's share of the wall, both ways
constexpr float k_block = 26;       // from street to street
constexpr float k_pavement = 19;    // side of a block's pavement
constexpr float k_kerb = 0.15f;     // its height
constexpr float k_setback = 0.25f;  // of a window
constexpr std::uint32_t k_street = 0, k_stone = 1, k_glass = 2, k_roof = 3, k_first_wall = 4, k_walls = 4;
constexpr double k_triangles_per_block = 2 * 9 * 4 * 5 * 8.5 + 14;  // a building of 5 by 5 cells and 8.5 floors

/// One cell of a wall: a frame of four quads, four reveals, the pane.
void add_window(MeshWriter& mesh, const glm::vec3& origin, const glm::vec3& right, const glm::vec3& up,
                std::uint32_t wall) {
  const glm::vec3 inwards = -k_setback * glm::normalize(glm::cross(right, up));
  const std::array<glm::vec3, 4> outer{origin, origin + right, origin + right + up, origin + up};
  const std::array<glm::vec3, 4> hole{origin + 0.25f * right + 0.2f * up, origin + 0.75f * right + 0.2f * up,
                                      origin + 0.75f * right + 0.8f * up, origin + 0.25f * right + 0.8f * up};
  std::array<glm::vec3, 4> pane = hole;
  for (glm::vec3& corner : pane) {
    corner += inwards;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    mesh.quad({outer[i], outer[next], hole[next], hole[i]}, wall);
    mesh.quad({hole[i], hole[next], pane[next], pane[i]}, wall);
  }
  mesh.quad(pane, k_glass);
}

void add_building(MeshWriter& mesh, const glm::vec3& corner, int cells, int floors, std::uint32_t wall) {
  const float side = k_cell * static_cast<float>(cells);
  const std::array<glm::vec3, 4> corners{corner, corner + glm::vec3(0, 0, side), corner + glm::vec3(side, 0, side),
                                         corner + glm::vec3(side, 0, 0)};
  for (std::size_t face = 0; face < 4; ++face) {
    const glm::vec3 right = (corners[(face + 1) % 4] - corners[face]) / static_cast<float>(cells);
    const glm::vec3 up(0, k_cell, 0);
    for (int floor = 0; floor < floors; ++floor) {
      for (int cell = 0; cell < cells; ++cell) {
        add_window(mesh, corners[face] + static_cast<float>(cell) * right + static_cast<float>(floor) * up, right, up,
                   wall);
      }
    }
  }
  const glm::vec3 top(0, k_cell * static_cast<float>(floors), 0);
  mesh.quad({corners[0] + top, corners[1] + top, corners[2] + top, corners[3] + top}, k_roof);
}

void add_pavement(MeshWriter& mesh, const glm::vec3& corner) {
  const glm::vec3 x(k_pavement, 0, 0), z(0, 0, k_pavement), up(0, k_kerb, 0);
  mesh.rectangle(corner + up, z, x, k_stone);
  mesh.rectangle(corner, z, up, k_stone);
  mesh.rectangle(corner + z, x, up, k_stone);
  mesh.rectangle(corner + z + x, -z, up, k_stone);
  mesh.rectangle(corner + x, -x, up, k_stone);
}

}  // namespace

bake::SceneData generated_city(std::size_t triangles) {
  bake::SceneData scene;
  const auto material = [&](const char* name, const glm::vec3& albedo) {
    scene.materials.push_back({name, albedo, glm::vec3(0)});
  };
  material("street", glm::vec3(0.12f));
  material("stone", glm::vec3(0.45f, 0.43f, 0.4f));
  material("glass", glm::vec3(0.08f, 0.1f, 0.12f));
  material("roof", glm::vec3(0.25f));
  material("brick", {0.5f, 0.25f, 0.18f});
  material("plaster", {0.75f, 0.7f, 0.6f});
  material("concrete", glm::vec3(0.5f));
  material("white", glm::vec3(0.8f));
  const int blocks =
      std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / k_triangles_per_block))));
  for (int row = 0; row < blocks; ++row) {
    for (int column = 0; column < blocks; ++column) {
      const std::uint32_t random = mixed(static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column));
      MeshWriter mesh("block " + std::to_string(row) + " " + std::to_string(column));
      const glm::vec3 corner(k_block * static_cast<float>(column), 0, k_block * static_cast<float>(row));
      mesh.rectangle(corner, {0, 0, k_block}, {k_block, 0, 0}, k_street);
      const float margin = 0.5f * (k_block - k_pavement);
      add_pavement(mesh, corner + glm::vec3(margin, 0, margin));
      const int cells = 4 + static_cast<int>(random % 3);
      const int floors = 3 + static_cast<int>((random >> 8) % 12);
      const float inset = 0.5f * (k_block - k_cell * static_cast<float>(cells));
      add_building(mesh, corner + glm::vec3(inset, k_kerb, inset), cells, floors,
                   k_first_wall + (random >> 16) % k_walls);
      scene.meshes.push_back(mesh.take());
    }
  }
  return scene;
}

}  // namespace bench
