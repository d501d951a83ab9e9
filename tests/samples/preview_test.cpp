// The rasteriser on triangles whose picture is known, the camera that is found, tone mapping, the progress line.
#include "preview.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "progress.h"
#include "samples/temporary_folder.h"

namespace bake {
namespace {

constexpr double k_right_angle = std::numbers::pi / 2;

/// From (0, 0, 1) at the plane z = 0, of which a picture as wide as high sees -1 to 1.
const Camera k_camera{{0, 0, 1}, {0, 0, 0}, k_right_angle};

struct Flat {
  std::vector<float> positions;
  std::vector<float> radiance;
  std::vector<std::uint32_t> indices;

  DrawnMesh drawn() const { return {positions.data(), radiance.data(), indices.data(), indices.size() / 3}; }
};

/// A square from (-size, -size) to (size, size) at a height, of one radiance.
Flat square(float size, float z, float radiance, bool front = true) {
  Flat flat{{-size, -size, z, size, -size, z, size, size, z, -size, size, z}, std::vector<float>(12, radiance), {}};
  flat.indices = front ? std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3} : std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2};
  return flat;
}

std::vector<Fragment> draw(const Flat& flat, std::size_t size = 64) {
  Rasteriser rasteriser(k_camera, size, size);
  std::vector<Fragment> fragments;
  rasteriser.draw(flat.drawn(), [&](const Fragment& fragment) { fragments.push_back(fragment); });
  return fragments;
}

TEST(Rasteriser, ASquareCoversItsShareOnce) {
  const std::vector<Fragment> fragments = draw(square(0.5f, 0, 1));
  EXPECT_EQ(fragments.size(), 32u * 32u);
  std::set<std::size_t> samples;
  for (const Fragment& fragment : fragments) {
    samples.insert(fragment.sample);
    EXPECT_DOUBLE_EQ(fragment.distance, 1);
  }
  EXPECT_EQ(samples.size(), fragments.size());
  EXPECT_EQ(*samples.begin(), 16u * 64 + 16);
  EXPECT_EQ(*samples.rbegin(), 47u * 64 + 47);
  EXPECT_EQ(draw(square(2, 0, 1)).size(), 64u * 64u);
  EXPECT_EQ(draw(square(2, 2, 1)).size(), 0u);  // behind the eye
}

TEST(Rasteriser, BackFacesAreNotDrawn) {
  EXPECT_TRUE(draw(square(0.5f, 0, 1, false)).empty());
}

TEST(Rasteriser, RowsCountDownwardsColumnsToTheRight) {
  Flat flat{{0.5f, 0.75f, 0, 1, 0.75f, 0, 0.5f, 1, 0}, {}, {0, 1, 2}};  // top right
  for (const Fragment& fragment : draw(flat)) {
    EXPECT_LT(fragment.sample / 64, 8u);
    EXPECT_GE(fragment.sample % 64, 48u);
  }
}

TEST(Rasteriser, WeightsAreRightInPerspective) {
  // A floor that runs away from the eye: what a sample sees must lie on its ray.
  const Flat flat{{-3, -1, 0.5f, 3, -1, 0.5f, 0, -1, -40}, {}, {0, 1, 2}};
  const std::vector<Fragment> fragments = draw(flat);
  EXPECT_GT(fragments.size(), 100u);
  for (const Fragment& fragment : fragments) {
    glm::dvec3 at(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const float* p = &flat.positions[3 * fragment.vertices[i]];
      at += fragment.weights[static_cast<int>(i)] * glm::dvec3(p[0], p[1], p[2]);
    }
    const double x = (static_cast<double>(fragment.sample % 64) + 0.5) / 32 - 1;
    const double y = 1 - (static_cast<double>(fragment.sample / 64) + 0.5) / 32;
    EXPECT_NEAR(at.x, x * (1 - at.z), 1e-6);
    EXPECT_NEAR(at.y, y * (1 - at.z), 1e-6);
    EXPECT_NEAR(fragment.distance, 1 - at.z, 1e-6);
  }
}

TEST(Rasteriser, WhatReachesBehindTheEyeIsCutOff) {
  const Flat floor{{-50, -1, 50, 50, -1, 50, 0, -1, -50}, {}, {0, 1, 2}};
  const std::vector<Fragment> fragments = draw(floor);
  EXPECT_GT(fragments.size(), 64u * 20u);
  for (const Fragment& fragment : fragments) {
    EXPECT_GE(fragment.sample / 64, 32u);  // under the horizon
    EXPECT_NEAR(fragment.weights.x + fragment.weights.y + fragment.weights.z, 1, 1e-9);
  }
}

TEST(Rasteriser, NearestStaysWhateverTheOrder) {
  const Flat near = square(0.25f, 0.5f, 1);
  const Flat far = square(0.9f, 0, 1);
  for (const bool near_first : {false, true}) {
    Rasteriser rasteriser(k_camera, 64, 64);
    std::vector<double> seen(64 * 64, 0);
    const auto shade = [&](const Fragment& fragment) { seen[fragment.sample] = fragment.distance; };
    rasteriser.draw((near_first ? near : far).drawn(), shade);
    rasteriser.draw((near_first ? far : near).drawn(), shade);
    EXPECT_DOUBLE_EQ(seen[32 * 64 + 32], 0.5);
    EXPECT_DOUBLE_EQ(seen[10 * 64 + 10], 1);
  }
}

TEST(Rasteriser, EdgeDistances) {
  const Flat flat{{-1, -1, 0, 1, -1, 0, -1, 1, 0}, {}, {0, 1, 2}};
  for (const Fragment& fragment : draw(flat)) {
    const double x = static_cast<double>(fragment.sample % 64) + 0.5;
    const double y = 64 - (static_cast<double>(fragment.sample / 64) + 0.5);
    EXPECT_NEAR(fragment.edge_distance, std::min({x, y, (64 - x - y) / std::sqrt(2.0)}), 1e-9);
    EXPECT_NEAR(fragment.thickness, 64 / std::sqrt(2.0), 1e-9);
  }
}

TEST(Preview, ExposureMakesScaleOfLightIrrelevant) {
  const Flat dim = square(0.5f, 0, 1e-4f);
  const Flat bright = square(0.5f, 0, 1e4f);
  const Picture a = draw_preview({dim.drawn()}, k_camera, 32, 32, false);
  const Picture b = draw_preview({bright.drawn()}, k_camera, 32, 32, false);
  EXPECT_EQ(a.rgb, b.rgb);
  const std::size_t middle = 3 * (16 * 32 + 16);
  EXPECT_GT(a.rgb[middle], 90);
  EXPECT_LT(a.rgb[middle], 200);
  EXPECT_LT(a.rgb[0], 40);  // the background
}

TEST(Preview, DarkEmptyAndBrokenLight) {
  const Flat dark = square(0.5f, 0, 0);
  EXPECT_EQ(draw_preview({dark.drawn()}, k_camera, 8, 8, false).rgb[3 * (4 * 8 + 4)], 0);
  EXPECT_EQ(draw_preview({}, k_camera, 8, 8, true).rgb.size(), 192u);
}

TEST(Preview, WireframeDarkensTheEdgesAlone) {
  const Flat flat = square(0.5f, 0, 1);
  const Picture plain = draw_preview({flat.drawn()}, k_camera, 64, 64, false);
  const Picture lines = draw_preview({flat.drawn()}, k_camera, 64, 64, true);
  const auto green = [](const Picture& picture, std::size_t x, std::size_t y) {
    return picture.rgb[3 * (y * 64 + x) + 1];
  };
  EXPECT_LT(green(lines, 32, 31), green(plain, 32, 31) - 35);  // the diagonal
  EXPECT_LT(green(lines, 16, 32), green(plain, 16, 32) - 15);  // the left side, of which half a line is inside
  EXPECT_EQ(green(lines, 24, 24), green(plain, 24, 24));       // inside a triangle
}

TEST(Preview, PngHasItsSignature) {
  const test::TemporaryFolder folder;
  save_png(folder.path("out.png"), Picture{2, 2, std::vector<std::uint8_t>(12, 128)});
  EXPECT_EQ(folder.read("out.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
}

/// A box from -1 to 1 whose fronts face inwards, without the wall at the named side (0..5: -x +x -y +y -z +z).
SceneData open_box(int open) {
  SceneData scene;
  scene.meshes.resize(1);
  MeshData& mesh = scene.meshes[0];
  for (int side = 0; side < 6; ++side) {
    if (side == open) {
      continue;
    }
    const int axis = side / 2;
    const float at = side % 2 == 0 ? -1.0f : 1.0f;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& [u, v] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
      glm::vec3 p;
      p[axis] = at;
      p[(axis + 1) % 3] = at < 0 ? u : v;
      p[(axis + 2) % 3] = at < 0 ? v : u;
      mesh.positions.push_back(p);
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) {
      mesh.indices.push_back(first + i);
    }
    mesh.triangle_materials.insert(mesh.triangle_materials.end(), 2, 0u);
  }
  return scene;
}

TEST(FindCamera, LooksIntoABoxThroughItsOpenSide) {
  const glm::dvec3 k_sides[] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (const int open : {0, 1, 4, 5}) {
    const Camera camera = find_camera(open_box(open), 4.0 / 3);
    EXPECT_GT(glm::dot(glm::normalize(camera.eye), k_sides[open]), 0.95) << open;
  }
}

TEST(FindCamera, SeesAllOfTheScene) {
  const SceneData scene = open_box(-1);
  const Camera camera = find_camera(scene, 4.0 / 3);
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  const double tangent = std::tan(camera.field_of_view / 2);
  for (const glm::vec3& position : scene.meshes[0].positions) {
    const glm::dvec3 offset = glm::dvec3(position) - camera.eye;
    const double distance = glm::dot(offset, forward);
    EXPECT_GT(distance, 0);
    EXPECT_LE(std::abs(glm::dot(offset, right)), distance * tangent * 4 / 3);
    EXPECT_LE(std::abs(glm::dot(offset, up)), distance * tangent);
  }
  EXPECT_TRUE(std::isfinite(find_camera(SceneData{}, 1).eye.x));
}

TEST(ProgressText, SaysHowFarAndHowLong) {
  radvor_progress progress{};
  progress.converged = 0.5;
  progress.rays = 1234567;
  progress.sites = 14000;
  progress.seconds = 90;
  EXPECT_EQ(progress_text(progress, false), " 50.0 %  1.2M rays  14.0k sites  1:30 min, 1:30 min left");
  EXPECT_EQ(progress_text(progress, true).substr(0, 27), "[############............] ");
  progress.converged = 0;
  EXPECT_EQ(progress_text(progress, false), "  0.0 %  1.2M rays  14.0k sites  1:30 min");
}

}  // namespace
}  // namespace bake
