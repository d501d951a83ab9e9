#include "radiosity/direct_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/punctual_light.h"

namespace radvor {

namespace {

constexpr double k_pi = 3.14159265358979323846;

bool is_dark(const Color& color) {
  return !(color.r > 0 || color.g > 0 || color.b > 0);
}

}  // namespace

DirectLight::DirectLight(const Scene& scene, const WeldedScene& welded, const Facets& facets,
                         const OccluderTree* occluders, double tolerance, Host& host)
    : occluders_(occluders), punctual_(&host.memory), emitters_(&host.memory), emitting_facets_(&host.memory) {
  // Twice the diameter of the bounds reaches out of them from anywhere inside; a scene of one point still has a length.
  far_ = std::max(2 * glm::length(welded.high - welded.low), 1e-3);

  for (const Light& light : scene.lights) {
    if (is_dark(light.color)) {
      continue;
    }
    if (light.type == LightType::sky) {
      sky_radiance_ += light.color;
    } else {
      punctual_.push_back(light);
    }
  }

  double area = 0, power = 0;
  for (const Facet& facet : facets.facets) {
    area += facet.area;
    const Material& material = scene.materials[facet.material];
    if (is_dark(material.emission)) {
      continue;
    }
    const std::span<const std::uint32_t> triangles(&facets.triangles[facet.first_triangle], facet.triangle_count);
    for (int side = 0; side < (material.two_sided ? 2 : 1); ++side) {
      const auto first = static_cast<std::uint32_t>(emitters_.size());
      for (const std::uint32_t index : triangles) {
        const auto& vertices = welded.triangles[index].vertices;
        Emitter emitter;
        for (std::size_t k = 0; k < 3; ++k) {
          emitter.corners[side == 0 ? k : 2 - k] = welded.positions[vertices[k]];
        }
        const Vec3 twice = glm::cross(emitter.corners[1] - emitter.corners[0], emitter.corners[2] - emitter.corners[0]);
        emitter.area = 0.5 * glm::length(twice);
        if (emitter.area == 0) {
          continue;
        }
        emitter.normal = glm::normalize(twice);
        emitter.radiosity = k_pi * material.emission;
        power += emitter.area * luminance(emitter.radiosity);
        emitters_.push_back(emitter);
      }
      emitting_facets_.push_back({first, static_cast<std::uint32_t>(emitters_.size()) - first});
    }
  }
  accuracy_.tolerance = tolerance;
  accuracy_.mean_irradiance = area > 0 && power > 0 ? power / area : 1;
}

std::uint32_t DirectLight::source_count() const {
  return static_cast<std::uint32_t>(punctual_.size() + emitting_facets_.size());
}

Color DirectLight::irradiance(std::uint32_t source, const Receiver& receiver, Tracer& tracer, Sight& sight) const {
  if (source < punctual_.size()) {
    return irradiance_of_punctual_light(punctual_[source], receiver, tracer, far_, sight);
  }
  source -= static_cast<std::uint32_t>(punctual_.size());
  Color sum(0.0);
  const EmitterRange range = emitting_facets_[source];
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    Sight of_triangle;
    sum += irradiance_of_emitter(emitters_[i], receiver, tracer, accuracy_, occluders_, of_triangle);
    sight.add(of_triangle);
  }
  return sum;
}

std::optional<DirectLight::Beam> DirectLight::beam(std::uint32_t source, const Vec3& to) const {
  Vec3 from(0.0), facing(0.0);
  if (source < punctual_.size()) {
    if (punctual_[source].type == LightType::directional) {
      return Beam{punctual_[source].direction, std::numeric_limits<double>::infinity()};
    }
    from = punctual_[source].position;
  } else {
    const EmitterRange range = emitting_facets_[source - punctual_.size()];
    double area = 0;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const Emitter& emitter = emitters_[i];
      from += emitter.area / 3 * (emitter.corners[0] + emitter.corners[1] + emitter.corners[2]);
      facing += emitter.area * emitter.normal;
      area += emitter.area;
    }
    if (area <= 0) {
      return {};
    }
    from /= area;
  }
  const Vec3 apart = to - from;
  const double distance = glm::length(apart);
  if (!(distance > 0) || (facing != Vec3(0.0) && glm::dot(facing, apart) <= 0)) {
    return {};
  }
  return Beam{apart / distance, distance};
}

}  // namespace radvor
