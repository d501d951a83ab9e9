// Where surfaces stand on and cut each other, every output shows each side's own light, and nothing comes apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "mesh_checks.h"
#include "output/adaptive_mesh.h"
#include "output/lit_scene.h"
#include "output/points.h"
#include "support/random_numbers.h"

namespace radvor::output_test {
namespace {

using mesh_checks::Triangles;

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

bool under_box(const Vec3& p) {
  return p.x > 1 && p.x < 2.5 && p.y > 1.25 && p.y < 2.25;
}

// A floor with a box on it; what is under the box is dark, what is beside it is bright.
class FloorWithBox : public LitScene {
 public:
  explicit FloorWithBox(double spacing) : LitScene({grid(4, 4), box({1, 1.25f, 0}, {2.5f, 2.25f, 1})}, spacing) {
    shine_samples([](const Sample& sample) { return Color(under_box(sample.point) ? 0.0 : 2.0); });
  }
};

TEST(ContactOutput, PointsShowTheirOwnSideOfAFootprint) {
  FloorWithBox scene(0.4);
  std::vector<double> positions;
  std::vector<float> normals;
  std::vector<bool> dark;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(0.01, 3.99);
  std::uniform_real_distribution<double> near(-1e-3, 1e-3);
  for (int k = 0; k < 3000; ++k) {
    Vec3 p(place(random), place(random), 0);
    if (k % 3 == 0) {  // closely beside one side of the box or another
      p.x = (k % 2 == 0 ? 1.0 : 2.5) + near(random);
    } else if (k % 3 == 1) {
      p.y = (k % 2 == 0 ? 1.25 : 2.25) + near(random);
    }
    positions.insert(positions.end(), {p.x, p.y, p.z});
    normals.insert(normals.end(), {0.0f, 0.0f, 1.0f});
    dark.push_back(under_box(p));
  }
  std::vector<float> rgb(positions.size());
  std::vector<std::uint8_t> found(dark.size());
  const PointIndex index(scene.lit());
  index.sample(scene.lit(), Quantity::irradiance, static_cast<std::uint32_t>(dark.size()), positions.data(),
               normals.data(), 1e-3, rgb.data(), found.data());
  for (std::size_t k = 0; k < dark.size(); ++k) {
    ASSERT_EQ(found[k], 1);
    ASSERT_EQ(rgb[3 * k], dark[k] ? 0.0f : 2.0f) << positions[3 * k] << " " << positions[3 * k + 1];
  }
}

TEST(ContactOutput, TheAdaptiveMeshHasBothValuesAlongAFootprint) {
  for (const double spacing : {0.3, 2.0}) {
    FloorWithBox scene(spacing);
    const AdaptiveMesh floor = make_adaptive_mesh(scene.lit(), 0);
    EXPECT_TRUE(mesh_checks::has_border_of(triangles_of(floor), triangles_of(scene.scene().meshes[0])));
    EXPECT_TRUE(mesh_checks::has_no_t_vertices(triangles_of(floor)));
    EXPECT_TRUE(mesh_checks::is_closed(triangles_of(make_adaptive_mesh(scene.lit(), 1))));
    std::map<mesh_checks::Position, std::set<float>> values;
    for (std::size_t v = 0; v < floor.positions.size(); ++v) {
      values[mesh_checks::key(floor.positions[v])].insert(floor.irradiance[v].r);
    }
    std::size_t on_footprint = 0;
    for (const auto& [position, shown] : values) {
      const Vec3 p(position[0], position[1], 0);
      const double beside = std::max({1 - p.x, p.x - 2.5, 1.25 - p.y, p.y - 2.25});
      if (std::abs(beside) < 1e-6) {
        EXPECT_EQ(shown, (std::set<float>{0.0f, 2.0f}));
        ++on_footprint;
      } else {
        EXPECT_EQ(shown, (std::set<float>{beside < 0 ? 0.0f : 2.0f}));
      }
    }
    EXPECT_GE(on_footprint, 4u);
    // No triangle reaches across.
    for (std::size_t t = 0; t < floor.indices.size(); t += 3) {
      EXPECT_EQ(floor.irradiance[floor.indices[t]], floor.irradiance[floor.indices[t + 1]]);
      EXPECT_EQ(floor.irradiance[floor.indices[t]], floor.irradiance[floor.indices[t + 2]]);
    }
  }
}

// Before cuts of edges were worked out in space, each facet at an edge had its own end of a cut, a few millionths from
// the others': in one of six of these scenes a vertex lay inside an edge.
TEST(ContactOutput, BoxesThroughBoxesStayClosed) {
  std::size_t contacts = 0;
  for (int trial = 0; trial < 24; ++trial) {
    test::RandomNumbers random(static_cast<std::uint64_t>(trial));
    std::vector<Mesh> boxes;
    for (int k = 0; k < 4 + trial % 8; ++k) {
      const glm::vec3 low = random.vector_between(0, 3);
      boxes.push_back(box(low, low + random.vector_between(0.4f, 2.5f)));
      if (k % 2 == 1) {
        const double c = std::cos(random.between(0.4f, 2.5f));
        const double s = std::sqrt(1 - c * c);
        boxes.back().transform = {c, -s, 0, 1, 0.8 * s, 0.8 * c, -0.6, 1, 0.6 * s, 0.6 * c, 0.8, -1};
      }
    }
    const std::size_t count = boxes.size();
    LitScene scene(std::move(boxes), trial % 2 == 0 ? 0.35 : 1.5);
    contacts += scene.facets().contacts.edges.size();
    for (std::uint32_t mesh = 0; mesh < count; ++mesh) {
      const Triangles cut = triangles_of(make_adaptive_mesh(scene.lit(), mesh));
      const Triangles given = triangles_of(scene.scene().meshes[mesh]);
      EXPECT_TRUE(mesh_checks::is_closed(cut)) << "trial " << trial << ", mesh " << mesh;
      EXPECT_TRUE(mesh_checks::has_no_t_vertices(cut)) << "trial " << trial << ", mesh " << mesh;
      EXPECT_NEAR(mesh_checks::volume(cut), mesh_checks::volume(given), 1e-4);
      EXPECT_NEAR(mesh_checks::area(cut), mesh_checks::area(given), 1e-4);
    }
  }
  EXPECT_GT(contacts, 600u);
}

}  // namespace
}  // namespace radvor::output_test
