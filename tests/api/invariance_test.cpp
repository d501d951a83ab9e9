// Where a scene lies, how large it is and in which order its triangles come is no matter to the light.
#include <gtest/gtest.h>
#include <radvor.h>

#include <cmath>
#include <vector>

#include "api/engine.h"
#include "api/solid_scene.h"

namespace radvor::test {
namespace {

struct Placed {
  Transform34 transform = k_in_place;
  double scale = 1;
  std::uint32_t shuffled = 0;  ///< with that seed
};

// Irradiance on a grid of points of the floor, one wall and the top of the box, all clear of shadows' edges or not.
std::vector<double> irradiance(const Placed& placed) {
  std::vector<Solid> solids = {Solid::box({0, 0, 0}, {3, 2, 2}, true),
                               Solid::box({0.5f, 0.5f, 0.3f}, {1, 1, 0.8f}, false)};
  if (placed.shuffled != 0) {
    for (Solid& solid : solids) {
      solid.shuffle(placed.shuffled);
    }
  }
  std::vector<double> positions;
  std::vector<float> normals;
  const auto add = [&](const glm::dvec3& point, const glm::dvec3& normal) {
    const glm::dvec3 at = moved(placed.transform, point);
    const glm::dvec3 along = moved(placed.transform, normal) - moved(placed.transform, glm::dvec3(0));
    positions.insert(positions.end(), {at.x, at.y, at.z});
    for (int k = 0; k < 3; ++k) {
      normals.push_back(static_cast<float>(along[k] / placed.scale));
    }
  };
  for (int i = 1; i < 12; ++i) {
    for (int j = 1; j < 8; ++j) {
      add({0.25 * i, 0.25 * j, 0}, {0, 0, 1});
      add({0.25 * i, 2, 0.25 * j}, {0, -1, 0});
    }
  }
  const Engine engine;
  radvor_bake_options options = coarse();
  options.tolerance = 0.02f;
  options.patch_spacing = 0.25f;
  options.min_spacing = 0.0625f;
  radvor_solution* solution = bake_solids(engine, solids, {2, 1.2, 1.6}, options, placed.transform, placed.scale);
  const std::size_t count = positions.size() / 3;
  std::vector<float> rgb(3 * count);
  std::vector<std::uint8_t> found(count);
  EXPECT_EQ(radvor_solution_points(solution, RADVOR_IRRADIANCE, static_cast<std::uint32_t>(count), positions.data(),
                                   normals.data(), 0.01 * placed.scale, rgb.data(), found.data()),
            RADVOR_OK)
      << engine.error();
  radvor_solution_destroy(solution);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(found[i], 1) << i;
    values.push_back(rgb[3 * i]);
  }
  return values;
}

void expect_same_light(const Placed& placed) {
  static const std::vector<double> base = irradiance({});
  const std::vector<double> other = irradiance(placed);
  ASSERT_EQ(other.size(), base.size());
  double sum = 0, other_sum = 0, squares = 0;
  for (std::size_t i = 0; i < base.size(); ++i) {
    sum += base[i];
    other_sum += other[i];
    squares += (other[i] - base[i]) * (other[i] - base[i]);
  }
  const double mean = sum / static_cast<double>(base.size());
  EXPECT_GT(mean, 0.05);
  EXPECT_NEAR(other_sum / sum, 1, 0.01);
  EXPECT_LE(std::sqrt(squares / static_cast<double>(base.size())) / mean, 0.01) << "RMS over the mean";
}

TEST(Invariance, AMillionUnitsAway) {
  expect_same_light({.transform = {1, 0, 0, 1e6, 0, 1, 0, -1e6, 0, 0, 1, 1e6}});
}

TEST(Invariance, Turned) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  expect_same_light({.transform = {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0}});
}

TEST(Invariance, AThousandTimesSmaller) {
  expect_same_light({.transform = {1e-3, 0, 0, 0, 0, 1e-3, 0, 0, 0, 0, 1e-3, 0}, .scale = 1e-3});
}

TEST(Invariance, AThousandTimesLarger) {
  expect_same_light({.transform = {1e3, 0, 0, 0, 0, 1e3, 0, 0, 0, 0, 1e3, 0}, .scale = 1e3});
}

TEST(Invariance, TrianglesAndVerticesInAnotherOrder) {
  expect_same_light({.shuffled = 1});
  expect_same_light({.shuffled = 2});
}

}  // namespace
}  // namespace radvor::test
