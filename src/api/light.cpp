// radvor_scene_add_light: a light's fields, checked as far as its type reads them, defaults resolved.
#include <cstdio>
#include <numbers>

#include "api/checks.h"
#include "api/scene.h"
#include "api/struct_size.h"

using namespace radvor;
using namespace radvor::api;

namespace {

static_assert(static_cast<std::uint32_t>(LightType::point) == RADVOR_LIGHT_POINT);
static_assert(static_cast<std::uint32_t>(LightType::spot) == RADVOR_LIGHT_SPOT);
static_assert(static_cast<std::uint32_t>(LightType::directional) == RADVOR_LIGHT_DIRECTIONAL);
static_assert(static_cast<std::uint32_t>(LightType::sky) == RADVOR_LIGHT_SKY);

// A light on its way in: its number in the scene, for the sentences, and what the caller wrote.
class Incoming {
 public:
  Incoming(std::size_t number, const radvor_light_desc& given) : desc(given), number_(number) {}

  const radvor_light_desc& desc;

  /// "light 3: radius"; valid until the next call.
  const char* name(const char* field) {
    std::snprintf(name_, sizeof name_, "light %zu: %s", number_, field);
    return name_;
  }

 private:
  std::size_t number_;
  char name_[64];
};

void check_reserved(Incoming& in) {
  if (in.desc.group != 0) {
    throw Error(ErrorCode::unsupported, "%s is %" PRIu32 ": light groups come later", in.name("group"), in.desc.group);
  }
  if (in.desc.reserved != 0) {
    throw Error(ErrorCode::invalid_argument, "%s is %" PRIu32 ", not 0", in.name("reserved"), in.desc.reserved);
  }
}

void check_image(Incoming& in, LightType type) {
  const radvor_light_desc& desc = in.desc;
  if (!desc.image) {
    if (desc.image_width != 0 || desc.image_height != 0) {
      throw Error(ErrorCode::invalid_argument, "%s is NULL, but %" PRIu32 " by %" PRIu32 " pixels are announced",
                  in.name("image"), desc.image_width, desc.image_height);
    }
  } else if (type != LightType::sky) {
    throw Error(ErrorCode::invalid_argument, "%s: only a sky may have one", in.name("image"));
  } else {
    throw Error(ErrorCode::unsupported, "%s: skies are of one colour for now", in.name("image"));
  }
}

Color checked_color(Incoming& in) {
  static constexpr const char* k_names[3] = {"color[0]", "color[1]", "color[2]"};
  for (int channel = 0; channel < 3; ++channel) {
    check_not_negative(in.name(k_names[channel]), in.desc.color[channel]);
  }
  return Color(in.desc.color[0], in.desc.color[1], in.desc.color[2]);
}

Vec3 checked_position(Incoming& in) {
  for (int axis = 0; axis < 3; ++axis) {
    const double coordinate = in.desc.position[axis];
    if (!std::isfinite(coordinate)) {
      throw Error(ErrorCode::invalid_geometry, "%s[%d] is %g", in.name("position"), axis, coordinate);
    }
    if (std::abs(coordinate) > k_largest_coordinate) {
      throw Error(ErrorCode::limit, "%s[%d] is %g, beyond %g", in.name("position"), axis, coordinate,
                  k_largest_coordinate);
    }
  }
  return Vec3(in.desc.position[0], in.desc.position[1], in.desc.position[2]);
}

// In double, where the square of any float fits: no direction but 0 has length 0.
Vec3 checked_direction(Incoming& in, LightType type) {
  const Vec3 direction(in.desc.direction[0], in.desc.direction[1], in.desc.direction[2]);
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(direction[axis])) {
      throw Error(ErrorCode::invalid_geometry, "%s[%d] is %g", in.name("direction"), axis, direction[axis]);
    }
  }
  if (direction == Vec3(0.0)) {
    if (type != LightType::sky) {
      throw Error(ErrorCode::invalid_argument, "%s is 0 0 0, which points nowhere", in.name("direction"));
    }
    return Vec3(0, 1, 0);
  }
  return glm::normalize(direction);
}

void check_cone(Incoming& in, Light& light) {
  constexpr float k_half_turn = std::numbers::pi_v<float>;  // compared in float: the caller's pi/2 is rounded too
  const float outer = in.desc.outer_angle == 0.0f ? k_half_turn / 4 : in.desc.outer_angle;
  check_range(in.name("outer_angle"), outer, 0, k_half_turn / 2);
  check_not_negative(in.name("inner_angle"), in.desc.inner_angle);
  if (!(in.desc.inner_angle < outer)) {
    throw Error(ErrorCode::invalid_argument, "%s is %g, not below outer_angle, %g", in.name("inner_angle"),
                static_cast<double>(in.desc.inner_angle), static_cast<double>(outer));
  }
  light.inner_angle = in.desc.inner_angle;
  light.outer_angle = outer;
}

Light checked_light(Incoming in) {
  const radvor_light_desc& desc = in.desc;
  if (desc.type > RADVOR_LIGHT_SKY) {
    throw Error(ErrorCode::invalid_argument, "%s is %" PRIu32 ", which is no RADVOR_LIGHT_*", in.name("type"),
                desc.type);
  }
  Light light;
  light.type = static_cast<LightType>(desc.type);
  check_reserved(in);
  check_image(in, light.type);
  light.color = checked_color(in);
  if (light.type == LightType::point || light.type == LightType::spot) {
    light.position = checked_position(in);
    check_not_negative(in.name("radius"), desc.radius);
    light.radius = desc.radius;
  }
  if (light.type != LightType::point) {
    light.direction = checked_direction(in, light.type);
  }
  if (light.type == LightType::spot) {
    check_cone(in, light);
  }
  if (light.type == LightType::directional) {
    check_range(in.name("angle"), desc.angle, 0, std::numbers::pi_v<float>);
    light.angle = desc.angle;
  }
  return light;
}

}  // namespace

radvor_result radvor_scene_add_light(radvor_scene* scene, const radvor_light_desc* desc, uint32_t* light) {
  return enter(context_of(scene), __func__, [&] {
    require(desc, "desc");
    require(light, "light");
    const radvor_light_desc known = read_struct(desc, "radvor_light_desc");
    auto& lights = scene->scene.lights;
    lights.push_back(checked_light(Incoming(lights.size(), known)));
    *light = static_cast<std::uint32_t>(lights.size() - 1);
  });
}
