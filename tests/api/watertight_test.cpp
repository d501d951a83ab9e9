// The adaptive meshes of whole bakes, refined where the light asks for it: closed where the input is.
#include <gtest/gtest.h>
#include <radvor.h>

#include <cmath>
#include <span>
#include <vector>

#include "api/engine.h"
#include "api/solid_scene.h"
#include "mesh_checks.h"

namespace radvor::test {
namespace {

// Each input mesh gives one closed mesh without a vertex inside an edge, with the volume of the input.
void expect_watertight(const std::vector<Solid>& solids, const glm::dvec3& lamp) {
  const Engine engine;
  radvor_bake_options options = coarse();
  options.tolerance = 0.05f;
  options.min_spacing = 0.05f;
  radvor_solution* solution = bake_solids(engine, solids, lamp, options);
  for (std::uint32_t mesh = 0; mesh < solids.size(); ++mesh) {
    radvor_output_mesh output{};
    output.struct_size = sizeof output;
    ASSERT_EQ(radvor_solution_mesh(solution, mesh, &output), RADVOR_OK) << engine.error();
    EXPECT_GT(output.triangle_count, solids[mesh].indices.size() / 3) << "nothing was added";
    mesh_checks::Triangles triangles, input;
    triangles.append({reinterpret_cast<const glm::vec3*>(output.positions), output.vertex_count},
                     {output.indices, std::size_t{3} * output.triangle_count});
    input.append(solids[mesh].positions, solids[mesh].indices);
    ASSERT_TRUE(mesh_checks::is_closed(input)) << "the input itself";
    EXPECT_TRUE(mesh_checks::is_closed(triangles)) << "mesh " << mesh;
    EXPECT_TRUE(mesh_checks::has_no_t_vertices(triangles)) << "mesh " << mesh;
    EXPECT_NEAR(mesh_checks::volume(triangles), mesh_checks::volume(input),
                1e-5 * std::abs(mesh_checks::volume(input)));
  }
  radvor_solution_destroy(solution);
}

const Solid k_room = Solid::box({0, 0, 0}, {3, 2, 2}, true);

TEST(Watertight, RoomWithAStandingAndAFloatingBox) {
  expect_watertight({k_room, Solid::box({0.5f, 0.5f, 0}, {1, 1, 0.7f}, false),
                     Solid::box({1.5f, 0.7f, 0.6f}, {2, 1.2f, 0.9f}, false)},
                    {1.4, 1.1, 1.8});
}

TEST(Watertight, CylinderInARoom) {
  std::vector<glm::vec3> circle;
  for (int i = 0; i < 16; ++i) {
    const double angle = i * (2 * M_PI / 16);
    circle.emplace_back(1.5 + 0.4 * std::cos(angle), 1 + 0.4 * std::sin(angle), 0.5);
  }
  expect_watertight({k_room, Solid::prism(circle, 0.8f, false)}, {2.6, 1.5, 1.6});
}

TEST(Watertight, LShapedRoom) {
  expect_watertight({Solid::prism({{1, 1, 0}, {1, 3, 0}, {0, 3, 0}, {0, 0, 0}, {3, 0, 0}, {3, 1, 0}}, 1.5f, true)},
                    {0.4, 2.6, 1.2});
}

}  // namespace
}  // namespace radvor::test
