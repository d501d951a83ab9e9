#include "output/adaptive_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "mesh_checks.h"
#include "output/lit_scene.h"

namespace radvor::output_test {
namespace {

using mesh_checks::Triangles;

Color some_light(const Vec3& p, const Vec3& n) {
  return {2 + std::sin(3 * p.x), 2 + n.z, 1 + p.y * p.y};
}

Triangles triangles_of(const AdaptiveMesh& mesh) {
  Triangles triangles;
  triangles.append(mesh.positions, mesh.indices);
  return triangles;
}

Triangles triangles_of(const Mesh& mesh) {
  Triangles triangles;
  triangles.append(mesh.positions, mesh.indices);
  return triangles;
}

/// Everything that holds for every adaptive mesh of a mesh without a degenerate triangle.
void check(LitScene& scene, std::uint32_t index, const AdaptiveMesh& mesh) {
  const Mesh& input = scene.scene().meshes[index];
  const std::size_t triangle_count = mesh.indices.size() / 3;
  ASSERT_GT(triangle_count, 0u);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.irradiance.size(), mesh.positions.size());
  ASSERT_EQ(mesh.radiance.size(), mesh.positions.size());
  ASSERT_EQ(mesh.uvs.size(), input.uvs.empty() ? 0 : mesh.positions.size());
  ASSERT_EQ(mesh.materials.size(), triangle_count);
  ASSERT_EQ(mesh.source_triangles.size(), triangle_count);
  ASSERT_EQ(mesh.source_weights.size(), 9 * triangle_count);

  float extent = 0;
  for (const glm::vec3& p : input.positions) {
    extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  std::vector<bool> used(mesh.positions.size());
  for (std::size_t t = 0; t < triangle_count; ++t) {
    const std::uint32_t source = mesh.source_triangles[t];
    ASSERT_LT(3 * source, input.indices.size());
    EXPECT_EQ(mesh.materials[t], input.triangle_materials[source]);
    const std::uint32_t* of_input = &input.indices[3 * std::size_t{source}];
    const auto turn = [](const auto& a, const auto& b, const auto& c) {
      return cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    };
    const std::uint32_t* own = &mesh.indices[3 * t];
    EXPECT_GT(dot(turn(mesh.positions[own[0]], mesh.positions[own[1]], mesh.positions[own[2]]),
                  turn(input.positions[of_input[0]], input.positions[of_input[1]], input.positions[of_input[2]])),
              0)
        << "triangle " << t << " is not wound as its source";
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = own[corner];
      ASSERT_LT(vertex, mesh.positions.size());
      used[vertex] = true;
      const float* weights = &mesh.source_weights[9 * t + 3 * corner];
      const float largest = std::max({1.0f, std::abs(weights[0]), std::abs(weights[1]), std::abs(weights[2])});
      EXPECT_NEAR(double{weights[0]} + weights[1] + weights[2], 1.0, 2e-7 * largest);
      glm::dvec3 position(0.0);
      glm::dvec2 uv(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        position += double{weights[k]} * glm::dvec3(input.positions[of_input[k]]);
        if (!input.uvs.empty()) {
          uv += double{weights[k]} * glm::dvec2(input.uvs[of_input[k]]);
        }
      }
      EXPECT_LT(length(position - glm::dvec3(mesh.positions[vertex])), 5e-7 * largest * extent);
      if (!input.uvs.empty()) {
        EXPECT_LT(length(uv - glm::dvec2(mesh.uvs[vertex])), 5e-7 * largest);
      }
      EXPECT_NEAR(length(mesh.normals[vertex]), 1.0f, 1e-6f);
    }
  }
  EXPECT_TRUE(std::ranges::all_of(used, [](bool u) { return u; })) << "a vertex that no triangle uses";

  // Input corners keep their bits: all but those inside of merged facets.
  std::set<std::uint32_t> at_sites;
  for (const Site& site : scene.surface().sites()) {
    at_sites.insert(site.vertex);
  }
  std::set<mesh_checks::Position> positions;
  for (const glm::vec3& p : mesh.positions) {
    positions.insert(mesh_checks::key(p));
  }
  for (std::size_t v = 0; v < input.positions.size(); ++v) {
    if (at_sites.contains(scene.welded().vertex_of[index][v])) {
      EXPECT_TRUE(positions.contains(mesh_checks::key(input.positions[v]))) << "corner " << v;
    }
  }
  EXPECT_TRUE(mesh_checks::has_no_t_vertices(triangles_of(mesh)));
}

AdaptiveMesh make(LitScene& scene, std::uint32_t index = 0) {
  AdaptiveMesh mesh = make_adaptive_mesh(scene.lit(), index);
  check(scene, index, mesh);
  return mesh;
}

/// A room whose floor is an L, seen from inside.
Mesh l_room() {
  std::vector<glm::vec3> corners;
  const std::vector<glm::vec2> outline = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const float z : {0.0f, 1.0f}) {
    for (const glm::vec2& p : outline) {
      corners.push_back({p, z});
    }
  }
  std::vector<std::uint32_t> indices = {0, 1, 3, 1, 2, 3, 0, 3, 4, 0, 4, 5, 6, 9, 7, 7, 9, 8, 6, 10, 9, 6, 11, 10};
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    for (const std::uint32_t index : {i, i + 6, j + 6, i, j + 6, j}) {
      indices.push_back(index);
    }
  }
  return mesh_of(corners, indices);
}

TEST(AdaptiveMesh, ClosedMeshesStayClosed) {
  const std::vector<Mesh> meshes = {box({0, 0, 0}, {3, 2, 1}), inside_out(box({-1, 0, 0}, {3, 2, 1})), l_room(),
                                    cylinder(24)};
  for (const Mesh& mesh : meshes) {
    for (const double spacing : {5.0, 0.7, 0.21}) {
      LitScene scene({mesh}, spacing);
      scene.shine(some_light);
      const AdaptiveMesh output = make(scene);
      const Triangles triangles = triangles_of(output);
      EXPECT_TRUE(mesh_checks::is_closed(triangles)) << "spacing " << spacing;
      EXPECT_NEAR(mesh_checks::volume(triangles), mesh_checks::volume(triangles_of(mesh)), 1e-5);
      EXPECT_NEAR(mesh_checks::area(triangles), mesh_checks::area(triangles_of(mesh)), 1e-5);
    }
  }
}

TEST(AdaptiveMesh, MeshesThatBorderOnEachOtherFitTogether) {
  // The six sides of a box as six meshes, one of them cut finer: its T-junctions are the others' too.
  const Mesh whole = box({0, 0, 0}, {2, 2, 2});
  std::vector<Mesh> sides;
  for (std::size_t side = 1; side < 6; ++side) {
    sides.push_back(mesh_of({whole.positions.begin(), whole.positions.end()},
                            {whole.indices.begin() + static_cast<std::ptrdiff_t>(6 * side),
                             whole.indices.begin() + static_cast<std::ptrdiff_t>(6 * side + 6)}));
  }
  sides.push_back(inside_out(grid(2, 2)));
  LitScene scene(std::move(sides), 0.3);
  scene.shine(some_light);
  Triangles all;
  for (std::uint32_t index = 0; index < 6; ++index) {
    const AdaptiveMesh side = make_adaptive_mesh(scene.lit(), index);
    all.append(side.positions, side.indices);
  }
  EXPECT_TRUE(mesh_checks::is_closed(all));
  EXPECT_TRUE(mesh_checks::has_no_t_vertices(all));
}

TEST(AdaptiveMesh, OpenMeshesHaveTheInputsBorder) {
  LitScene scene({grid(3, 2)}, 0.4);
  scene.shine(some_light);
  const AdaptiveMesh mesh = make(scene);
  EXPECT_TRUE(mesh_checks::has_border_of(triangles_of(mesh), triangles_of(scene.scene().meshes[0])));
}

TEST(AdaptiveMesh, MergedTrianglesWithOneMapLeaveNoSplit) {
  LitScene scene({grid(7, 5)}, 0.55);
  ASSERT_EQ(scene.facets().facets.size(), 1u);
  scene.shine(some_light);
  const AdaptiveMesh mesh = make(scene);
  EXPECT_EQ(mesh.positions.size(), scene.surface().sites().size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_NEAR(mesh.uvs[v].x, mesh.positions[v].x / 7, 2e-7);
    EXPECT_NEAR(mesh.uvs[v].y, mesh.positions[v].y / 5, 2e-7);
  }
}

TEST(AdaptiveMesh, CornersKeepTheirBitsWhateverTheTransformAndTheMerging) {
  Mesh mesh = grid(24, 24);
  for (glm::vec3& p : mesh.positions) {
    p = {0.1f + 0.3f * p.x, 0.2f + 0.4f * p.y, 0.9f};
  }
  for (glm::vec2& uv : mesh.uvs) {
    uv = {0.123f + 3.7f * uv.x, 0.771f - 2.3f * uv.y};  // one affine map but for rounding
  }
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  mesh.transform = {1.3 * c, -1.3 * s, 0, 12.3, 1.3 * s, 1.3 * c, 0, -4e8, 0, 0, 1.3, 7.89};
  LitScene scene({std::move(mesh)}, 50);
  ASSERT_EQ(scene.facets().facets.size(), 1u);
  const AdaptiveMesh output = make(scene);
  EXPECT_LT(output.materials.size(), 24u * 24) << "fewer than the input's: its triangles were merged";
  const Mesh& input = scene.scene().meshes[0];
  for (std::size_t corner = 0; corner < input.positions.size(); ++corner) {
    if (corner % 25 != 0 && corner % 25 != 24 && corner > 24 && corner < 24 * 25) {
      continue;  // inside of the facet
    }
    const auto found = std::ranges::find(output.positions, input.positions[corner]);
    ASSERT_NE(found, output.positions.end()) << "corner " << corner;
    EXPECT_EQ(output.uvs[static_cast<std::size_t>(found - output.positions.begin())], input.uvs[corner]);
  }
}

TEST(AdaptiveMesh, UvSeamsSplitVerticesAndNothingElseDoes) {
  Mesh mesh = grid(4, 1);  // columns 2 and 3 get UVs of their own
  for (const std::size_t middle : {2u, 7u}) {
    mesh.positions.push_back(mesh.positions[middle]);
    mesh.uvs.push_back(mesh.uvs[middle] + glm::vec2(1.0f, 0.0f));
  }
  for (const std::size_t right : {3u, 4u, 8u, 9u}) {
    mesh.uvs[right] += glm::vec2(1.0f, 0.0f);
  }
  for (std::size_t i = 12; i < 24; ++i) {
    mesh.indices[i] = mesh.indices[i] == 2 ? 10 : mesh.indices[i] == 7 ? 11 : mesh.indices[i];
  }
  LitScene scene({std::move(mesh)}, 0.3);
  ASSERT_EQ(scene.facets().facets.size(), 1u);
  scene.shine(some_light);
  const AdaptiveMesh output = make(scene);
  std::size_t on_seam = 0;
  for (const Site& site : scene.surface().sites()) {
    on_seam += site.position.x == 2 ? 1 : 0;
  }
  EXPECT_GT(on_seam, 2u);
  EXPECT_EQ(output.positions.size(), scene.surface().sites().size() + on_seam);
  for (std::size_t v = 0; v < output.positions.size(); ++v) {
    const float without = output.positions[v].x / 4;
    EXPECT_NEAR(output.uvs[v].x < 1 ? output.uvs[v].x : output.uvs[v].x - 1, without, 3e-7);
    EXPECT_TRUE(output.positions[v].x == 2 || (output.uvs[v].x > 1) == (output.positions[v].x > 2));
  }
  for (std::size_t i = 0; i < output.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT(std::abs(output.uvs[output.indices[i + k]].x - output.uvs[output.indices[i]].x), 0.9f) << "crosses it";
    }
  }
}

TEST(AdaptiveMesh, SharpEdgesSplitVerticesAndSmoothOnesDoNot) {
  LitScene sharp({box({0, 0, 0}, {1, 1, 1})}, 0.26);
  sharp.shine(some_light);
  const AdaptiveMesh split = make(sharp);
  std::size_t corners = 0;
  for (const glm::vec3& p : split.positions) {
    corners += p == glm::vec3(1.0f) ? 1 : 0;
  }
  EXPECT_EQ(corners, 3u);

  // Where normals are given and equal across every edge, each site is one vertex.
  Mesh round = tube(24);
  for (const glm::vec3& p : round.positions) {
    round.normals.push_back({p.x, p.y, 0});
  }
  LitScene smooth({std::move(round)}, 0.3);
  smooth.shine(some_light);
  const AdaptiveMesh whole = make(smooth);
  EXPECT_EQ(whole.positions.size(), smooth.surface().sites().size());
  for (std::size_t v = 0; v < whole.positions.size(); ++v) {
    const glm::vec3& p = whole.positions[v];
    EXPECT_NEAR(dot(whole.normals[v], normalize(glm::vec3(p.x, p.y, 0))), 1.0f, 1e-3f);
  }
}

/// Winding, positions, weights and normals for every handedness.
TEST(AdaptiveMesh, IsInTheMeshsOwnSpaceHoweverItIsPlaced) {
  const Transform turned = {0.0, -2.0, 0.0, 1e6, 1.5, 0.0, 0.0, -1e6, 0.0, 0.25, 3.0, 5.0};
  Transform mirrored = turned;
  for (const std::size_t i : {0u, 4u, 8u}) {
    mirrored[i] = -mirrored[i];
  }
  for (const Transform& transform : {k_identity, turned, mirrored}) {
    for (const bool clockwise : {false, true}) {
      Mesh mesh = box({0, 0, 0}, {1, 1, 1});
      for (const glm::vec3& p : mesh.positions) {
        mesh.uvs.push_back({p.x + p.z, p.y - p.z});
      }
      mesh = clockwise ? inside_out(std::move(mesh)) : std::move(mesh);  // the front is outside, both ways
      mesh.transform = transform;
      mesh.clockwise = clockwise;
      LitScene scene({std::move(mesh)}, 0.6);
      scene.shine(some_light);
      const AdaptiveMesh output = make(scene);
      EXPECT_TRUE(mesh_checks::is_closed(triangles_of(output)));
      EXPECT_NEAR(mesh_checks::volume(triangles_of(output)), clockwise ? -1.0 : 1.0, 1e-6);
      for (std::size_t v = 0; v < output.positions.size(); ++v) {
        const glm::vec3& n = output.normals[v];
        const glm::vec3 outward = output.positions[v] - glm::vec3(0.5f);
        EXPECT_NEAR(dot(n, outward), 0.5f, 1e-5f) << "the normal of a face of the box, outward";
      }
      // Every site's place in the world is where the transform takes some vertex.
      std::set<std::array<double, 3>> sites;
      for (const Site& site : scene.surface().sites()) {
        double nearest = INFINITY;
        for (const glm::vec3& p : output.positions) {
          nearest = std::min(nearest, length(transform_point(transform, Vec3(p)) - site.position));
        }
        EXPECT_LT(nearest, 1e-6);
      }
    }
  }
}

TEST(AdaptiveMesh, AFlatteningTransformStillGivesAMesh) {
  Mesh mesh = grid(2, 2);
  mesh.transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 3};
  LitScene scene({std::move(mesh)}, 0.4);
  scene.shine(some_light);
  const AdaptiveMesh output = make(scene);
  EXPECT_TRUE(mesh_checks::has_border_of(triangles_of(output), triangles_of(scene.scene().meshes[0])));
  for (const glm::vec3& normal : output.normals) {
    EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  }
}

TEST(AdaptiveMesh, CarriesTheLightOfItsSites) {
  Material painted;
  painted.albedo = Color(0.5);
  Material lamp;
  lamp.emission = Color(7.0);
  Mesh mesh = grid(2, 1);
  mesh.triangle_materials = {0, 0, 1, 1};
  LitScene scene({std::move(mesh)}, 0.3, {painted, lamp});
  scene.shine(some_light);
  const AdaptiveMesh output = make(scene);
  for (std::size_t t = 0; t < output.materials.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = output.indices[3 * t + k];
      const Color irradiance = some_light(Vec3(output.positions[vertex]), {0, 0, 1});
      const Color radiance = output.materials[t] == 0 ? 0.5 * irradiance / 3.14159265358979323846 : Color(7.0);
      EXPECT_LT(length(Color(output.irradiance[vertex]) - irradiance), 1e-6);
      EXPECT_LT(length(Color(output.radiance[vertex]) - radiance), 1e-6);
    }
  }
}

TEST(AdaptiveMesh, OfAMeshThatDoesNotReceiveIsEmpty) {
  Mesh mesh = grid(1, 1);
  mesh.receives = false;
  LitScene scene({std::move(mesh), grid(1, 1)}, 0.5);
  const AdaptiveMesh output = make_adaptive_mesh(scene.lit(), 0);
  EXPECT_TRUE(output.positions.empty());
  EXPECT_TRUE(output.indices.empty());
  EXPECT_FALSE(make_adaptive_mesh(scene.lit(), 1).indices.empty());
}

TEST(AdaptiveMesh, SaysWhereSinglePrecisionEnds) {
  Mesh mesh = quad({2e6f, 0, 0}, {2e6f + 8, 0, 0}, {2e6f + 8, 8, 0}, {2e6f, 8, 0});  // floats are 1/8 apart there
  LitScene scene({std::move(mesh)}, 0.1);
  scene.messages.clear();
  make_adaptive_mesh(scene.lit(), 0);
  ASSERT_EQ(scene.messages.size(), 1u);
  EXPECT_NE(scene.messages[0].find("coincide"), std::string::npos);
}

}  // namespace
}  // namespace radvor::output_test
