// radvor_scene_add_mesh: the caller's arrays, checked to the last corner and copied.
#include <algorithm>
#include <cstdio>
#include <utility>

#include "api/checks.h"
#include "api/scene.h"
#include "api/struct_size.h"

using namespace radvor;
using namespace radvor::api;

namespace {

// Vertices or triangles of a scene; ids of what is made from them (corners, sites) stay under 2^32.
constexpr std::uint32_t k_most_elements = 1u << 28;

// A mesh on its way in: its number in the scene, for the sentences, and what the caller wrote.
struct Incoming {
  std::size_t number;
  const radvor_mesh_desc& desc;
};

std::size_t stride_of(const Incoming& in, const char* name, std::size_t given, std::size_t floats) {
  char what[64];
  std::snprintf(what, sizeof what, "mesh %zu: %s_stride", in.number, name);
  return checked_stride(what, given, floats, in.desc.vertex_count);
}

void require_array(const Incoming& in, const void* array, const char* name) {
  if (!array) {
    throw Error(ErrorCode::invalid_argument, "mesh %zu: %s is NULL", in.number, name);
  }
}

void check_counts(const Incoming& in, const radvor_scene& scene) {
  const std::size_t vertices = in.desc.vertex_count, triangles = in.desc.triangle_count;
  if (vertices == 0 || triangles == 0) {
    throw Error(ErrorCode::invalid_argument, "mesh %zu: vertex_count is %zu and triangle_count %zu; neither may be 0",
                in.number, vertices, triangles);
  }
  if (scene.vertices + vertices > k_most_elements || scene.triangles + triangles > k_most_elements) {
    throw Error(ErrorCode::limit, "mesh %zu: the scene would have %zu vertices and %zu triangles, above %" PRIu32,
                in.number, scene.vertices + vertices, scene.triangles + triangles, k_most_elements);
  }
}

// A vector a vertex, every component finite.
template <class Vector>
void copy_vectors(const Incoming& in, const char* name, const float* array, std::size_t stride, ErrorCode code,
                  std::pmr::vector<Vector>& to) {
  to.reserve(in.desc.vertex_count);
  for (std::size_t i = 0; i < in.desc.vertex_count; ++i) {
    const Vector vector = read_element<Vector>(array, stride, i);
    for (int axis = 0; axis < Vector::length(); ++axis) {
      if (!std::isfinite(vector[axis])) {
        throw Error(code, "mesh %zu: component %d of %s[%zu] is %g", in.number, axis, name, i,
                    static_cast<double>(vector[axis]));
      }
    }
    to.push_back(vector);
  }
}

void copy_transform(const Incoming& in, Transform& to) {
  if (!in.desc.transform) {
    return;
  }
  std::copy_n(in.desc.transform, to.size(), to.begin());
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (!std::isfinite(to[i])) {
      throw Error(ErrorCode::invalid_geometry, "mesh %zu: transform[%zu] is %g", in.number, i, to[i]);
    }
  }
}

void check_world_positions(const Incoming& in, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 world = transform_point(mesh.transform, Vec3(mesh.positions[i]));
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(world[axis]) <= k_largest_coordinate)) {  // an overflow's NaN fails too
        throw Error(ErrorCode::limit, "mesh %zu: positions[%zu] comes to %g on axis %d of the world, beyond %g",
                    in.number, i, world[axis], axis, k_largest_coordinate);
      }
    }
  }
}

void check_colors(const Incoming& in, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      if (mesh.colors[i][channel] < 0) {
        throw Error(ErrorCode::invalid_argument, "mesh %zu: component %d of colors[%zu] is %g, below 0", in.number,
                    channel, i, static_cast<double>(mesh.colors[i][channel]));
      }
    }
  }
}

void copy_indices(const Incoming& in, Mesh& mesh) {
  const std::size_t index_size = in.desc.index_size == 0 ? 4 : in.desc.index_size;
  if (index_size != 2 && index_size != 4) {
    throw Error(ErrorCode::invalid_argument, "mesh %zu: index_size is %zu, not 2 or 4", in.number, index_size);
  }
  const std::size_t corners = std::size_t{3} * in.desc.triangle_count;
  mesh.indices.reserve(corners);
  for (std::size_t i = 0; i < corners; ++i) {
    const std::uint32_t index = index_size == 2 ? read_element<std::uint16_t>(in.desc.indices, 2, i)
                                                : read_element<std::uint32_t>(in.desc.indices, 4, i);
    if (index >= in.desc.vertex_count) {
      throw Error(ErrorCode::invalid_geometry,
                  "mesh %zu: corner %zu of triangle %zu has index %" PRIu32 ", but vertex_count is %" PRIu32, in.number,
                  i % 3, i / 3, index, in.desc.vertex_count);
    }
    mesh.indices.push_back(index);
  }
}

void copy_materials(const Incoming& in, std::size_t known, Mesh& mesh) {
  if (!in.desc.triangle_materials) {
    if (in.desc.material >= known) {
      throw Error(ErrorCode::invalid_argument, "mesh %zu: material is %" PRIu32 ", but the scene has %zu materials",
                  in.number, in.desc.material, known);
    }
    mesh.triangle_materials.assign(in.desc.triangle_count, in.desc.material);
    return;
  }
  mesh.triangle_materials.reserve(in.desc.triangle_count);
  for (std::size_t i = 0; i < in.desc.triangle_count; ++i) {
    const auto material = read_element<std::uint32_t>(in.desc.triangle_materials, sizeof(std::uint32_t), i);
    if (material >= known) {
      throw Error(ErrorCode::invalid_argument,
                  "mesh %zu: triangle_materials[%zu] is %" PRIu32 ", but the scene has %zu materials", in.number, i,
                  material, known);
    }
    mesh.triangle_materials.push_back(material);
  }
}

// The caller's mistakes, in one order: flags and pointers, sizes, ids, then the values in the arrays.
Mesh checked_mesh(const Incoming& in, const radvor_scene& scene) {
  const radvor_mesh_desc& desc = in.desc;
  char what[64];
  std::snprintf(what, sizeof what, "mesh %zu: flags", in.number);
  check_flags(what, desc.flags, RADVOR_MESH_NO_RECEIVE | RADVOR_MESH_NO_CAST | RADVOR_MESH_CLOCKWISE);
  require_array(in, desc.positions, "positions");
  require_array(in, desc.indices, "indices");
  check_counts(in, scene);
  const std::size_t position_stride = stride_of(in, "position", desc.position_stride, 3);
  const std::size_t normal_stride = stride_of(in, "normal", desc.normal_stride, 3);
  const std::size_t color_stride = stride_of(in, "color", desc.color_stride, 3);
  const std::size_t uv_stride = stride_of(in, "uv", desc.uv_stride, 2);

  Mesh mesh(&scene.context->host.memory);
  mesh.receives = (desc.flags & RADVOR_MESH_NO_RECEIVE) == 0;
  mesh.casts = (desc.flags & RADVOR_MESH_NO_CAST) == 0;
  mesh.clockwise = (desc.flags & RADVOR_MESH_CLOCKWISE) != 0;
  copy_materials(in, scene.scene.materials.size(), mesh);
  copy_indices(in, mesh);
  copy_transform(in, mesh.transform);
  copy_vectors(in, "positions", desc.positions, position_stride, ErrorCode::invalid_geometry, mesh.positions);
  check_world_positions(in, mesh);
  if (desc.normals) {
    copy_vectors(in, "normals", desc.normals, normal_stride, ErrorCode::invalid_geometry, mesh.normals);
  }
  if (desc.colors) {
    copy_vectors(in, "colors", desc.colors, color_stride, ErrorCode::invalid_argument, mesh.colors);
    check_colors(in, mesh);
  }
  if (desc.uvs) {
    copy_vectors(in, "uvs", desc.uvs, uv_stride, ErrorCode::invalid_geometry, mesh.uvs);
  }
  return mesh;
}

}  // namespace

radvor_result radvor_scene_add_mesh(radvor_scene* scene, const radvor_mesh_desc* desc, uint32_t* mesh) {
  return enter(context_of(scene), __func__, [&] {
    require(desc, "desc");
    require(mesh, "mesh");
    const radvor_mesh_desc known = read_struct(desc, "radvor_mesh_desc");
    auto& meshes = scene->scene.meshes;
    const Incoming incoming{meshes.size(), known};
    meshes.push_back(checked_mesh(incoming, *scene));
    scene->vertices += known.vertex_count;
    scene->triangles += known.triangle_count;
    *mesh = static_cast<std::uint32_t>(meshes.size() - 1);
  });
}
