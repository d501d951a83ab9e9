// All that can be read of a solution, for comparing two of them and for looking whether it is sane.
#pragma once

#include <gtest/gtest.h>
#include <radvor.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace radvor::test {

struct LightOf {
  std::vector<std::vector<float>> vertices;  ///< 3 floats a vertex, for each quantity
  std::vector<float> points;                 ///< at and above the centre of the unit square y = 0, facing up
  std::vector<std::uint8_t> found;
  std::string mesh_bytes;  ///< all arrays of the adaptive mesh
  std::uint32_t mesh_triangles = 0;
  std::array<std::uint32_t, 5> counts{};  ///< of facets, elements, sites, triangles and constraints

  bool operator==(const LightOf& other) const {
    return vertices == other.vertices && points == other.points && found == other.found &&
           mesh_bytes == other.mesh_bytes && counts == other.counts;
  }
};

/// Reads mesh 0 of a solution in every way, checking results, finiteness and counts on the way.
inline LightOf read_light(radvor_solution* solution, std::uint32_t vertex_count) {
  LightOf light;
  for (std::uint32_t quantity = RADVOR_IRRADIANCE; quantity <= RADVOR_RADIANCE; ++quantity) {
    std::vector<float> rgb(std::size_t{3} * vertex_count, NAN);
    EXPECT_EQ(radvor_solution_vertices(solution, 0, quantity, RADVOR_VERTEX_SAMPLE, rgb.data(), 0, vertex_count),
              RADVOR_OK);
    for (const float value : rgb) {
      EXPECT_TRUE(std::isfinite(value) && value >= 0) << value << " of quantity " << quantity;
    }
    light.vertices.push_back(std::move(rgb));
  }

  const double positions[] = {0.5, 0, 0.5, 0.5, 0.001, 0.5, 0.5, 50, 0.5};
  const float normals[] = {0, 1, 0, 0, 1, 0, 0, 1, 0};
  light.points.assign(9, NAN);
  light.found.assign(3, 7);
  EXPECT_EQ(radvor_solution_points(solution, RADVOR_IRRADIANCE, 3, positions, normals, 0.01, light.points.data(),
                                   light.found.data()),
            RADVOR_OK);
  EXPECT_EQ(light.found, (std::vector<std::uint8_t>{1, 1, 0}));
  for (const float value : light.points) {
    EXPECT_TRUE(std::isfinite(value) && value >= 0) << value;
  }

  radvor_output_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  EXPECT_EQ(radvor_solution_mesh(solution, 0, &mesh), RADVOR_OK);
  const auto append = [&](const void* array, std::size_t bytes) {
    if (bytes != 0) {
      light.mesh_bytes.append(static_cast<const char*>(array), bytes);
    }
  };
  const std::size_t vertices = mesh.vertex_count, triangles = mesh.triangle_count;
  for (const float* array : {mesh.positions, mesh.normals, mesh.irradiance, mesh.radiance}) {
    for (std::size_t i = 0; i < 3 * vertices; ++i) {
      EXPECT_TRUE(std::isfinite(array[i]));
    }
    append(array, 3 * vertices * sizeof(float));
  }
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    EXPECT_LT(mesh.indices[i], mesh.vertex_count);
  }
  append(mesh.indices, 3 * triangles * sizeof(std::uint32_t));
  append(mesh.materials, triangles * sizeof(std::uint32_t));
  append(mesh.source_triangles, triangles * sizeof(std::uint32_t));
  append(mesh.source_weights, 9 * triangles * sizeof(float));
  light.mesh_triangles = mesh.triangle_count;

  radvor_stats stats{};
  stats.struct_size = sizeof stats;
  EXPECT_EQ(radvor_solution_stats(solution, &stats), RADVOR_OK);
  light.counts = {stats.facets, stats.elements, stats.sites, stats.triangles, stats.constraints};
  return light;
}

}  // namespace radvor::test
