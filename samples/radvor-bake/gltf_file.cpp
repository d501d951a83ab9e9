#include "gltf_file.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "failure.h"
#include "output_file.h"

namespace bake {
namespace {

/// One buffer view for each kind of data, shared by all meshes: thousands of meshes do not make thousands of views.
enum Kind : std::size_t { k_positions, k_normals, k_colors, k_irradiance, k_uvs, k_indices, k_kind_count };

struct KindOfData {
  int type, component, target;
  std::size_t stride;
};

constexpr KindOfData k_kinds[k_kind_count] = {
    {TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER, 12},
    {TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER, 12},
    {TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER, 12},
    {TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER, 12},
    {TINYGLTF_TYPE_VEC2, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TARGET_ARRAY_BUFFER, 8},
    {TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, 4},
};

/// Names in an OBJ may be in any encoding, those in a glTF are UTF-8: other bytes become replacement characters.
std::string utf8(const std::string& name) {
  using Json = nlohmann::json;
  return Json::parse(Json(name).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

class GlbBuilder {
 public:
  explicit GlbBuilder(double scale) : extras_({{"radvor_color_scale", tinygltf::Value(scale)}}), scale_(scale) {
    model_.asset.version = "2.0";
    model_.asset.generator = "radvor-bake";
    model_.extensionsUsed = {"KHR_materials_unlit"};
    model_.scenes.emplace_back();
    model_.scenes[0].extras = tinygltf::Value(extras_);
    model_.defaultScene = 0;
  }

  void add_material(const MaterialData& data);
  void add_mesh(const BakedMesh& baked);
  tinygltf::Model finish();

 private:
  int add_accessor(Kind kind, const void* data, std::size_t count);
  int add_positions(const radvor_output_mesh& mesh);
  int add_normals(const radvor_output_mesh& mesh);
  int add_colors(const radvor_output_mesh& mesh);

  tinygltf::Model model_;
  tinygltf::Value::Object extras_;
  double scale_;
  std::vector<unsigned char> data_[k_kind_count];
};

void GlbBuilder::add_material(const MaterialData& data) {
  tinygltf::Material material;
  material.name = utf8(data.name);
  material.pbrMetallicRoughness.baseColorFactor = {data.albedo.x, data.albedo.y, data.albedo.z, 1.0};
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object{});
  const double strength = std::max({data.emission.x, data.emission.y, data.emission.z});
  if (strength > 0) {
    const double divisor = std::max(strength, 1.0);
    material.emissiveFactor = {data.emission.x / divisor, data.emission.y / divisor, data.emission.z / divisor};
    if (strength > 1) {
      const std::string name = "KHR_materials_emissive_strength";
      material.extensions[name] =
          tinygltf::Value(tinygltf::Value::Object{{"emissiveStrength", tinygltf::Value(strength)}});
      if (model_.extensionsUsed.size() == 1) {
        model_.extensionsUsed.push_back(name);
      }
    }
  }
  model_.materials.push_back(std::move(material));
}

int GlbBuilder::add_accessor(Kind kind, const void* data, std::size_t count) {
  std::vector<unsigned char>& bytes = data_[kind];
  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(kind);
  accessor.byteOffset = bytes.size();
  accessor.componentType = k_kinds[kind].component;
  accessor.type = k_kinds[kind].type;
  accessor.count = count;
  const auto* from = static_cast<const unsigned char*>(data);
  bytes.insert(bytes.end(), from, from + count * k_kinds[kind].stride);
  model_.accessors.push_back(std::move(accessor));
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GlbBuilder::add_positions(const radvor_output_mesh& mesh) {
  const int id = add_accessor(k_positions, mesh.positions, mesh.vertex_count);
  tinygltf::Accessor& accessor = model_.accessors.back();
  accessor.minValues.assign(mesh.positions, mesh.positions + 3);
  accessor.maxValues = accessor.minValues;
  for (std::size_t i = 3; i < 3 * std::size_t{mesh.vertex_count}; ++i) {
    accessor.minValues[i % 3] = std::min(accessor.minValues[i % 3], double{mesh.positions[i]});
    accessor.maxValues[i % 3] = std::max(accessor.maxValues[i % 3], double{mesh.positions[i]});
  }
  return id;
}

/// The format wants unit length to 1e-4 or so.
int GlbBuilder::add_normals(const radvor_output_mesh& mesh) {
  std::vector<float> normals(mesh.normals, mesh.normals + 3 * std::size_t{mesh.vertex_count});
  for (std::size_t i = 0; i < normals.size(); i += 3) {
    const float length = std::hypot(normals[i], normals[i + 1], normals[i + 2]);
    for (std::size_t c = 0; c < 3; ++c) {
      normals[i + c] = length > 0 ? normals[i + c] / length : (c == 1 ? 1.0f : 0.0f);
    }
  }
  return add_accessor(k_normals, normals.data(), mesh.vertex_count);
}

int GlbBuilder::add_colors(const radvor_output_mesh& mesh) {
  std::vector<float> colors(3 * std::size_t{mesh.vertex_count});
  for (std::size_t i = 0; i < colors.size(); ++i) {
    colors[i] = static_cast<float>(std::min(1.0, double{mesh.irradiance[i]} * std::numbers::inv_pi * scale_));
  }
  return add_accessor(k_colors, colors.data(), mesh.vertex_count);
}

void GlbBuilder::add_mesh(const BakedMesh& baked) {
  const radvor_output_mesh& mesh = baked.mesh;
  if (mesh.triangle_count == 0) {
    return;  // all of it was degenerate; the format has no empty meshes
  }
  std::map<std::string, int> attributes{
      {"POSITION", add_positions(mesh)},
      {"NORMAL", add_normals(mesh)},
      {"COLOR_0", add_colors(mesh)},
      {"_RADVOR_IRRADIANCE", add_accessor(k_irradiance, mesh.irradiance, mesh.vertex_count)}};
  if (mesh.uvs != nullptr) {
    attributes["TEXCOORD_0"] = add_accessor(k_uvs, mesh.uvs, mesh.vertex_count);
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_material;
  for (std::size_t t = 0; t < mesh.triangle_count; ++t) {
    std::vector<std::uint32_t>& indices = by_material[mesh.materials[t]];
    indices.insert(indices.end(), mesh.indices + 3 * t, mesh.indices + 3 * t + 3);
  }
  tinygltf::Mesh out;
  out.name = utf8(baked.source->name);
  out.extras = tinygltf::Value(extras_);
  for (const auto& [material, indices] : by_material) {
    tinygltf::Primitive primitive;
    primitive.attributes = attributes;
    primitive.indices = add_accessor(k_indices, indices.data(), indices.size());
    primitive.material = static_cast<int>(material);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    out.primitives.push_back(std::move(primitive));
  }
  tinygltf::Node node;
  node.name = out.name;
  node.mesh = static_cast<int>(model_.meshes.size());
  model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
  model_.nodes.push_back(std::move(node));
  model_.meshes.push_back(std::move(out));
}

tinygltf::Model GlbBuilder::finish() {
  int views[k_kind_count];
  tinygltf::Buffer buffer;
  for (std::size_t kind = 0; kind < k_kind_count; ++kind) {
    if (data_[kind].empty()) {
      continue;  // no scene has UVs in no mesh and a view for them
    }
    views[kind] = static_cast<int>(model_.bufferViews.size());
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.data.size();
    view.byteLength = data_[kind].size();
    view.byteStride = k_kinds[kind].target == TINYGLTF_TARGET_ARRAY_BUFFER ? k_kinds[kind].stride : 0;
    view.target = k_kinds[kind].target;
    buffer.data.insert(buffer.data.end(), data_[kind].begin(), data_[kind].end());
    model_.bufferViews.push_back(std::move(view));
    data_[kind] = {};
  }
  for (tinygltf::Accessor& accessor : model_.accessors) {
    accessor.bufferView = views[accessor.bufferView];
  }
  if (!buffer.data.empty()) {
    model_.buffers.push_back(std::move(buffer));
  }
  return std::move(model_);
}

}  // namespace

void save_glb(const std::string& file, const SceneData& scene, const std::vector<BakedMesh>& meshes) {
  double brightest = 0;
  std::size_t bytes = 0;
  for (const BakedMesh& baked : meshes) {
    const radvor_output_mesh& mesh = baked.mesh;
    if (mesh.triangle_count == 0) {
      continue;
    }
    for (std::size_t i = 0; i < 3 * std::size_t{mesh.vertex_count}; ++i) {
      brightest = std::max(brightest, double{mesh.irradiance[i]} * std::numbers::inv_pi);
    }
    bytes += std::size_t{mesh.vertex_count} * 56 + std::size_t{mesh.triangle_count} * 12;
  }
  if (bytes > (std::size_t{1} << 32) - (std::size_t{1} << 28)) {
    throw Failure(ExitCode::output, file + ": more than 4 GiB, which a .glb cannot hold; try .ply");
  }
  GlbBuilder builder(brightest > 0 ? 1 / brightest : 1);
  for (const MaterialData& material : scene.materials) {
    builder.add_material(material);
  }
  for (const BakedMesh& baked : meshes) {
    builder.add_mesh(baked);
  }
  tinygltf::Model model = builder.finish();
  OutputFile out(file);
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out.stream(), false, true);
  out.close();
}

}  // namespace bake
