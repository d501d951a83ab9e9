#include "path_tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace bench {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;
// Roulette begins where a path has lost all but this; from there on every path that is left carries as much. Half as
// much time for the same error in the Cornell box as roulette from the second vertex on.
constexpr float k_certain_throughput = 0.3f;
constexpr std::uint32_t k_most_depth = 1000;  // albedo is at most 0.99

/// Sets of four dimensions: one for each depth, one for the first light, one of single numbers for each depth.
std::uint32_t set_of_directions(std::uint32_t depth) {
  return 2 * depth + 1;
}
std::uint32_t set_of_choices(std::uint32_t depth) {
  return 2 * depth + 2;
}
constexpr std::uint32_t k_set_of_first_light = 0;

/// Concentric map of the square to the disk (P. Shirley and K. Chiu, 1997), lifted to the hemisphere: density
/// cosine/pi (N. Malley).
glm::vec3 cosine_direction(const glm::vec3& n, float u, float v) {
  const float a = 2 * u - 1;
  const float b = 2 * v - 1;
  float radius = 0;
  float angle = 0;
  if (a * a > b * b) {
    radius = a;
    angle = k_pi / 4 * (b / a);
  } else if (b != 0) {
    radius = b;
    angle = k_pi / 2 - k_pi / 4 * (a / b);
  }
  const float x = radius * std::cos(angle);
  const float y = radius * std::sin(angle);
  const float z = std::sqrt(std::max(0.0f, 1 - x * x - y * y));
  const float sign = std::copysign(1.0f, n.z);  // a frame around n: T. Duff et al., JCGT 6(1) (2017)
  const float c = -1 / (sign + n.z);
  const float d = n.x * n.y * c;
  const glm::vec3 tangent(1 + sign * n.x * n.x * c, sign * d, -sign * n.x);
  const glm::vec3 bitangent(d, sign + n.y * n.y * c, -n.y);
  return x * tangent + y * bitangent + z * n;
}

}  // namespace

PathTracer::PathTracer(const TracedScene& scene, const LightSources& lights, std::uint32_t most_bounces)
    : scene_(scene), lights_(lights), most_bounces_(most_bounces) {}

glm::dvec3 PathTracer::trace(const Receiver& receiver, std::uint32_t first, std::uint32_t count) {
  sum_ = glm::dvec3(0);
  begin(receiver, first, count);
  for (std::uint32_t depth = 0; !paths_.empty() && depth < k_most_depth; ++depth) {
    sample_lights(receiver.seed, depth);
    sample_directions(receiver.seed, depth);
    arrive(receiver.seed, depth);
  }
  return sum_;
}

glm::dvec3 PathTracer::trace_sharp_lights(const Receiver& receiver) {
  sum_ = glm::dvec3(0);
  for (std::size_t light = 0; light < lights_.punctual_count(); ++light) {
    if (lights_.is_sharp(light)) {
      add_light(lights_.sample_punctual(light, receiver.position, receiver.normal, 0.5f, 0.5f), glm::vec3(1));
    }
  }
  flush_lights(true);
  return sum_;
}

void PathTracer::begin(const Receiver& receiver, std::uint32_t first, std::uint32_t count) {
  paths_.clear();
  for (std::uint32_t i = first; i < first + count; ++i) {
    const std::array<float, 4> light = sobol_.point(i, mixed(receiver.seed, k_set_of_first_light));
    paths_.push_back({receiver.position, receiver.normal, glm::vec3(1), i, light[0], light[1], 0, 0});
  }
}

void PathTracer::add_light(const LightSample& sample, const glm::vec3& throughput) {
  const glm::vec3 arriving = throughput * sample.irradiance;
  if (arriving.x + arriving.y + arriving.z > 0) {
    segments_.push_back(sample.segment);
    on_the_way_.push_back(arriving);
  }
}

void PathTracer::flush_lights(bool coherent) {
  static_assert(sizeof(bool) == sizeof(std::uint8_t));
  blocked_.resize(segments_.size());
  scene_.occluded(segments_.data(), segments_.size(), coherent, reinterpret_cast<bool*>(blocked_.data()));
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    if (blocked_[i] == 0) {
      sum_ += glm::dvec3(on_the_way_[i]);
    }
  }
  segments_.clear();
  on_the_way_.clear();
}

void PathTracer::sample_lights(std::uint32_t seed, std::uint32_t depth) {
  if (lights_.any_emitters()) {
    for (const Path& path : paths_) {
      add_light(lights_.sample_emitters(path.position, path.normal, path.light_u, path.light_v), path.throughput);
    }
  }
  if (lights_.punctual_count() > 0) {
    for (const Path& path : paths_) {
      const std::array<float, 4> random = sobol_.point(path.index, mixed(seed, set_of_choices(depth)));
      if (depth > 0) {
        add_light(lights_.sample_any_punctual(path.position, path.normal, random[1], random[2], random[3]),
                  path.throughput);
        continue;
      }
      for (std::size_t light = 0; light < lights_.punctual_count(); ++light) {
        if (!lights_.is_sharp(light)) {
          add_light(lights_.sample_punctual(light, path.position, path.normal, random[2], random[3]), path.throughput);
        }
      }
    }
  }
  flush_lights(depth == 0);
}

void PathTracer::sample_directions(std::uint32_t seed, std::uint32_t depth) {
  rays_.clear();
  for (Path& path : paths_) {
    const std::array<float, 4> random = sobol_.point(path.index, mixed(seed, set_of_directions(depth)));
    rays_.push_back({path.position, cosine_direction(path.normal, random[0], random[1])});
    path.next_u = random[2];
    path.next_v = random[3];
  }
  meetings_.resize(rays_.size());
  scene_.intersect(rays_.data(), rays_.size(), false, meetings_.data());
}

void PathTracer::arrive(std::uint32_t seed, std::uint32_t depth) {
  std::size_t alive = 0;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    Path path = paths_[i];
    if (meetings_[i].triangle == TracedScene::k_nothing) {
      sum_ += glm::dvec3(k_pi * path.throughput * lights_.sky());
      continue;
    }
    if (!scene_.meets_front(rays_[i], meetings_[i].triangle)) {
      continue;  // absorbed at a back
    }
    const Hit hit = scene_.hit(meetings_[i]);
    const glm::vec3 emission = scene_.emission(hit.triangle);
    if (emission.x + emission.y + emission.z > 0) {
      sum_ += glm::dvec3(k_pi * lights_.weight_of_hit(path.position, path.normal, hit) * path.throughput * emission);
    }
    if (depth >= most_bounces_) {
      continue;
    }
    path.throughput *= hit.albedo;
    const float most = std::max({path.throughput.x, path.throughput.y, path.throughput.z});
    if (most < k_certain_throughput) {
      const float survival = most / k_certain_throughput;
      if (unit(mixed(mixed(seed, path.index), depth)) >= survival) {
        continue;
      }
      path.throughput /= survival;
    }
    path.position = hit.position;
    path.normal = hit.normal;
    path.light_u = path.next_u;
    path.light_v = path.next_v;
    paths_[alive++] = path;
  }
  paths_.resize(alive);
}

}  // namespace bench
