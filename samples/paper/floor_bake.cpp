#include "floor_bake.h"

#include <algorithm>
#include <glm/vec3.hpp>
#include <map>
#include <stdexcept>
#include <utility>

namespace paper {
namespace {

/// The experiment's plan is (x, y), its heights z; in the scene y is up and the plan is (x, -z), so that it stays
/// counter-clockwise from above.
glm::vec3 in_scene(const glm::dvec2& at, double height) {
  return {static_cast<float>(at.x), static_cast<float>(height), static_cast<float>(-at.y)};
}

std::vector<glm::vec3> in_scene(std::vector<glm::dvec2> polygon, double height, bool faces_down) {
  if (faces_down) {
    std::reverse(polygon.begin(), polygon.end());
  }
  std::vector<glm::vec3> corners;
  corners.reserve(polygon.size());
  for (const glm::dvec2& corner : polygon) {
    corners.push_back(in_scene(corner, height));
  }
  return corners;
}

std::uint32_t add_material(radvor_scene* scene, const radvor_context* context, double radiance) {
  radvor_material_desc desc{};
  desc.struct_size = sizeof desc;
  std::fill_n(desc.emission, 3, static_cast<float>(radiance));
  std::uint32_t material = 0;
  check(radvor_scene_add_material(scene, &desc, &material), context, "a material");
  return material;
}

}  // namespace

void check(radvor_result result, const radvor_context* context, const char* what) {
  if (result < 0) {
    throw std::runtime_error(std::string(what) + ": " + radvor_context_error(context) + " (" +
                             radvor_result_string(result) + ")");
  }
}

Context make_context() {
  radvor_context* context = nullptr;
  check(radvor_context_create(nullptr, &context), nullptr, "the context");
  return Context(context);
}

FloorBake::FloorBake(const Experiment& experiment, radvor_bake_options options) : context_(make_context()) {
  radvor_scene* scene = nullptr;
  check(radvor_scene_create(context_.get(), &scene), context_.get(), "the scene");
  scene_.reset(scene);
  const std::uint32_t dark = add_material(scene, context_.get(), 0);
  const std::uint32_t light = add_material(scene, context_.get(), experiment.radiance);
  add_mesh(in_scene({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0, false), dark, 0);
  add_mesh(in_scene(experiment.emitter, experiment.emitter_height, true), light, RADVOR_MESH_NO_RECEIVE);
  add_mesh(in_scene(experiment.occluder, experiment.occluder_height, false), dark, RADVOR_MESH_NO_RECEIVE);
  options.struct_size = sizeof options;
  radvor_solution* solution = nullptr;
  check(radvor_bake(scene, &options, &solution), context_.get(), "the bake");
  solution_.reset(solution);
  read_floor();
}

void FloorBake::add_mesh(const std::vector<glm::vec3>& corners, std::uint32_t material, std::uint32_t flags) {
  std::vector<std::uint32_t> fan;
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    fan.insert(fan.end(), {0, i - 1, i});
  }
  radvor_mesh_desc desc{};
  desc.struct_size = sizeof desc;
  desc.flags = flags;
  desc.vertex_count = static_cast<std::uint32_t>(corners.size());
  desc.triangle_count = static_cast<std::uint32_t>(fan.size() / 3);
  desc.positions = &corners.front().x;
  desc.indices = fan.data();
  desc.material = material;
  std::uint32_t mesh = 0;
  check(radvor_scene_add_mesh(scene_.get(), &desc, &mesh), context_.get(), "a mesh");
}

void FloorBake::read_floor() {
  radvor_output_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  check(radvor_solution_mesh(solution_.get(), 0, &mesh), context_.get(), "the floor's mesh");
  std::map<std::pair<float, float>, std::uint32_t> ids;
  std::vector<std::uint32_t> site_of_vertex;
  for (std::size_t v = 0; v < mesh.vertex_count; ++v) {
    const float x = mesh.positions[3 * v];
    const float y = -mesh.positions[3 * v + 2];
    const auto [entry, fresh] = ids.try_emplace({x, y}, static_cast<std::uint32_t>(floor_.sites.size()));
    if (fresh) {
      floor_.sites.emplace_back(x, y);
      floor_.irradiance.push_back(static_cast<double>(mesh.irradiance[3 * v]));
    }
    site_of_vertex.push_back(entry->second);
  }
  for (std::size_t i = 0; i < 3 * std::size_t{mesh.triangle_count}; ++i) {
    floor_.triangles.push_back(site_of_vertex[mesh.indices[i]]);
  }
}

std::vector<double> FloorBake::measure(const std::vector<glm::dvec2>& points) const {
  std::vector<double> positions;
  std::vector<float> normals;
  for (const glm::dvec2& point : points) {
    positions.insert(positions.end(), {point.x, 0, -point.y});
    normals.insert(normals.end(), {0, 1, 0});
  }
  std::vector<float> rgb(3 * points.size());
  check(radvor_solution_points(solution_.get(), RADVOR_IRRADIANCE, static_cast<std::uint32_t>(points.size()),
                               positions.data(), normals.data(), 1e-3, rgb.data(), nullptr),
        context_.get(), "the points");
  std::vector<double> irradiance;
  for (std::size_t i = 0; i < points.size(); ++i) {
    irradiance.push_back(static_cast<double>(rgb[3 * i]));
  }
  return irradiance;
}

radvor_stats FloorBake::stats() const {
  radvor_stats stats{};
  stats.struct_size = sizeof stats;
  check(radvor_solution_stats(solution_.get(), &stats), context_.get(), "the statistics");
  return stats;
}

}  // namespace paper
