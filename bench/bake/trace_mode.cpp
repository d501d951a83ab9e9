// The path tracer at given points: after each doubling of the samples a line of JSON, and a file of what was measured.
#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>

#include "failure.h"
#include "light_lines.h"
#include "modes.h"
#include "path_tracer.h"
#include "point_files.h"
#include "processor_time.h"
#include "scene_source.h"

namespace bench {
namespace {

constexpr std::uint32_t k_batch = 256;  // paths of one receiver that go through the scene together

std::vector<Receiver> receivers_at(const bake::Points& points, const TracedScene& scene, std::uint32_t seed) {
  std::vector<Receiver> receivers;
  for (std::size_t i = 0; i < points.count(); ++i) {
    const double* position = &points.positions[3 * i];
    const float* normal = &points.normals[3 * i];
    const glm::vec3 unit_normal = glm::normalize(glm::vec3(normal[0], normal[1], normal[2]));
    const glm::vec3 on(static_cast<float>(position[0]), static_cast<float>(position[1]),
                       static_cast<float>(position[2]));
    receivers.push_back({on + scene.lift() * unit_normal, unit_normal, mixed(static_cast<std::uint32_t>(i), seed)});
  }
  return receivers;
}

void save(const std::string& prefix, std::uint32_t samples, const std::vector<glm::dvec3>& sharp,
          const std::vector<glm::dvec3>& sums) {
  std::vector<float> rgb;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const glm::dvec3 irradiance = sharp[i] + sums[i] / static_cast<double>(samples);
    for (int c = 0; c < 3; ++c) {
      rgb.push_back(static_cast<float>(irradiance[c]));
    }
  }
  bake::save_values(prefix + "-" + std::to_string(samples) + ".csv", rgb, std::vector<std::uint8_t>(sums.size(), 1));
}

}  // namespace

int trace_mode(const TraceOptions& options) {
  const bake::SceneData data = load_scene(options.scene);
  const std::vector<radvor_light_desc> lights =
      options.lights.empty() ? std::vector<radvor_light_desc>{} : bake::load_lights(options.lights);
  const bake::Points points = bake::load_points(options.points);
  const bake::Bounds box = bake::bounds_of(data);

  double begin = processor_seconds();
  const TracedScene scene(data);
  const LightSources sources(scene, lights, static_cast<float>(glm::length(box.high - box.low)));
  const std::vector<Receiver> receivers = receivers_at(points, scene, options.seed);
  PathTracer tracer(scene, sources, options.direct ? 0 : options.most_bounces);
  std::vector<glm::dvec3> sharp, sums(receivers.size(), glm::dvec3(0));
  for (const Receiver& receiver : receivers) {
    sharp.push_back(tracer.trace_sharp_lights(receiver));
  }
  double spent = 0;
  std::uint32_t done = 0;
  for (std::uint32_t samples = 1; samples <= options.most_samples && spent < options.most_seconds; samples *= 2) {
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      for (std::uint32_t first = done; first < samples; first += k_batch) {
        sums[i] += tracer.trace(receivers[i], first, std::min(k_batch, samples - first));
      }
    }
    done = samples;
    spent += processor_seconds() - begin;
    save(options.prefix, samples, sharp, sums);
    std::printf("{\"samples\": %u, \"cpu_seconds\": %.6f, \"rays\": %llu, \"points\": %zu}\n", samples, spent,
                static_cast<unsigned long long>(scene.rays()), receivers.size());
    std::fflush(stdout);
    begin = processor_seconds();
  }
  return 0;
}

}  // namespace bench
