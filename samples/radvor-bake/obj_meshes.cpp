// The second half of reading an OBJ: corners that agree in position, normal and UV become one vertex.
#include <array>
#include <span>
#include <unordered_map>

#include "failure.h"
#include "obj_faces.h"
#include "polygon.h"

namespace bake {
namespace {

struct CornerHash {
  std::size_t operator()(const ObjCorner& corner) const noexcept {
    std::uint64_t hash = corner.position;
    hash = hash * 0x9E3779B97F4A7C15u + corner.uv;
    hash = hash * 0x9E3779B97F4A7C15u + corner.normal;
    return static_cast<std::size_t>(hash ^ (hash >> 29));
  }
};

/// Faces of one part that have the same attributes.
struct MeshKey {
  std::uint32_t part;
  bool normals, uvs;
  bool operator==(const MeshKey&) const = default;
};

struct MeshKeyHash {
  std::size_t operator()(const MeshKey& key) const noexcept {
    return (std::size_t{key.part} << 2) | (key.normals ? 2u : 0u) | (key.uvs ? 1u : 0u);
  }
};

class MeshBuilder {
 public:
  MeshBuilder(const ObjFaces& faces, std::string name) : faces_(faces) { mesh_.name = std::move(name); }

  std::uint32_t vertex(const ObjCorner& corner, bool normals, bool uvs) {
    const ObjCorner key{corner.position, uvs ? corner.uv : k_no_index, normals ? corner.normal : k_no_index};
    const auto [entry, fresh] = vertices_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (fresh) {
      mesh_.positions.emplace_back(faces_.positions[key.position]);
      if (normals) {
        mesh_.normals.push_back(faces_.normals[key.normal]);
      }
      if (uvs) {
        mesh_.uvs.push_back(faces_.uvs[key.uv]);
      }
      if (!faces_.colors.empty()) {
        mesh_.colors.push_back(faces_.colors[key.position]);
      }
    }
    return entry->second;
  }

  void add_triangle(const std::array<std::uint32_t, 3>& vertices, std::uint32_t material) {
    mesh_.indices.insert(mesh_.indices.end(), vertices.begin(), vertices.end());
    mesh_.triangle_materials.push_back(material);
  }

  MeshData take() { return std::move(mesh_); }

 private:
  const ObjFaces& faces_;
  MeshData mesh_;
  std::unordered_map<ObjCorner, std::uint32_t, CornerHash> vertices_;
};

/// Without corners that repeat the one before them.
std::vector<ObjCorner> distinct_corners(const ObjFaces& faces, const ObjFace& face) {
  std::vector<ObjCorner> corners;
  for (std::size_t i = face.first_corner; i < face.first_corner + face.corner_count; ++i) {
    if (corners.empty() || corners.back().position != faces.corners[i].position) {
      corners.push_back(faces.corners[i]);
    }
  }
  while (corners.size() > 1 && corners.back().position == corners.front().position) {
    corners.pop_back();
  }
  return corners;
}

}  // namespace

std::vector<MeshData> build_meshes(const std::string& file, const ObjFaces& faces,
                                   const std::vector<std::uint32_t>& face_materials, Warnings& warnings) {
  std::vector<MeshBuilder> builders;
  std::unordered_map<MeshKey, std::size_t, MeshKeyHash> ids;
  std::vector<glm::dvec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t f = 0; f < faces.faces.size(); ++f) {
    const ObjFace& face = faces.faces[f];
    const std::vector<ObjCorner> corners = distinct_corners(faces, face);
    if (corners.size() < 3) {
      warnings.add(at_line(file, face.line, "a face with fewer than three different corners was left out"));
      continue;
    }
    points.clear();
    MeshKey key{face.part, true, true};
    for (const ObjCorner& corner : corners) {
      points.push_back(faces.positions[corner.position]);
      key.normals = key.normals && corner.normal != k_no_index;
      key.uvs = key.uvs && corner.uv != k_no_index;
    }
    if (!triangulate(points, triangles)) {
      warnings.add(at_line(file, face.line, "a face crosses itself or has no area"));
    }
    const auto [entry, fresh] = ids.try_emplace(key, builders.size());
    if (fresh) {
      builders.emplace_back(faces, faces.part_names[face.part]);
    }
    MeshBuilder& builder = builders[entry->second];
    for (const std::array<std::uint32_t, 3>& triangle : triangles) {
      std::array<std::uint32_t, 3> vertices{};
      for (std::size_t i = 0; i < 3; ++i) {
        vertices[i] = builder.vertex(corners[triangle[i]], key.normals, key.uvs);
      }
      builder.add_triangle(vertices, face_materials[f]);
    }
  }
  std::vector<MeshData> meshes;
  for (MeshBuilder& builder : builders) {
    meshes.push_back(builder.take());
    if (meshes.back().indices.empty()) {
      meshes.pop_back();
    }
  }
  return meshes;
}

}  // namespace bake
