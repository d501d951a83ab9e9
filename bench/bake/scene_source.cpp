#include "scene_source.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>

#include "failure.h"
#include "generated_scenes.h"
#include "obj_file.h"

namespace bench {
namespace {

/// Takes "N:" or the last "N" off words.
std::size_t take_number(std::string_view& words, const std::string& name) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), number);
  if (error != std::errc() || number == 0) {
    throw bake::Failure(bake::ExitCode::usage,
                        "scene \"" + name + "\": a number above 0 is due at \"" + std::string(words) + "\"");
  }
  words.remove_prefix(static_cast<std::size_t>(end - words.data()));
  if (!words.empty() && words.front() == ':') {
    words.remove_prefix(1);
  }
  return number;
}

bool take_prefix(std::string_view& words, std::string_view prefix) {
  if (!words.starts_with(prefix)) {
    return false;
  }
  words.remove_prefix(prefix.size());
  return true;
}

/// Midpoints of edges, each made once.
class Midpoints {
 public:
  explicit Midpoints(bake::MeshData& mesh) : mesh_(mesh) {}

  std::uint32_t of(std::uint32_t a, std::uint32_t b) {
    const auto [entry, fresh] = ids_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh_.positions.size()));
    if (fresh) {
      append(mesh_.positions, a, b);
      append(mesh_.normals, a, b);
      append(mesh_.colors, a, b);
      append(mesh_.uvs, a, b);
    }
    return entry->second;
  }

 private:
  template <class Vector>
  static void append(std::vector<Vector>& attribute, std::uint32_t a, std::uint32_t b) {
    if (!attribute.empty()) {
      attribute.push_back(0.5f * (attribute[a] + attribute[b]));
    }
  }

  bake::MeshData& mesh_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> ids_;
};

}  // namespace

bake::SceneData quartered(const bake::SceneData& scene) {
  bake::SceneData result = scene;
  for (bake::MeshData& mesh : result.meshes) {
    const std::vector<std::uint32_t> corners = std::move(mesh.indices);
    const std::vector<std::uint32_t> materials = std::move(mesh.triangle_materials);
    mesh.indices.clear();
    mesh.triangle_materials.clear();
    Midpoints midpoints(mesh);
    for (std::size_t triangle = 0; triangle < materials.size(); ++triangle) {
      const std::uint32_t a = corners[3 * triangle], b = corners[3 * triangle + 1], c = corners[3 * triangle + 2];
      const std::uint32_t ab = midpoints.of(a, b), bc = midpoints.of(b, c), ca = midpoints.of(c, a);
      mesh.indices.insert(mesh.indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
      mesh.triangle_materials.insert(mesh.triangle_materials.end(), 4, materials[triangle]);
    }
  }
  return result;
}

bake::SceneData load_scene(const std::string& name) {
  std::string_view words = name;
  if (take_prefix(words, "split:")) {
    const std::size_t times = take_number(words, name);
    bake::SceneData scene = load_scene(std::string(words));
    for (std::size_t i = 0; i < times; ++i) {
      scene = quartered(scene);
    }
    return scene;
  }
  if (take_prefix(words, "city:")) {
    return generated_city(take_number(words, name));
  }
  if (take_prefix(words, "hall:")) {
    const std::size_t lamps = take_number(words, name);
    return generated_hall(lamps, take_number(words, name));
  }
  bake::Warnings warnings;
  return bake::load_obj(name, warnings);
}

}  // namespace bench
