#include "light_sources.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

namespace bench {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;

float flux_of(const glm::vec3& color) {
  return color.x + color.y + color.z;
}

float power_heuristic(float density, float other) {
  return density * density / (density * density + other * other);
}

/// Two unit vectors that are perpendicular to a third and to each other (T. Duff et al., JCGT 6(1), 2017).
void frame_around(const glm::vec3& n, glm::vec3& x, glm::vec3& y) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  y = {b, sign + n.y * n.y * a, -n.y};
}

/// Uniform over the cone of directions around an axis.
glm::vec3 cone_direction(const glm::vec3& axis, float cosine, float u, float v) {
  const float z = 1 - u * (1 - cosine);
  const float radius = std::sqrt(std::max(0.0f, 1 - z * z));
  glm::vec3 x, y;
  frame_around(axis, x, y);
  return radius * std::cos(2 * k_pi * v) * x + radius * std::sin(2 * k_pi * v) * y + z * axis;
}

}  // namespace

LightSources::LightSources(const TracedScene& scene, const std::vector<radvor_light_desc>& lights, float scene_size)
    : scene_(scene), far_(2 * scene_size) {
  emitter_of_triangle_.assign(scene.triangle_count(), TracedScene::k_nothing);
  glm::vec3 low = scene.corner(0, 0), high = low;
  std::vector<ChoosableEmitter> choosable;
  for (std::uint32_t triangle = 0; triangle < scene.triangle_count(); ++triangle) {
    Emitter emitter{triangle, scene.corner(triangle, 0), {}, {}, {}, scene.emission(triangle), 0};
    emitter.edge_1 = scene.corner(triangle, 1) - emitter.corner;
    emitter.edge_2 = scene.corner(triangle, 2) - emitter.corner;
    const glm::vec3 normal = glm::cross(emitter.edge_1, emitter.edge_2);
    const float doubled = glm::length(normal);
    for (std::uint32_t i = 0; i < 3; ++i) {
      low = glm::min(low, scene.corner(triangle, i));
      high = glm::max(high, scene.corner(triangle, i));
    }
    if (flux_of(emitter.emission) > 0 && doubled > 0) {
      emitter.normal = normal / doubled;
      emitter.area = 0.5f * doubled;
      emitter_of_triangle_[triangle] = static_cast<std::uint32_t>(emitters_.size());
      emitters_.push_back(emitter);
      choosable.push_back({emitter.corner + (emitter.edge_1 + emitter.edge_2) / 3.0f, emitter.normal,
                           flux_of(emitter.emission) * emitter.area});
    }
  }
  if (!emitters_.empty()) {
    choice_.emplace(std::move(choosable), low, high);
  }
  float punctual_sum = 0;
  for (const radvor_light_desc& light : lights) {
    if (light.type == RADVOR_LIGHT_SKY && !light.image) {
      sky_ += glm::vec3(light.color[0], light.color[1], light.color[2]);
    } else if (light.type == RADVOR_LIGHT_POINT || light.type == RADVOR_LIGHT_DIRECTIONAL) {
      // What a point gives to the scene as a whole: its intensity, at half the scene's size; a sun its irradiance.
      const float reach = light.type == RADVOR_LIGHT_POINT ? 4 / (scene_size * scene_size) : 1;
      punctual_.push_back({light, reach * flux_of({light.color[0], light.color[1], light.color[2]})});
      punctual_sum += punctual_.back().probability;
    } else {
      throw std::runtime_error("the tracer knows points, suns and skies of one colour alone");
    }
  }
  for (Punctual& punctual : punctual_) {
    punctual.probability /= punctual_sum;
  }
}

float LightSources::density_towards(const glm::vec3& from, const glm::vec3& to, const Emitter& emitter,
                                    float probability) const {
  const glm::vec3 way = to - from;
  const float square = glm::dot(way, way);
  const float cosine = -glm::dot(way, emitter.normal) / std::sqrt(square);
  return cosine > 0 ? probability / emitter.area * square / cosine : 0;
}

LightSample LightSources::sample_emitters(const glm::vec3& position, const glm::vec3& normal, float u, float v) const {
  const LightChoice::Choice choice = choice_->choose(position, u);
  const Emitter& emitter = emitters_[choice.emitter];
  const float root = std::sqrt(choice.rest);
  const glm::vec3 on =
      emitter.corner + root * (1 - v) * emitter.edge_1 + root * v * emitter.edge_2 + scene_.lift() * emitter.normal;
  LightSample sample{{position, on - position}, glm::vec3(0)};
  const float cosine = glm::dot(sample.segment.direction, normal) / glm::length(sample.segment.direction);
  const float density = density_towards(position, on, emitter, choice.probability);
  if (cosine > 0 && density > 0) {
    sample.irradiance = power_heuristic(density, cosine / k_pi) * cosine / density * emitter.emission;
  }
  return sample;
}

float LightSources::weight_of_hit(const glm::vec3& from, const glm::vec3& normal, const Hit& hit) const {
  const std::uint32_t emitter = emitter_of_triangle_[hit.triangle];
  if (emitter == TracedScene::k_nothing) {
    return 0;
  }
  const float cosine = glm::dot(glm::normalize(hit.position - from), normal);
  const float other = density_towards(from, hit.position, emitters_[emitter], choice_->probability(from, emitter));
  return cosine > 0 ? power_heuristic(cosine / k_pi, other) : 0;
}

LightSample LightSources::sample_punctual(std::size_t light, const glm::vec3& position, const glm::vec3& normal,
                                          float u, float v) const {
  const radvor_light_desc& desc = punctual_[light].light;
  const glm::vec3 color(desc.color[0], desc.color[1], desc.color[2]);
  if (desc.type == RADVOR_LIGHT_DIRECTIONAL) {
    glm::vec3 towards = -glm::normalize(glm::vec3(desc.direction[0], desc.direction[1], desc.direction[2]));
    if (desc.angle > 0) {
      towards = cone_direction(towards, std::cos(0.5f * desc.angle), u, v);
    }
    return {{position, far_ * towards}, std::max(0.0f, glm::dot(towards, normal)) * color};
  }
  const glm::vec3 centre(desc.position[0], desc.position[1], desc.position[2]);
  glm::vec3 way = centre - position;
  const float square = glm::dot(way, way);
  if (desc.radius > 0) {  // a sphere of constant radiance: its cone, uniformly
    const float sine_squared = std::min(1.0f, desc.radius * desc.radius / square);
    const float cosine = std::sqrt(1 - sine_squared);
    const float distance = std::sqrt(square);
    way = (distance - desc.radius) * cone_direction(way / distance, cosine, u, v);
    const glm::vec3 radiance = color / (k_pi * desc.radius * desc.radius);
    return {{position, way},
            std::max(0.0f, glm::dot(glm::normalize(way), normal)) * 2 * k_pi * (1 - cosine) * radiance};
  }
  return {{position, way}, std::max(0.0f, glm::dot(way, normal)) / (square * std::sqrt(square)) * color};
}

LightSample LightSources::sample_any_punctual(const glm::vec3& position, const glm::vec3& normal, float choice, float u,
                                              float v) const {
  std::size_t light = 0;
  while (light + 1 < punctual_.size() && choice >= punctual_[light].probability) {
    choice -= punctual_[light++].probability;
  }
  LightSample sample = sample_punctual(light, position, normal, u, v);
  sample.irradiance /= punctual_[light].probability;
  return sample;
}

}  // namespace bench
