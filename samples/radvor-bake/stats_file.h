// What a bake cost and did, as JSON for scripts and as a few lines for people.
#pragma once

#include <radvor.h>

#include <string>

#include "options.h"
#include "scene_data.h"

namespace bake {

struct Run {
  radvor_result result = RADVOR_OK;
  radvor_stats stats{};
  double seconds = 0;  ///< of the bake alone
  std::uint32_t threads = 0;
};

/// Every field of radvor_stats under its own name; under "options" the options used, null where the library chooses.
std::string stats_json(const Run& run, const Options& options, const SceneData& scene);

/// Several lines, each with its end.
std::string summary(const Run& run, const SceneData& scene);

}  // namespace bake
