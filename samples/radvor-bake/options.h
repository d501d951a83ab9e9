// What the command line asks for.
#pragma once

#include <radvor.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "camera.h"

namespace bake {

struct Options {
  std::string scene;
  std::string output;  ///< .glb or .ply, or none
  std::string points;  ///< both or none
  std::string points_out;
  std::string stats;
  std::string preview;
  bool wireframe = false;
  bool quiet = false;
  std::optional<Camera> camera;
  std::uint32_t quantity = RADVOR_IRRADIANCE;
  std::vector<radvor_light_desc> lights;
  std::uint32_t threads = 0;
  std::string embree;
  radvor_bake_options bake{};  ///< progress is left empty
};

/// Names of the bits and enums, as the command line and the stats spell them.
struct Named {
  const char* name;
  std::uint32_t value;
};
extern const std::vector<Named> k_disable_names;
extern const std::vector<Named> k_lattice_names;
extern const std::vector<Named> k_quantity_names;

/// Nothing where --help or --version was asked for and answered (on standard output). Throws Failure: usage where
/// the words make no sense, input where --lights names a wrong file.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace bake
