#include "light_lines.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "failure.h"
#include "text_lines.h"

namespace bake {
namespace {

struct Form {
  std::string_view name;
  std::uint32_t type;
  std::size_t vectors;    ///< of three numbers: place or direction, colour
  bool size;              ///< a seventh number may follow
  std::string_view form;  ///< for messages
};

constexpr Form k_forms[] = {
    {"sky", RADVOR_LIGHT_SKY, 1, false, "sky R G B"},
    {"sun", RADVOR_LIGHT_DIRECTIONAL, 2, true, "sun DX DY DZ R G B [ANGLE]"},
    {"point", RADVOR_LIGHT_POINT, 2, true, "point X Y Z R G B [RADIUS]"},
};

[[noreturn]] void refuse(std::string_view words, const std::string& why) {
  throw Failure(ExitCode::usage, "light \"" + std::string(words) + "\": " + why);
}

const Form& form_of(std::string_view words, const std::vector<std::string_view>& fields) {
  for (const Form& form : k_forms) {
    if (!fields.empty() && fields[0] == form.name) {
      return form;
    }
  }
  refuse(words, "a light is sky, sun or point");
}

}  // namespace

radvor_light_desc parse_light(std::string_view words) {
  std::vector<std::string_view> fields = split_fields(words);
  const Form& form = form_of(words, fields);
  fields.erase(fields.begin());
  const auto numbers = parse_numbers(fields);
  const std::size_t least = form.vectors * 3;
  if (!numbers || numbers->size() < least || numbers->size() > least + (form.size ? 1 : 0)) {
    refuse(words, "it reads " + std::string(form.form));
  }
  const std::vector<double>& n = *numbers;
  const auto too_large = [](double value) { return !(std::abs(value) <= std::numeric_limits<float>::max()); };
  if (std::any_of(n.begin(), n.end(), too_large)) {
    refuse(words, "a number is too large");
  }
  radvor_light_desc light{};
  light.struct_size = sizeof light;
  light.type = form.type;
  for (std::size_t i = 0; i < 3; ++i) {
    const double color = n[least - 3 + i];
    if (color < 0) {
      refuse(words, "light is not negative");
    }
    light.color[i] = static_cast<float>(color);
    if (form.type == RADVOR_LIGHT_POINT) {
      light.position[i] = n[i];
    } else if (form.type == RADVOR_LIGHT_DIRECTIONAL) {
      light.direction[i] = static_cast<float>(n[i]);
    }
  }
  if (form.type == RADVOR_LIGHT_DIRECTIONAL && n[0] == 0 && n[1] == 0 && n[2] == 0) {
    refuse(words, "it travels nowhere");
  }
  const double size = n.size() > least ? n.back() : 0;
  if (size < 0 || (form.type == RADVOR_LIGHT_DIRECTIONAL && size > std::numbers::pi)) {
    refuse(words, form.type == RADVOR_LIGHT_POINT ? "its radius is negative"
                                                  : "its angular diameter is not within 0 to pi; it is in radians");
  }
  (form.type == RADVOR_LIGHT_POINT ? light.radius : light.angle) = static_cast<float>(size);
  return light;
}

std::vector<radvor_light_desc> load_lights(const std::string& file) {
  std::vector<radvor_light_desc> lights;
  TextLines lines(read_text(file));
  std::string_view line;
  while (lines.next(line)) {
    const std::string_view words = line.substr(0, line.find('#'));
    if (split_fields(words).empty()) {
      continue;
    }
    try {
      lights.push_back(parse_light(words));
    } catch (const Failure& failure) {
      throw Failure(ExitCode::input, at_line(file, lines.number(), failure.what()));
    }
  }
  return lights;
}

}  // namespace bake
