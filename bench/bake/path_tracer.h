// Irradiance at points by path tracing (J. Kajiya, "The rendering equation", 1986), as well as one would write it
// today: light sampling at every vertex with multiple importance sampling, scrambled Sobol points, Russian roulette,
// and rays in packets: those of many paths of one receiver go through the scene together, depth by depth.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "light_sources.h"
#include "low_discrepancy.h"
#include "traced_scene.h"

namespace bench {

struct Receiver {
  glm::vec3 position;  ///< lifted off its surface
  glm::vec3 normal;
  std::uint32_t seed;
};

class PathTracer {
 public:
  /// most_bounces: 0: paths end where they first meet a surface.
  PathTracer(const TracedScene& scene, const LightSources& lights, std::uint32_t most_bounces);

  /// Sum of the estimates of the irradiance by the paths first ... first + count - 1.
  glm::dvec3 trace(const Receiver& receiver, std::uint32_t first, std::uint32_t count);

  /// What points and suns of no size give: the same for every path, so it is no part of trace.
  glm::dvec3 trace_sharp_lights(const Receiver& receiver);

 private:
  struct Path {
    glm::vec3 position, normal, throughput;
    std::uint32_t index;
    float light_u, light_v;  ///< for the light sample at this vertex
    float next_u, next_v;    ///< for the one at the next
  };

  void begin(const Receiver& receiver, std::uint32_t first, std::uint32_t count);
  void sample_lights(std::uint32_t seed, std::uint32_t depth);
  void sample_directions(std::uint32_t seed, std::uint32_t depth);
  void arrive(std::uint32_t seed, std::uint32_t depth);
  void add_light(const LightSample& sample, const glm::vec3& throughput);
  void flush_lights(bool coherent);

  const TracedScene& scene_;
  const LightSources& lights_;
  std::uint32_t most_bounces_;
  Sobol sobol_;
  std::vector<Path> paths_;
  std::vector<Ray> rays_, segments_;
  std::vector<TracedScene::Meeting> meetings_;
  std::vector<glm::vec3> on_the_way_;
  std::vector<std::uint8_t> blocked_;
  glm::dvec3 sum_{0.0};
};

}  // namespace bench
