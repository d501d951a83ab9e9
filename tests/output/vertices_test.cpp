#include "output/vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "base/hash.h"
#include "output/lit_scene.h"

namespace radvor::output_test {
namespace {

std::vector<glm::vec3> vertices_of(LitScene& scene, std::uint32_t mesh, VertexMode mode, bool back = false,
                                   Quantity quantity = Quantity::irradiance) {
  std::vector<glm::vec3> rgb(scene.scene().meshes[mesh].positions.size(), glm::vec3(-1.0f));
  write_vertices(scene.lit(), mesh, quantity, back, mode, &rgb.data()->x, sizeof(glm::vec3));
  return rgb;
}

void expect_near(const glm::vec3& value, const Color& expected, double tolerance) {
  EXPECT_NEAR(value.x, expected.r, tolerance);
  EXPECT_NEAR(value.y, expected.g, tolerance);
  EXPECT_NEAR(value.z, expected.b, tolerance);
}

Color linear(const Vec3& p, const Vec3&) {
  return {3 + p.x, 5 + 2 * p.y - p.x, 7 + p.x + p.y};
}

/// The integral of the squared difference between the interpolation of vertex values and the light on the adaptive
/// mesh, summed over midpoints of a fine division of every input triangle: shares nothing with the fit's own integral.
class SquaredDifference {
 public:
  SquaredDifference(LitScene& scene, std::uint32_t mesh) {
    const WeldedScene& welded = scene.welded();
    for (std::uint32_t t = 0; t < welded.triangles.size(); ++t) {
      if (welded.triangles[t].mesh == mesh) {
        add(scene, t);
      }
    }
  }

  double operator()(const std::vector<glm::vec3>& values) const {
    double sum = 0;
    for (const Point& point : points_) {
      Color difference = point.light;
      for (std::size_t k = 0; k < 3; ++k) {
        difference -= point.weights[k] * Color(values[point.vertices[k]]);
      }
      sum += point.area * dot(difference, difference);
    }
    return sum;
  }

 private:
  struct Point {
    std::array<std::uint32_t, 3> vertices;
    std::array<double, 3> weights;
    double area;
    Color light;
  };

  void add(LitScene& scene, std::uint32_t t) {
    constexpr int k_parts = 24;
    const WeldedScene& welded = scene.welded();
    const Triangle& triangle = welded.triangles[t];
    const std::uint32_t facet = scene.facets().facet_of_triangle[t];
    const Frame& frame = scene.facets().facets[facet].frame;
    const Vec3& a = welded.positions[triangle.vertices[0]];
    const Vec3 ab = welded.positions[triangle.vertices[1]] - a;
    const Vec3 ac = welded.positions[triangle.vertices[2]] - a;
    const double area = 0.5 * length(cross(ab, ac)) / (k_parts * k_parts);
    for (int i = 0; i < k_parts; ++i) {
      for (int j = 0; j < 2 * (k_parts - i) - 1; ++j) {  // upright and inverted small triangles of row i
        const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
        const double u = (i + third) / k_parts;
        const double v = (j / 2 + third) / k_parts;
        const FacetPoint point = scene.surface().locate(facet, frame.to_plane(a + u * ab + v * ac));
        points_.push_back(
            {triangle.corners, {1 - u - v, u, v}, area, value_at(scene.lit(), Quantity::irradiance, point, false)});
      }
    }
  }

  std::vector<Point> points_;
};

TEST(Vertices, LinearLightIsExactInsideAMergedFacetToo) {
  LitScene scene({grid(5, 4)}, 0.9);
  ASSERT_EQ(scene.facets().facets.size(), 1u);
  scene.shine(linear);
  for (const VertexMode mode : {VertexMode::sample, VertexMode::fit}) {
    const auto values = vertices_of(scene, 0, mode);
    for (std::size_t v = 0; v < values.size(); ++v) {
      expect_near(values[v], linear(Vec3(scene.scene().meshes[0].positions[v]), {}), 1e-5);
    }
  }
}

TEST(Vertices, ACornerOfABoxIsTheMeanOfItsFacesHoweverTheyAreCut) {
  LitScene scene({box({0, 0, 0}, {1, 1, 1})}, 0.5);
  scene.shine([](const Vec3&, const Vec3& n) { return Color(n.x * n.x, n.y * n.y, n.z > 0 ? 1.0 : 0.5); });
  const auto values = vertices_of(scene, 0, VertexMode::sample);
  for (std::size_t v = 0; v < 8; ++v) {
    const bool top = scene.scene().meshes[0].positions[v].z == 1.0f;
    expect_near(values[v], {1.0 / 3, 1.0 / 3, (0.5 + 0.5 + (top ? 1.0 : 0.5)) / 3}, 1e-6);
  }
}

TEST(Vertices, DroppedTrianglesTakeTheLightAtTheirWeldedPosition) {
  Mesh mesh = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  mesh.positions.insert(mesh.positions.end(), {{1, 1, 0}, {1, 0, 0}, {1, 1, 0}, {9, 9, 9}});
  for (const std::uint32_t index : {4u, 5u, 6u}) {  // no area
    mesh.indices.push_back(index);
  }
  mesh.triangle_materials.push_back(0);
  LitScene scene({std::move(mesh)}, 0.5);
  ASSERT_EQ(scene.welded().triangles.size(), 2u);
  scene.shine(linear);
  for (const VertexMode mode : {VertexMode::sample, VertexMode::fit}) {
    const auto values = vertices_of(scene, 0, mode);
    EXPECT_EQ(values[4], values[2]);
    EXPECT_EQ(values[5], values[1]);
    EXPECT_EQ(values[6], values[2]);
    EXPECT_EQ(values[7], glm::vec3(0.0f));
    expect_near(values[2], linear({1, 1, 0}, {}), 1e-5);
  }
}

TEST(Vertices, OnlyTheirOwnBytesAreWritten) {
  LitScene scene({grid(2, 1)}, 0.5);
  scene.shine([](const Vec3&, const Vec3&) { return Color(1.0, 2.0, 3.0); });
  constexpr std::size_t k_stride = 17;
  std::vector<unsigned char> bytes(6 * k_stride, 0xab);
  write_vertices(scene.lit(), 0, Quantity::irradiance, false, VertexMode::sample,
                 reinterpret_cast<float*>(bytes.data()), k_stride);
  for (std::size_t v = 0; v < 6; ++v) {
    std::array<float, 3> rgb;
    std::memcpy(rgb.data(), &bytes[v * k_stride], sizeof rgb);
    EXPECT_EQ(rgb, (std::array<float, 3>{1.0f, 2.0f, 3.0f}));
    for (std::size_t i = sizeof rgb; i < k_stride; ++i) {
      EXPECT_EQ(bytes[v * k_stride + i], 0xab);
    }
  }
}

TEST(Vertices, BacksHaveTheirOwnLight) {
  Material glass;
  glass.two_sided = true;
  Mesh mesh = grid(2, 1);
  mesh.triangle_materials = {1, 1, 0, 0};
  LitScene scene({std::move(mesh)}, 0.5, {Material{}, glass});
  scene.shine([](const Vec3&, const Vec3& n) { return n.z > 0 ? Color(1.0, 0.0, 0.0) : Color(0.0, 0.0, 1.0); });
  for (const VertexMode mode : {VertexMode::sample, VertexMode::fit}) {
    const auto front = vertices_of(scene, 0, mode, false);
    const auto back = vertices_of(scene, 0, mode, true);
    for (std::size_t v = 0; v < front.size(); ++v) {
      expect_near(front[v], {1, 0, 0}, 1e-6);
      const bool uses_glass = scene.scene().meshes[0].positions[v].x <= 1;
      expect_near(back[v], uses_glass ? Color(0, 0, 1) : Color(0, 0, 0), 1e-6);
    }
  }
}

TEST(Vertices, AMeshThatDoesNotReceiveIsDark) {
  Mesh mesh = grid(1, 1);
  mesh.receives = false;
  LitScene scene({std::move(mesh), grid(1, 1)}, 0.5);
  scene.shine([](const Vec3&, const Vec3&) { return Color(1.0); });
  for (const glm::vec3& value : vertices_of(scene, 0, VertexMode::fit)) {
    EXPECT_EQ(value, glm::vec3(0.0f));
  }
}

/// Two fans that touch in one point, made one facet by a detour round a hole: the light of each stays its own.
TEST(Vertices, WhereAFacetTouchesItselfEachTriangleAsksItsOwnSide) {
  Mesh mesh = mesh_of({{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {-2, 1, 0}, {-2, -1, 0}, {-3, -3, 0}, {3, -3, 0}, {0, 0, 0}},
                      {0, 1, 2, 1, 6, 2, 7, 3, 4, 3, 5, 4, 5, 6, 1, 5, 1, 4});
  LitScene scene({std::move(mesh)}, 0.4);
  ASSERT_EQ(scene.facets().facets.size(), 1u);
  scene.shine_samples([](const Sample& sample) { return sample.point.x > 0 ? Color(1, 0, 0) : Color(0, 0, 1); });
  const auto values = vertices_of(scene, 0, VertexMode::sample);
  expect_near(values[0], {1, 0, 0}, 1e-6);
  expect_near(values[7], {0, 0, 1}, 1e-6);
}

class Fit : public ::testing::TestWithParam<int> {};

Color lamp(const Vec3& p, const Vec3&) {
  const double squared = (p.x - 1.3) * (p.x - 1.3) + (p.y - 0.7) * (p.y - 0.7) + 0.2;
  return {1 / squared, 1 / (squared * squared), p.x > 1.3 ? 4.0 : 0.0};  // smooth, sharp, and a shadow's edge
}

Mesh fit_mesh(int which) {
  switch (which) {
    case 0:
      return grid(3, 2);
    case 1:
      return quad({0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0});
    case 2:
      return box({0, 0, 0}, {3, 2, 1});
    default:
      return cylinder(12);
  }
}

TEST_P(Fit, IsNeverWorseThanSampleAndNoNeighbourIsBetter) {
  LitScene scene({fit_mesh(GetParam())}, 0.15);
  scene.shine(lamp);
  const auto sample = vertices_of(scene, 0, VertexMode::sample);
  const auto fit = vertices_of(scene, 0, VertexMode::fit);
  const SquaredDifference squared_difference(scene, 0);
  const double sample_error = squared_difference(sample);
  const double fit_error = squared_difference(fit);
  EXPECT_LT(fit_error, 0.8 * sample_error);
  RecordProperty("fit_over_sample", std::to_string(std::sqrt(fit_error / sample_error)));
  double size = 0;
  for (const glm::vec3& value : fit) {
    ASSERT_TRUE(value.x >= 0 && value.y >= 0 && value.z >= 0);
    size = std::max({size, double{value.x}, double{value.y}, double{value.z}});
  }
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    auto other = fit;
    for (std::size_t v = 0; v < other.size(); ++v) {
      for (int k = 0; k < 3; ++k) {
        const double nudge = 0.05 * size * (to_unit(hash(trial, v, static_cast<std::uint64_t>(k))) - 0.5);
        other[v][k] = std::max(0.0f, other[v][k] + static_cast<float>(nudge));
      }
    }
    EXPECT_GT(squared_difference(other), fit_error);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, Fit, ::testing::Range(0, 4));

/// The unit right triangle lit by x * x: the best linear function is 0.8 x - 0.1, by the moments of the triangle. Where
/// nothing may be negative, two corners are held at 0, and the slope is (integral of x^3) / (integral of x^2) = 0.6.
TEST(Vertices, FitOfAParabolaHasAClosedForm) {
  LitScene scene({mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2})}, 0.01);
  scene.shine([](const Vec3& p, const Vec3&) { return Color(1 + p.x * p.x, p.x * p.x, 0.0); });
  const auto values = vertices_of(scene, 0, VertexMode::fit);
  expect_near(values[0], {0.9, 0, 0}, 1e-3);
  expect_near(values[1], {1.7, 0.6, 0}, 1e-3);
  expect_near(values[2], {0.9, 0, 0}, 1e-3);
  EXPECT_EQ(values[0].y, 0.0f);
}

}  // namespace
}  // namespace radvor::output_test
