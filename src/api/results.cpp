// What is read of a solution: radvor_solution_vertices, _points, _mesh and _stats.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "api/checks.h"
#include "api/solution.h"
#include "api/struct_size.h"
#include "output/vertices.h"

using namespace radvor;
using namespace radvor::api;

namespace {

static_assert(static_cast<std::uint32_t>(Quantity::irradiance) == RADVOR_IRRADIANCE);
static_assert(static_cast<std::uint32_t>(Quantity::direct) == RADVOR_IRRADIANCE_DIRECT);
static_assert(static_cast<std::uint32_t>(Quantity::indirect) == RADVOR_IRRADIANCE_INDIRECT);
static_assert(static_cast<std::uint32_t>(Quantity::radiance) == RADVOR_RADIANCE);
static_assert(static_cast<std::uint32_t>(VertexMode::sample) == RADVOR_VERTEX_SAMPLE);
static_assert(static_cast<std::uint32_t>(VertexMode::fit) == RADVOR_VERTEX_FIT);

Quantity checked_quantity(std::uint32_t quantity) {
  if (quantity > RADVOR_RADIANCE) {
    throw Error(ErrorCode::invalid_argument,
                "quantity is 0x%" PRIx32 ", which is no RADVOR_IRRADIANCE*, RADVOR_RADIANCE", quantity);
  }
  return static_cast<Quantity>(quantity);
}

const Mesh& checked_mesh(const radvor_solution& solution, std::uint32_t mesh) {
  const auto& meshes = solution.bake.scene().meshes;
  if (mesh >= meshes.size()) {
    throw Error(ErrorCode::invalid_argument, "mesh is %" PRIu32 ", but the scene had %zu meshes", mesh, meshes.size());
  }
  return meshes[mesh];
}

void check_points(std::uint32_t count, const double* positions, const float* normals) {
  const auto check = [](const char* what, std::size_t i, double value) {
    if (!std::isfinite(value)) {
      throw Error(ErrorCode::invalid_geometry, "component %zu of %s[%zu] is %g", i % 3, what, i / 3, value);
    }
  };
  for (std::size_t i = 0; i < std::size_t{3} * count; ++i) {
    check("positions", i, positions[i]);
    check("normals", i, normals[i]);
  }
}

const PointIndex& point_index_of(const radvor_solution& solution) {
  const std::lock_guard<std::mutex> lock(solution.point_index_mutex);
  if (!solution.point_index) {
    solution.point_index.emplace(LitSurface(solution.bake));
  }
  return *solution.point_index;
}

const AdaptiveMesh& adaptive_mesh_of(radvor_solution& solution, std::uint32_t mesh) {
  // A vector of its final size: views of other meshes stay where they are.
  if (solution.meshes.empty()) {
    solution.meshes.resize(solution.bake.scene().meshes.size());
  }
  std::optional<AdaptiveMesh>& made = solution.meshes[mesh];
  if (!made) {
    made.emplace(make_adaptive_mesh(solution.bake, mesh));
  }
  return *made;
}

// Arrays of vectors go out as arrays of floats.
template <class Vectors>
const float* floats_of(const Vectors& vectors) {
  static_assert(sizeof(typename Vectors::value_type) == sizeof(float) * Vectors::value_type::length());
  return vectors.empty() ? nullptr : &vectors.front().x;
}

radvor_output_mesh view_of(const AdaptiveMesh& mesh) {
  radvor_output_mesh view{};
  view.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  view.triangle_count = static_cast<std::uint32_t>(mesh.materials.size());
  view.positions = floats_of(mesh.positions);
  view.normals = floats_of(mesh.normals);
  view.uvs = floats_of(mesh.uvs);
  view.irradiance = floats_of(mesh.irradiance);
  view.radiance = floats_of(mesh.radiance);
  view.indices = mesh.indices.data();
  view.materials = mesh.materials.data();
  view.source_triangles = mesh.source_triangles.data();
  view.source_weights = mesh.source_weights.data();
  return view;
}

radvor_stats stats_of(const radvor_solution& solution) {
  const Bake& bake = solution.bake;
  const WeldedScene& welded = bake.welded();
  const Surface& surface = bake.surface();
  const BakeStats light = bake.stats();
  radvor_stats stats{};
  stats.facets = static_cast<std::uint32_t>(bake.facets().facets.size());
  stats.patches = surface.patch_count();
  stats.elements = static_cast<std::uint32_t>(surface.samples().size());
  stats.sites = static_cast<std::uint32_t>(surface.sites().size());
  stats.triangles = surface.triangle_count();
  stats.constraints = surface.constraint_count();
  stats.repaired_triangles = welded.degenerate_triangles + welded.duplicate_triangles;
  stats.repaired_t_junctions = welded.t_junctions;
  stats.intersections = static_cast<std::uint32_t>(bake.facets().contacts.edges.size());
  stats.shots = light.shots;
  stats.rays = light.rays;
  stats.form_factors = light.form_factors;
  stats.skipped_facing = light.skipped_facing;
  stats.skipped_negligible = light.skipped_negligible;
  stats.skipped_lazy = light.skipped_lazy;
  stats.skipped_clear = light.skipped_clear;
  stats.ties = light.ties;
  stats.realigned_ties = light.realigned_ties;
  stats.seconds_setup = light.seconds_setup;
  stats.seconds_direct = light.seconds_direct;
  stats.seconds_indirect = light.seconds_indirect;
  stats.seconds_rays = light.seconds_rays;
  stats.emitted_power = light.emitted_power;
  stats.absorbed_power = light.absorbed_power;
  stats.absorbed_back_power = light.absorbed_back_power;
  stats.unshot_power = light.unshot_power;
  stats.escaped_power = light.escaped_power;
  stats.peak_bytes = solution.context->host.memory.peak_bytes() + solution.visibility_bytes;
  return stats;
}

}  // namespace

radvor_result radvor_solution_vertices(const radvor_solution* solution, uint32_t mesh, uint32_t quantity, uint32_t mode,
                                       float* rgb, size_t stride, uint32_t vertex_count) {
  return enter(context_of(solution), __func__, [&] {
    require(rgb, "rgb");
    const Mesh& asked = checked_mesh(*solution, mesh);
    const bool back = (quantity & RADVOR_SIDE_BACK) != 0;
    const Quantity checked = checked_quantity(quantity & ~std::uint32_t{RADVOR_SIDE_BACK});
    if (mode > RADVOR_VERTEX_FIT) {
      throw Error(ErrorCode::invalid_argument, "mode is %" PRIu32 ", which is no RADVOR_VERTEX_*", mode);
    }
    if (vertex_count != asked.positions.size()) {
      throw Error(ErrorCode::invalid_argument, "vertex_count is %" PRIu32 ", but mesh %" PRIu32 " has %zu vertices",
                  vertex_count, mesh, asked.positions.size());
    }
    const std::size_t checked_bytes = checked_stride("stride", stride, 3, vertex_count);
    if (checked_bytes % alignof(float) != 0) {
      throw Error(ErrorCode::invalid_argument, "stride is %zu bytes, no multiple of %zu", stride, alignof(float));
    }
    write_vertices(solution->bake, mesh, checked, back, static_cast<VertexMode>(mode), rgb, checked_bytes);
  });
}

radvor_result radvor_solution_points(const radvor_solution* solution, uint32_t quantity, uint32_t count,
                                     const double* positions, const float* normals, double max_distance, float* rgb,
                                     uint8_t* found) {
  return enter(context_of(solution), __func__, [&] {
    if ((quantity & RADVOR_SIDE_BACK) != 0) {
      throw Error(ErrorCode::invalid_argument,
                  "quantity has RADVOR_SIDE_BACK, but the normals say which side is meant");
    }
    const Quantity checked = checked_quantity(quantity);
    if (!(max_distance >= 0)) {
      throw Error(ErrorCode::invalid_argument, "max_distance is %g, not at least 0", max_distance);
    }
    if (count == 0) {
      return;
    }
    require(positions, "positions");
    require(normals, "normals");
    require(rgb, "rgb");
    check_points(count, positions, normals);
    point_index_of(*solution).sample(LitSurface(solution->bake), checked, count, positions, normals, max_distance, rgb,
                                     found);
  });
}

radvor_result radvor_solution_mesh(radvor_solution* solution, uint32_t mesh, radvor_output_mesh* output) {
  return enter(context_of(solution), __func__, [&] {
    require(output, "output");
    check_output_struct(output, "radvor_output_mesh");
    checked_mesh(*solution, mesh);
    write_struct(output, view_of(adaptive_mesh_of(*solution, mesh)));
  });
}

radvor_result radvor_solution_stats(const radvor_solution* solution, radvor_stats* stats) {
  return enter(context_of(solution), __func__, [&] {
    require(stats, "stats");
    check_output_struct(stats, "radvor_stats");
    write_struct(stats, stats_of(*solution));
  });
}
