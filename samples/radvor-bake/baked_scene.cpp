#include "baked_scene.h"

#include "failure.h"

namespace bake {
namespace {

std::uint32_t size32(std::size_t size) {
  if (size > UINT32_MAX) {
    throw Failure(ExitCode::bake, "the scene is too large: counts are of 32 bits");
  }
  return static_cast<std::uint32_t>(size);
}

template <class Vector>
const float* floats(const std::vector<Vector>& vectors) {
  return vectors.empty() ? nullptr : &vectors.front().x;
}

}  // namespace

BakedScene::BakedScene(const SceneData& scene, const Options& options, Log log, void* log_user)
    : data_(scene), options_(options.bake) {
  radvor_context_desc desc{};
  desc.struct_size = sizeof desc;
  desc.thread_count = options.threads;
  desc.embree_path = options.embree.empty() ? nullptr : options.embree.c_str();
  desc.user = log_user;
  desc.log = log;
  radvor_context* context = nullptr;
  const radvor_result created = radvor_context_create(&desc, &context);
  context_.reset(context);
  if (created < 0) {  // no context, so the reason went to the log alone
    throw Failure(ExitCode::bake, std::string("radvor cannot start: ") + radvor_result_string(created));
  }
  radvor_scene* handle = nullptr;
  check(radvor_scene_create(context, &handle), "creating the scene");
  scene_.reset(handle);
  add_materials();
  for (const MeshData& mesh : scene.meshes) {
    add_mesh(mesh);
  }
  for (const radvor_light_desc& light : options.lights) {
    std::uint32_t id = 0;
    check(radvor_scene_add_light(scene_.get(), &light, &id), "adding a light");
  }
}

void BakedScene::add_materials() {
  for (const MaterialData& material : data_.materials) {
    radvor_material_desc desc{};
    desc.struct_size = sizeof desc;
    for (int c = 0; c < 3; ++c) {
      desc.albedo[c] = material.albedo[c];
      desc.emission[c] = material.emission[c];
    }
    std::uint32_t id = 0;
    check(radvor_scene_add_material(scene_.get(), &desc, &id), "material " + material.name);
  }
}

void BakedScene::add_mesh(const MeshData& mesh) {
  radvor_mesh_desc desc{};
  desc.struct_size = sizeof desc;
  desc.vertex_count = size32(mesh.positions.size());
  desc.triangle_count = size32(mesh.triangle_materials.size());
  desc.positions = floats(mesh.positions);
  desc.normals = floats(mesh.normals);
  desc.colors = floats(mesh.colors);
  desc.uvs = floats(mesh.uvs);
  desc.indices = mesh.indices.data();
  desc.triangle_materials = mesh.triangle_materials.data();
  std::uint32_t id = 0;
  check(radvor_scene_add_mesh(scene_.get(), &desc, &id), "mesh \"" + mesh.name + "\"");
}

radvor_result BakedScene::run(Progress progress, void* progress_user) {
  options_.progress = progress;
  options_.progress_user = progress_user;
  radvor_solution* solution = nullptr;
  const radvor_result result = radvor_bake(scene_.get(), &options_, &solution);
  solution_.reset(solution);
  check(result, "the bake");
  return result;
}

radvor_result BakedScene::create() {
  radvor_solution* solution = nullptr;
  const radvor_result result = radvor_solution_create(scene_.get(), &options_, &solution);
  solution_.reset(solution);
  check(result, "the geometry");
  return result;
}

radvor_result BakedScene::advance(double seconds) {
  const radvor_result result = radvor_solution_advance(solution_.get(), seconds, nullptr);
  check(result, "the bake");
  return result;
}

std::vector<BakedMesh> BakedScene::meshes() {
  std::vector<BakedMesh> meshes;
  for (std::size_t id = 0; id < data_.meshes.size(); ++id) {
    BakedMesh baked{&data_.meshes[id], {}};
    baked.mesh.struct_size = sizeof baked.mesh;
    check(radvor_solution_mesh(solution_.get(), size32(id), &baked.mesh), "mesh \"" + data_.meshes[id].name + "\"");
    meshes.push_back(baked);
  }
  return meshes;
}

radvor_stats BakedScene::stats() const {
  radvor_stats stats{};
  stats.struct_size = sizeof stats;
  check(radvor_solution_stats(solution_.get(), &stats), "the statistics");
  return stats;
}

std::vector<float> BakedScene::vertices(std::uint32_t quantity) const {
  std::vector<float> rgb;
  for (std::size_t id = 0; id < data_.meshes.size(); ++id) {
    const std::size_t count = data_.meshes[id].positions.size(), first = rgb.size();
    rgb.resize(first + 3 * count);
    check(radvor_solution_vertices(solution_.get(), size32(id), quantity, RADVOR_VERTEX_SAMPLE, rgb.data() + first,
                                   3 * sizeof(float), size32(count)),
          "light at the vertices");
  }
  return rgb;
}

void BakedScene::measure(const Points& points, std::uint32_t quantity, double max_distance, std::vector<float>& rgb,
                         std::vector<std::uint8_t>& found) const {
  rgb.assign(points.count() * 3, 0.0f);
  found.assign(points.count(), 0);
  if (points.count() > 0) {
    check(radvor_solution_points(solution_.get(), quantity, size32(points.count()), points.positions.data(),
                                 points.normals.data(), max_distance, rgb.data(), found.data()),
          "measuring at the points");
  }
}

void BakedScene::check(radvor_result result, const std::string& what) const {
  if (result < 0) {
    throw Failure(ExitCode::bake,
                  what + ": " + radvor_context_error(context_.get()) + " (" + radvor_result_string(result) + ")");
  }
}

}  // namespace bake
