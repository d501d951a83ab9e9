#include "mtl_file.h"

#include <tiny_obj_loader.h>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <istream>
#include <limits>
#include <map>

#include "failure.h"
#include "text_lines.h"

namespace bake {
namespace {

/// tinyobjloader reads a number that it does not understand as 0, without a word; so colours are checked before.
void check_color(const std::string& file, std::size_t number, std::string_view line) {
  const std::vector<std::string_view> fields = split_fields(line);
  if (fields.empty() || (fields[0] != "Kd" && fields[0] != "Ke")) {
    return;
  }
  std::size_t end = 1;  // a comment may follow on the line
  while (end < fields.size() && !fields[end].starts_with('#')) {
    ++end;
  }
  const auto numbers = parse_numbers({fields.begin() + 1, fields.begin() + static_cast<std::ptrdiff_t>(end)});
  if (!numbers || numbers->size() != 3) {
    throw Failure(
        ExitCode::input,
        at_line(file, number, std::string(fields[0]) + " wants three numbers, not \"" + std::string(line) + "\""));
  }
}

glm::vec3 clamped(const tinyobj::real_t (&color)[3], float high, const std::string& what, Warnings& warnings) {
  const glm::vec3 given(color[0], color[1], color[2]);
  const glm::vec3 kept = glm::clamp(given, 0.0f, high);
  if (glm::any(glm::notEqual(given, kept))) {
    warnings.add(what + " is out of range and was clamped");
  }
  return kept;
}

}  // namespace

void load_mtl(const std::string& file, std::vector<MaterialData>& materials, Warnings& warnings) {
  LineStream lines(read_text(file), [&file](std::string_view line, std::size_t number) {
    check_color(file, number, line);
    return line;
  });
  std::istream stream(&lines);
  stream.exceptions(std::ios::badbit);  // or the stream swallows what check_color throws

  std::map<std::string, int> ids;
  std::vector<tinyobj::material_t> read;
  std::string warning;
  std::string error;
  tinyobj::LoadMtl(&ids, &read, &stream, &warning, &error);
  if (!error.empty()) {
    throw Failure(ExitCode::input, file + ": " + error);
  }
  for (const tinyobj::material_t& material : read) {
    if (material.name.empty()) {
      continue;  // what stands before the first newmtl
    }
    const std::string subject = file + ": material " + material.name + ": ";
    materials.push_back({material.name, clamped(material.diffuse, 1.0f, subject + "Kd", warnings),
                         clamped(material.emission, std::numeric_limits<float>::max(), subject + "Ke", warnings)});
    if (!material.diffuse_texname.empty()) {
      warnings.add(subject + "map_Kd is not read; its Kd is the albedo");
    }
  }
}

}  // namespace bake
