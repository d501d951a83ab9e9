#include "radiosity/direct_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/punctual_light.h"

namespace radvor {

namespace {

constexpr double k_pi = 3.14159265358979323846;

constexpr double k_flat = 1e-12;  // of the cosine between two triangles that are one polygon
constexpr double k_near = 25;     // times its area, the square of the distance that a surface is near from

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
      EmitterRange range{first, static_cast<std::uint32_t>(emitters_.size()) - first};
      Vec3 facing(0.0);
      for (const Emitter& emitter : std::span(emitters_).subspan(first)) {
        range.middle += emitter.area / 3 * (emitter.corners[0] + emitter.corners[1] + emitter.corners[2]);
        range.area += emitter.area;
        facing += emitter.area * emitter.normal;
      }
      if (range.area > 0) {
        range.middle /= range.area;
        range.normal = facing / std::max(glm::length(facing), 1e-300);
      }
      range.panel = panel_of(std::span(emitters_).subspan(first));
      emitting_facets_.push_back(range);
    }
  }
  accuracy_.tolerance = tolerance;
  accuracy_.mean_irradiance = area > 0 && power > 0 ? power / area : 1;
}

// Counter-clockwise, if the triangles are two that share a side and bulge nowhere.
std::optional<std::array<Vec3, 4>> DirectLight::panel_of(std::span<const Emitter> emitters) {
  if (emitters.size() != 2 || !(glm::dot(emitters[0].normal, emitters[1].normal) > 1 - k_flat)) {
    return {};
  }
  const auto &a = emitters[0].corners, &b = emitters[1].corners;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a[i] != b[(j + 1) % 3] || a[(i + 1) % 3] != b[j]) {
        continue;
      }
      const std::array<Vec3, 4> corners = {a[i], b[(j + 2) % 3], a[(i + 1) % 3], a[(i + 2) % 3]};
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 side = corners[(k + 1) % 4] - corners[k], next = corners[(k + 2) % 4] - corners[(k + 1) % 4];
        if (!(glm::dot(glm::cross(side, next), emitters[0].normal) > 0)) {
          return {};
        }
      }
      return corners;
    }
  }
  return {};
}

std::uint32_t DirectLight::source_count() const {
  return static_cast<std::uint32_t>(punctual_.size() + emitting_facets_.size());
}

Color DirectLight::irradiance(std::uint32_t source, const Receiver& receiver, Tracer& tracer, Sight& sight) const {
  if (source < punctual_.size()) {
    return irradiance_of_punctual_light(punctual_[source], receiver, tracer, far_, sight);
  }
  source -= static_cast<std::uint32_t>(punctual_.size());
  const EmitterRange& range = emitting_facets_[source];
  if (range.panel) {
    const std::span<const Emitter, 2> halves(&emitters_[range.first], 2);
    return irradiance_of_panel(halves, *range.panel, receiver, tracer, accuracy_, occluders_, sight);
  }
  Color sum(0.0);
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    Sight of_triangle;
    sum += irradiance_of_emitter(emitters_[i], receiver, tracer, accuracy_, occluders_, of_triangle);
    sight.add(of_triangle);
  }
  return sum;
}

DirectLight::Aim DirectLight::aim(std::uint32_t source, const Receiver& receiver) const {
  if (source < punctual_.size()) {
    Aim aim;
    aim.irradiance = unhindered_irradiance(punctual_[source], receiver, far_, aim.at);
    return aim;
  }
  const EmitterRange& range = emitting_facets_[source - punctual_.size()];
  const Vec3 apart = range.middle - receiver.point;
  const double there = glm::dot(receiver.normal, apart), back = -glm::dot(range.normal, apart);
  if (!(there > 0 && back > 0)) {
    return {};
  }
  // Of a disk of its area, which is exact where the two face each other.
  const double square = glm::dot(apart, apart);
  const double form_factor = there * back * range.area / (square * (k_pi * square + range.area));
  // A little on this side, so that the surface does not hide itself.
  constexpr double k_before = 1e-3;
  return {form_factor * emitters_[range.first].radiosity, range.middle - k_before * apart,
          square < k_near * range.area};
}

std::optional<DirectLight::Beam> DirectLight::beam(std::uint32_t source, const Vec3& to) const {
  Vec3 from(0.0), facing(0.0);
  if (source < punctual_.size()) {
    if (punctual_[source].type == LightType::directional) {
      return Beam{punctual_[source].direction, std::numeric_limits<double>::infinity()};
    }
    from = punctual_[source].position;
  } else {
    const EmitterRange& range = emitting_facets_[source - punctual_.size()];
    if (range.area <= 0) {
      return {};
    }
    from = range.middle;
    facing = range.normal;
  }
  const Vec3 apart = to - from;
  const double distance = glm::length(apart);
  if (!(distance > 0) || (facing != Vec3(0.0) && glm::dot(facing, apart) <= 0)) {
    return {};
  }
  return Beam{apart / distance, distance};
}

}  // namespace radvor
