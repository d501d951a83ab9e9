// The verifier itself: what it must accept, and that it sees each defect it is there for.
#include "mesh_checks.h"

#include <gtest/gtest.h>

namespace mesh_checks {
namespace {

Triangles tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
}

Triangles square() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}};
}

TEST(MeshChecks, AcceptsWhatIsSound) {
  EXPECT_TRUE(is_closed(tetrahedron()));
  EXPECT_TRUE(has_no_t_vertices(tetrahedron()));
  EXPECT_NEAR(volume(tetrahedron()), 1.0 / 6, 1e-9);
  EXPECT_TRUE(has_no_t_vertices(square()));
  EXPECT_TRUE(has_border_of(square(), square()));
}

TEST(MeshChecks, PositionsCountNotIndices) {
  Triangles split = tetrahedron();
  split.positions.push_back({-0.0f, 0.0f, 1.0f});
  split.indices[5] = 4;
  EXPECT_TRUE(is_closed(split));
}

TEST(MeshChecks, SeesHolesAndTurnedAndDoubleTriangles) {
  Triangles open = tetrahedron();
  open.indices.resize(9);
  EXPECT_FALSE(is_closed(open));
  Triangles turned = tetrahedron();
  std::swap(turned.indices[0], turned.indices[1]);
  EXPECT_FALSE(is_closed(turned));
  Triangles twice = tetrahedron();
  twice.indices.insert(twice.indices.end(), {0, 2, 1});
  EXPECT_FALSE(is_closed(twice));
  EXPECT_FALSE(is_closed({}));
}

TEST(MeshChecks, SeesTVerticesAndBordersThatAreNotTheInputs) {
  Triangles cracked = square();  // the second triangle is cut at its diagonal's middle, the first is not
  cracked.positions.push_back({0.5f, 0.5f, 0});
  cracked.indices = {0, 1, 2, 0, 4, 3, 4, 2, 3};
  EXPECT_FALSE(has_no_t_vertices(cracked));
  EXPECT_FALSE(has_border_of(cracked, square()));

  Triangles cut = square();  // on the border a cut is fine
  cut.positions.push_back({0.5f, 0, 0});
  cut.indices = {0, 4, 2, 4, 1, 2, 0, 2, 3};
  EXPECT_TRUE(has_no_t_vertices(cut));
  EXPECT_TRUE(has_border_of(cut, square()));
}

}  // namespace
}  // namespace mesh_checks
