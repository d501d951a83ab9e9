#include "obj_file.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include "failure.h"
#include "mtl_file.h"
#include "obj_faces.h"
#include "text_lines.h"

namespace bake {
namespace {

/// Beside the OBJ; Windows separators are understood.
std::filesystem::path beside(const std::string& obj, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return std::filesystem::path(obj).parent_path() / name;
}

/// mtllib may name several files, and names may have blanks in them: the whole line first.
void load_mtl_line(const std::string& obj, const std::string& names, std::size_t line,
                   std::vector<MaterialData>& materials, Warnings& warnings) {
  std::vector<std::string> tried{names};
  if (!std::filesystem::is_regular_file(beside(obj, names))) {
    const std::vector<std::string_view> fields = split_fields(names);
    tried.assign(fields.begin(), fields.end());
  }
  for (const std::string& name : tried) {
    const std::filesystem::path path = beside(obj, name);
    if (std::filesystem::is_regular_file(path)) {
      load_mtl(path.string(), materials, warnings);
    } else {
      warnings.add(at_line(obj, line, "material file " + path.string() + " not found; its materials get albedo 0.5"));
    }
  }
}

/// The scene's material for each name that usemtl gives; 0 where there is none.
std::vector<std::uint32_t> resolve_materials(const std::string& file, const ObjFaces& faces,
                                             const std::vector<MaterialData>& materials, Warnings& warnings) {
  std::unordered_map<std::string, std::uint32_t> ids;
  for (std::size_t i = 1; i < materials.size(); ++i) {
    ids.emplace(materials[i].name, static_cast<std::uint32_t>(i));  // the first of a name counts
  }
  std::vector<std::uint32_t> resolved(faces.material_names.size(), 0);
  for (std::size_t i = 0; i < resolved.size(); ++i) {
    const auto found = ids.find(faces.material_names[i]);
    if (found != ids.end()) {
      resolved[i] = found->second;
      continue;
    }
    const auto user =
        std::find_if(faces.faces.begin(), faces.faces.end(), [i](const ObjFace& face) { return face.material == i; });
    if (user != faces.faces.end()) {
      warnings.add(at_line(file, user->line,
                           "material \"" + faces.material_names[i] + "\" is not defined; its faces get albedo 0.5"));
    }
  }
  return resolved;
}

}  // namespace

SceneData load_obj(const std::string& file, Warnings& warnings) {
  const ObjFaces faces = read_obj_faces(file);
  if (faces.faces.empty()) {
    throw Failure(ExitCode::input, file + ": no faces in it");
  }
  SceneData scene;
  scene.materials.push_back({"default", glm::vec3(0.5f), glm::vec3(0.0f)});
  for (std::size_t i = 0; i < faces.mtl_files.size(); ++i) {
    const auto begin = faces.mtl_files.begin();
    const auto here = begin + static_cast<std::ptrdiff_t>(i);
    if (std::find(begin, here, faces.mtl_files[i]) == here) {
      load_mtl_line(file, faces.mtl_files[i], faces.mtl_lines[i], scene.materials, warnings);
    }
  }
  const std::vector<std::uint32_t> resolved = resolve_materials(file, faces, scene.materials, warnings);
  std::vector<std::uint32_t> face_materials;
  face_materials.reserve(faces.faces.size());
  bool unnamed = false;
  for (const ObjFace& face : faces.faces) {
    if (face.material == k_no_index && !unnamed) {
      unnamed = true;
      warnings.add(at_line(file, face.line, "faces without usemtl, from here on, get albedo 0.5"));
    }
    face_materials.push_back(face.material == k_no_index ? 0 : resolved[face.material]);
  }
  scene.meshes = build_meshes(file, faces, face_materials, warnings);
  return scene;
}

}  // namespace bake
