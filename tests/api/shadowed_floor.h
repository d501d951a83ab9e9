// A bake whose light is known in closed form and cannot be right unless rays are blocked where they should be.
#pragma once

#include <gtest/gtest.h>
#include <radvor.h>

#include <cmath>
#include <vector>

#include "api/engine.h"
#include "api/light_of.h"
#include "api/room.h"

namespace radvor::test {

/// Configuration factor from a point to a rectangle of w by h at distance 1, parallel, one corner above the point.
inline double corner_factor(double w, double h) {
  const double x = std::hypot(1, w), y = std::hypot(1, h);
  return (w / x * std::atan(h / x) + h / y * std::atan(w / y)) / (2 * M_PI);
}

/// FloorAndLamp with a square of 0.4 by 0.4 in between, 0.2 above the floor: it hides the whole lamp from the floor's
/// centre and nothing of it from the floor's corners.
inline LightOf bake_shadowed_floor(const Engine& engine) {
  const SceneOf scene(engine);
  FloorAndLamp room;
  room.positions.insert(room.positions.end(), {0.3f, 0.2f, 0.3f, 0.7f, 0.2f, 0.3f, 0.7f, 0.2f, 0.7f, 0.3f, 0.2f, 0.7f});
  room.indices.insert(room.indices.end(), {8, 9, 10, 8, 10, 11});
  room.materials.insert(room.materials.end(), {0, 0});
  scene.add(room.desc());
  radvor_bake_options options = coarse();
  options.min_spacing = 0.1f;
  radvor_solution* solution = nullptr;
  EXPECT_EQ(radvor_bake(scene, &options, &solution), RADVOR_OK) << engine.error();
  const LightOf light = read_light(solution, 12);
  float direct[3] = {-1, -1, -1};
  const double centre[] = {0.5, 0, 0.5};
  const float up[] = {0, 1, 0};
  std::uint8_t found = 0;
  EXPECT_EQ(radvor_solution_points(solution, RADVOR_IRRADIANCE_DIRECT, 1, centre, up, 0.01, direct, &found), RADVOR_OK);
  EXPECT_EQ(found, 1);
  EXPECT_EQ(direct[0], 0) << "the lamp is hidden from the centre";
  const double factor = corner_factor(0.75, 0.75) - 2 * corner_factor(0.75, 0.25) + corner_factor(0.25, 0.25);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const double expected = 4 * M_PI * factor;
    EXPECT_NEAR(light.vertices[RADVOR_IRRADIANCE_DIRECT][3 * corner], expected, 0.02 * expected);
  }
  radvor_solution_destroy(solution);
  return light;
}

}  // namespace radvor::test
