// Closed bodies as an engine would give them, placed, and lit by one lamp.
#pragma once

#include <gtest/gtest.h>
#include <radvor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "api/engine.h"
#include "api/room.h"

namespace radvor::test {

/// One mesh of its own; polygons run counter-clockwise seen from their front.
struct Solid {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;

  void polygon(const std::vector<glm::vec3>& corners) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), corners.begin(), corners.end());
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
      indices.insert(indices.end(), {first, first + i - 1, first + i});
    }
  }

  /// A polygon in the plane z = 0, counter-clockwise, drawn out to z = depth; fronts face outwards, or inwards. The
  /// caps are fans from the first corner.
  static Solid prism(const std::vector<glm::vec3>& outline, float depth, bool inwards) {
    Solid solid;
    const auto turned = [](std::vector<glm::vec3> corners) {  // the other way round, from the same first corner
      std::ranges::reverse(corners);
      std::rotate(corners.begin(), corners.end() - 1, corners.end());
      return corners;
    };
    const auto add = [&](const std::vector<glm::vec3>& corners) { solid.polygon(inwards ? turned(corners) : corners); };
    std::vector<glm::vec3> top = outline;
    for (glm::vec3& corner : top) {
      corner.z += depth;
    }
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const std::size_t next = (i + 1) % outline.size();
      add({outline[i], outline[next], top[next], top[i]});
    }
    add(top);
    add(turned(outline));
    return solid;
  }

  static Solid box(const glm::vec3& low, const glm::vec3& high, bool inwards) {
    return prism({{low.x, low.y, low.z}, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z}},
                 high.z - low.z, inwards);
  }

  /// The same triangles and vertices in another order.
  void shuffle(std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> place(positions.size()), order(indices.size() / 3);
    for (std::uint32_t i = 0; i < place.size(); ++i) {
      place[i] = i;
    }
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      order[i] = i;
    }
    std::shuffle(place.begin(), place.end(), random);
    std::shuffle(order.begin(), order.end(), random);
    const Solid old = *this;
    for (std::size_t i = 0; i < place.size(); ++i) {
      positions[place[i]] = old.positions[i];
    }
    for (std::size_t t = 0; t < order.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        indices[3 * t + k] = place[old.indices[3 * std::size_t{order[t]} + (k + t) % 3]];
      }
    }
  }
};

using Transform34 = std::array<double, 12>;
inline constexpr Transform34 k_in_place = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

inline glm::dvec3 moved(const Transform34& t, const glm::dvec3& p) {
  return {t[0] * p.x + t[1] * p.y + t[2] * p.z + t[3], t[4] * p.x + t[5] * p.y + t[6] * p.z + t[7],
          t[8] * p.x + t[9] * p.y + t[10] * p.z + t[11]};
}

/// Bakes the solids with albedo 0.5 and a luminous sphere of that radius; all lengths in the space before `transform`,
/// whose columns have length `scale`. The solution is the caller's.
inline radvor_solution* bake_solids(const Engine& engine, const std::vector<Solid>& solids, const glm::dvec3& lamp,
                                    radvor_bake_options options, const Transform34& transform = k_in_place,
                                    double scale = 1) {
  const SceneOf scene(engine);
  for (const Solid& solid : solids) {
    radvor_mesh_desc desc{};
    desc.struct_size = sizeof desc;
    desc.vertex_count = static_cast<std::uint32_t>(solid.positions.size());
    desc.triangle_count = static_cast<std::uint32_t>(solid.indices.size() / 3);
    desc.positions = &solid.positions[0].x;
    desc.indices = solid.indices.data();
    desc.transform = transform.data();
    scene.add(desc);
  }
  radvor_light_desc light{};
  light.struct_size = sizeof light;
  light.type = RADVOR_LIGHT_POINT;
  const glm::dvec3 at = moved(transform, lamp);
  light.position[0] = at.x;
  light.position[1] = at.y;
  light.position[2] = at.z;
  std::fill(std::begin(light.color), std::end(light.color), static_cast<float>(scale * scale));
  light.radius = static_cast<float>(0.05 * scale);
  std::uint32_t id = 0;
  EXPECT_EQ(radvor_scene_add_light(scene, &light, &id), RADVOR_OK) << engine.error();
  options.patch_spacing *= static_cast<float>(scale);
  options.min_spacing *= static_cast<float>(scale);
  radvor_solution* solution = nullptr;
  EXPECT_EQ(radvor_bake(scene, &options, &solution), RADVOR_OK) << engine.error();
  return solution;
}

}  // namespace radvor::test
