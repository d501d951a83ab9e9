// A Wavefront OBJ as a Scene, for tests on real geometry: positions, normals, groups of material as material numbers;
// polygons as fans. One mesh; throws where a file is not what the real scenes are.
#pragma once

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace radvor::test {

class ObjReader {
 public:
  explicit ObjReader(std::pmr::memory_resource* memory) : scene_(memory) { scene_.meshes.emplace_back(memory); }

  Scene read(const std::filesystem::path& file) {
    std::ifstream text(file);
    for (std::string line; std::getline(text, line);) {
      std::istringstream words(line);
      std::string keyword;
      words >> keyword;
      if (keyword == "v") {
        positions_.push_back(vector(words));
      } else if (keyword == "vn") {
        normals_.push_back(vector(words));
      } else if (keyword == "usemtl") {
        std::string name;
        words >> name;
        material_ = materials_.try_emplace(name, static_cast<std::uint32_t>(materials_.size())).first->second;
      } else if (keyword == "f") {
        face(words);
      }
    }
    scene_.materials.resize(std::max<std::size_t>(1, materials_.size()));
    if (normals_.empty()) {
      scene_.meshes[0].normals.clear();
    }
    return std::move(scene_);
  }

 private:
  static glm::vec3 vector(std::istream& words) {
    glm::vec3 v(0);
    words >> v.x >> v.y >> v.z;
    return v;
  }

  static std::size_t index_in(const std::string& number, std::size_t count) {
    const long index = std::strtol(number.c_str(), nullptr, 10);
    const auto found = static_cast<std::size_t>(index < 0 ? static_cast<long>(count) + index : index - 1);
    if (found >= count) {
      throw std::runtime_error("index out of range: " + number);
    }
    return found;
  }

  std::uint32_t corner(const std::string& word) {
    const std::size_t slash = word.rfind('/');
    const std::size_t position = index_in(word, positions_.size());
    const bool has_normal = slash != std::string::npos && slash != word.find('/');
    const std::size_t normal = has_normal ? index_in(word.substr(slash + 1), normals_.size()) : 0;
    Mesh& mesh = scene_.meshes[0];
    const auto next = static_cast<std::uint32_t>(mesh.positions.size());
    const auto [found, is_new] = corners_.try_emplace({position, normal}, next);
    if (is_new) {
      mesh.positions.push_back(positions_[position]);
      mesh.normals.push_back(has_normal ? normals_[normal] : glm::vec3(0));
    }
    return found->second;
  }

  void face(std::istream& words) {
    std::vector<std::uint32_t> polygon;
    for (std::string word; words >> word;) {
      polygon.push_back(corner(word));
    }
    Mesh& mesh = scene_.meshes[0];
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      mesh.indices.insert(mesh.indices.end(), {polygon[0], polygon[i - 1], polygon[i]});
      mesh.triangle_materials.push_back(material_);
    }
  }

  Scene scene_;
  std::vector<glm::vec3> positions_, normals_;
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> corners_;
  std::map<std::string, std::uint32_t> materials_;
  std::uint32_t material_ = 0;
};

/// Nothing where the folder of real scenes is absent.
inline std::optional<Scene> real_scene(const std::string& name, std::pmr::memory_resource* memory) {
  const std::filesystem::path file = std::filesystem::path(RADVOR_SHARED_DIR) / "scenes" / name / "scene.obj";
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  return ObjReader(memory).read(file);
}

}  // namespace radvor::test
