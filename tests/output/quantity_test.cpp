#include "output/quantity.h"

#include <gtest/gtest.h>

#include <numbers>

#include "output/lit_scene.h"
#include "output/mesh_facets.h"

namespace radvor::output_test {
namespace {

TEST(Quantity, AddsDirectAndIndirectAndTurnsThemIntoRadiance) {
  Material painted;
  painted.albedo = {0.5, 0.25, 0.0};
  painted.emission = {1.0, 2.0, 3.0};
  LitScene scene({quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0})}, 0.5, {painted});
  scene.shine([](const Vec3&, const Vec3&) { return Color(4.0, 5.0, 6.0); });
  scene.shine_indirectly([](const Vec3&, const Vec3&) { return Color(0.5, 0.25, 0.125); });
  const LitSurface lit = scene.lit();
  ASSERT_FALSE(scene.surface().triangles(0).empty());
  const std::uint32_t share = scene.surface().triangles(0)[0][1];
  EXPECT_EQ(value_at(lit, Quantity::direct, share), Color(4.0, 5.0, 6.0));
  EXPECT_EQ(value_at(lit, Quantity::indirect, share), Color(0.5, 0.25, 0.125));
  EXPECT_EQ(value_at(lit, Quantity::irradiance, share), Color(4.5, 5.25, 6.125));
  const Color radiance = value_at(lit, Quantity::radiance, share);
  EXPECT_DOUBLE_EQ(radiance.r, 1.0 + 0.5 * 4.5 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(radiance.g, 2.0 + 0.25 * 5.25 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(radiance.b, 3.0);
}

TEST(Quantity, FacetsOfAMeshAreNeighbours) {
  LitScene scene({box({3, 0, 0}, {4, 1, 1}), grid(2, 2), box({5, 0, 0}, {6, 1, 1})}, 1);
  const auto& facets = scene.facets().facets;
  std::size_t found = 0;
  for (std::uint32_t mesh = 0; mesh < 3; ++mesh) {
    const FacetRange range = facets_of_mesh(scene.facets(), mesh);
    found += range.last - range.first;
    for (std::uint32_t facet = range.first; facet < range.last; ++facet) {
      EXPECT_EQ(facets[facet].mesh, mesh);
    }
  }
  EXPECT_EQ(found, facets.size());
  EXPECT_EQ(found, 6u + 1u + 6u);
}

}  // namespace
}  // namespace radvor::output_test
