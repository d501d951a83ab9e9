// The faces of an OBJ file as it states them, before they become meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene_data.h"
#include "warnings.h"

namespace bake {

constexpr std::uint32_t k_no_index = UINT32_MAX;

/// Indices into ObjFaces::positions, uvs, normals; the latter two may be k_no_index.
struct ObjCorner {
  std::uint32_t position, uv, normal;
  bool operator==(const ObjCorner&) const = default;
};

struct ObjFace {
  std::size_t first_corner;
  std::uint32_t corner_count;
  std::uint32_t part;      ///< of ObjFaces::part_names
  std::uint32_t material;  ///< of ObjFaces::material_names, or k_no_index
  std::size_t line;
};

struct ObjFaces {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> colors;  ///< as many as positions, or none
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec3> normals;
  std::vector<ObjCorner> corners;
  std::vector<ObjFace> faces;
  std::vector<std::string> part_names;      ///< objects and groups
  std::vector<std::string> material_names;  ///< as usemtl names them
  std::vector<std::string> mtl_files;       ///< as mtllib names them, whole lines
  std::vector<std::size_t> mtl_lines;
};

/// Reads the statements of the file; indices are resolved and in range.
ObjFaces read_obj_faces(const std::string& file);

/// Triangulates the faces and makes vertices of their corners. face_materials: of the scene's materials, 1 a face.
std::vector<MeshData> build_meshes(const std::string& file, const ObjFaces& faces,
                                   const std::vector<std::uint32_t>& face_materials, Warnings& warnings);

}  // namespace bake
