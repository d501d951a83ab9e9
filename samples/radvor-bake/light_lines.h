// Lights in words, as --light and the files of --lights say them:
//
//   sky R G B                        radiance of the whole environment
//   sun DX DY DZ R G B [ANGLE]       the way the light travels; irradiance on a facing surface; angular diameter,
//   radians point X Y Z R G B [RADIUS]       radiant intensity; radius of the luminous sphere
//
// Files may have comments (#) and empty lines.
#pragma once

#include <radvor.h>

#include <string>
#include <string_view>
#include <vector>

namespace bake {

/// Throws Failure (usage), its words without a place.
radvor_light_desc parse_light(std::string_view words);

/// Throws Failure (input) with file and line.
std::vector<radvor_light_desc> load_lights(const std::string& file);

}  // namespace bake
