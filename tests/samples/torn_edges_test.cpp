// The program that looks for tears in real scenes: that it sees them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "samples/temporary_folder.h"
#include "structure/command.h"

namespace bake {
namespace {

using test::TemporaryFolder;

// A PLY as radvor-bake writes it.
std::string ply(const std::vector<std::array<float, 3>>& vertices,
                const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::string text = "ply\nelement vertex " + std::to_string(vertices.size()) + "\nelement face " +
                     std::to_string(triangles.size()) + "\nend_header\n";
  const auto append = [&](const auto& row) { text.append(reinterpret_cast<const char*>(row.data()), sizeof row); };
  for (const auto& [x, y, z] : vertices) {
    append(std::array<float, 12>{x, y, z});
  }
  for (const auto& [a, b, c] : triangles) {
    text += '\3';
    append(std::array<std::uint32_t, 5>{a, b, c});
  }
  return text;
}

// Two triangles of the square: what the program says of the mesh that came out.
int torn(const std::string& baked) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  const std::string command =
      std::string(RADVOR_TORN_EDGES_PROGRAM) + " " + scene + " " + folder.write("out.ply", baked);
  const radvor::test::CommandResult result = radvor::test::run_command(command);
  return WIFEXITED(result.status) ? WEXITSTATUS(result.status) : -1;
}

const std::vector<std::array<float, 3>> k_corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(TornEdges, WhatIsDividedOnBothSidesIsWhole) {
  EXPECT_EQ(torn(ply(k_corners, {{0, 1, 2}, {0, 2, 3}})), 0);
  auto vertices = k_corners;
  vertices.push_back({0.5f, 0.5f, 0});  // of the diagonal
  vertices.push_back({0.25f, 0, 0});    // of the border
  EXPECT_EQ(torn(ply(vertices, {{0, 5, 4}, {5, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}})), 0);
}

TEST(TornEdges, ATVertexIsATear) {
  auto vertices = k_corners;
  vertices.push_back({0.5f, 0.5f, 0});
  EXPECT_EQ(torn(ply(vertices, {{0, 1, 4}, {1, 2, 4}, {0, 2, 3}})), 1);
}

TEST(TornEdges, AHoleIsATear) {
  EXPECT_EQ(torn(ply(k_corners, {{0, 1, 2}})), 1);
}

TEST(TornEdges, WhatIsNoMeshIsRefused) {
  EXPECT_EQ(torn("ply\nend_header\n"), 2);
}

}  // namespace
}  // namespace bake
