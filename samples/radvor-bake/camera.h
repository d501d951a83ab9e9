// Where a picture is taken from: given in words, or found so that it sees as much of the scene as one view can.
#pragma once

#include <glm/vec3.hpp>
#include <string_view>

#include "scene_data.h"

namespace bake {

struct Camera {
  glm::dvec3 eye{0, 0, 1};
  glm::dvec3 target{0};
  double field_of_view = 0.7;  ///< vertical, radians
};

/// "EX EY EZ TX TY TZ FOV", FOV in degrees. Throws Failure (usage).
Camera parse_camera(std::string_view words);

/// From outside, with back faces not drawn, so that one looks into a room through the walls nearest to the eye; of
/// many directions the one that sees the largest area of surface. Up is +y. aspect: width over height.
Camera find_camera(const SceneData& scene, double aspect);

}  // namespace bake
