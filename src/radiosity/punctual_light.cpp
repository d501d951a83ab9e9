#include "radiosity/punctual_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/strata.h"

namespace radvor {

namespace {

// The mean over a disk of directions about `axis` (radius sin_radius, in projection along the axis) of
// max(0, n . w) / (axis . w) * visible(w): what a uniform disk delivers relative to its irradiance on a facing surface.
// 16 points and 8 of the rim first; where they disagree, 256.
double visible_cosine_of_disk(const Receiver& receiver, const Vec3& axis, double sin_radius, double distance,
                              double source_radius, Tracer& tracer, Sight& sight) {
  const Basis basis(axis);
  const auto sample = [&](int points, int rim, bool& mixed) {
    std::array<Vec3, 256> targets;
    std::array<double, 256> weights;
    std::array<std::uint8_t, 256> blocked, above;
    std::size_t count = 0;
    const auto add = [&](const Vec2& p, double share) {
      const Vec3 direction = basis.on_hemisphere(sin_radius * p);
      const double cosine = glm::dot(receiver.normal, direction);
      if (cosine <= 0 && tracer.skips.facing) {
        ++tracer.counters.skipped_facing;
        return;
      }
      const double along = glm::dot(direction, axis);
      // To the near side of the luminous sphere; for a sun, out of the scene.
      const double reach =
          distance * along -
          std::sqrt(std::max(0.0, source_radius * source_radius - distance * distance * (1 - along * along)));
      targets[count] = receiver.lifted + direction * reach;
      above[count] = cosine > 0;  // under the horizon: not blocked, not there
      weights[count++] = cosine > 0 ? share * cosine / along : 0;
    };
    for (int i = 0; i < points; ++i) {
      add(sunflower(i, points), 1.0 / points);
    }
    for (int i = 0; i < rim; ++i) {
      const double angle = (i + 0.5) * 6.283185307179586 / rim;
      add({0.99 * std::cos(angle), 0.99 * std::sin(angle)}, 0);
    }
    tracer.blocked_from(receiver.lifted, std::span(targets.data(), count), blocked.data());
    double all = 0, seen = 0;
    bool open = false, hidden = false;
    for (std::size_t k = 0; k < count; ++k) {
      if (above[k] == 0) {
        ++tracer.counters.idle_rays;
        continue;
      }
      open = open || blocked[k] == 0;
      hidden = hidden || blocked[k] != 0;
      all += weights[k];
      seen += blocked[k] ? 0 : weights[k];
    }
    mixed = open && hidden;
    sight.add({open, hidden});
    // Wholly above the horizon the disk's mean is that of its centre, exactly: the points only say what is seen of it.
    const double cosine = glm::dot(receiver.normal, axis);
    return cosine >= sin_radius && all > 0 ? cosine * seen / all : seen;
  };
  bool mixed = false;
  const double coarse = sample(16, 8, mixed);
  return mixed ? sample(256, 0, mixed) : coarse;
}

double visible_cosine(const Receiver& receiver, const Vec3& axis, double sin_radius, double distance,
                      double source_radius, Tracer& tracer, Sight& sight) {
  const double cosine = glm::dot(receiver.normal, axis);
  if (cosine <= -sin_radius && tracer.skips.facing) {
    ++tracer.counters.skipped_facing;
    return 0;
  }
  if (sin_radius > 0) {
    return visible_cosine_of_disk(receiver, axis, sin_radius, distance, source_radius, tracer, sight);
  }
  if (cosine <= 0 && tracer.skips.facing) {
    ++tracer.counters.skipped_facing;
    return 0;
  }
  const Vec3 target = receiver.lifted + axis * distance;
  std::uint8_t blocked = 0;
  tracer.blocked_from(receiver.lifted, std::span(&target, 1), &blocked);
  if (cosine <= 0) {
    ++tracer.counters.idle_rays;
    return 0;
  }
  sight = {blocked == 0, blocked != 0};
  return blocked ? 0 : cosine;
}

// KHR_lights_punctual, "Inner and outer cone angles".
double spot_falloff(const Light& light, const Vec3& to_receiver) {
  const double cos_outer = std::cos(light.outer_angle);
  const double scale = 1 / std::max(0.001, std::cos(light.inner_angle) - cos_outer);
  const double ramp = std::clamp((glm::dot(light.direction, to_receiver) - cos_outer) * scale, 0.0, 1.0);
  return ramp * ramp;
}

}  // namespace

Color irradiance_of_punctual_light(const Light& light, const Receiver& receiver, Tracer& tracer, double far,
                                   Sight& sight) {
  if (light.type == LightType::directional) {
    const double sin_radius = std::sin(std::min(light.angle / 2, 1.5));
    return light.color * visible_cosine(receiver, -light.direction, sin_radius, far, 0, tracer, sight);
  }
  const Vec3 apart = light.position - receiver.point;
  const double distance = glm::length(apart);
  if (distance <= light.radius || distance == 0) {
    return Color(0.0);  // inside the luminous sphere: its surface shines outwards
  }
  const Vec3 axis = apart / distance;
  const double falloff = light.type == LightType::spot ? spot_falloff(light, -axis) : 1;
  const double sin_radius = light.radius / distance;
  if (falloff == 0) {  // outside of the cone nothing is hidden either
    if (tracer.skips.negligible) {
      ++tracer.counters.skipped_negligible;
    } else {
      Sight of_nothing;
      const TransportCounters before = tracer.counters;
      visible_cosine(receiver, axis, sin_radius, distance, light.radius, tracer, of_nothing);
      tracer.counters.idle_rays = before.idle_rays + tracer.counters.rays - before.rays;
    }
    return Color(0.0);
  }
  return light.color * (falloff / (distance * distance) *
                        visible_cosine(receiver, axis, sin_radius, distance, light.radius, tracer, sight));
}

Color unhindered_irradiance(const Light& light, const Receiver& receiver, double far, Vec3& at) {
  if (light.type == LightType::directional) {
    at = receiver.lifted - far * light.direction;
    return light.color * std::max(0.0, -glm::dot(receiver.normal, light.direction));
  }
  const Vec3 apart = light.position - receiver.point;
  const double distance = glm::length(apart);
  if (distance <= light.radius || distance == 0) {
    return Color(0.0);
  }
  const Vec3 axis = apart / distance;
  at = light.position - light.radius * axis;
  const double falloff = light.type == LightType::spot ? spot_falloff(light, -axis) : 1;
  return light.color * (falloff * std::max(0.0, glm::dot(receiver.normal, axis)) / (distance * distance));
}

}  // namespace radvor
