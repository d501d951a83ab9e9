#include "output/points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/hash.h"
#include "output/lit_scene.h"

namespace radvor::output_test {
namespace {

struct Query {
  Vec3 position;
  glm::vec3 normal;
};

struct Answers {
  std::vector<glm::vec3> rgb;
  std::vector<std::uint8_t> found;
};

Answers ask(LitScene& scene, const std::vector<Query>& queries, double max_distance,
            Quantity quantity = Quantity::irradiance) {
  std::vector<double> positions;
  std::vector<float> normals;
  for (const Query& query : queries) {
    positions.insert(positions.end(), {query.position.x, query.position.y, query.position.z});
    normals.insert(normals.end(), {query.normal.x, query.normal.y, query.normal.z});
  }
  Answers answers;
  answers.rgb.resize(queries.size(), glm::vec3(-1.0f));
  answers.found.resize(queries.size(), 7);
  const PointIndex index(scene.lit());
  index.sample(scene.lit(), quantity, static_cast<std::uint32_t>(queries.size()), positions.data(), normals.data(),
               max_distance, queries.empty() ? nullptr : &answers.rgb.data()->x, answers.found.data());
  return answers;
}

Color linear(const Vec3& p, const Vec3&) {
  return {3 + p.x, 5 + 2 * p.y - p.x, 7 + p.x + p.y + p.z};
}

TEST(Points, LinearLightIsReadBackExactlyAnywhere) {
  LitScene scene({box({0, 0, 0}, {3, 2, 1}), cylinder(16)}, 0.3);
  scene.shine(linear);
  const auto& facets = scene.facets();
  std::vector<Query> queries;
  std::vector<Vec3> on_surface;
  for (std::uint32_t t = 0; t < scene.welded().triangles.size(); ++t) {
    const auto& vertices = scene.welded().triangles[t].vertices;
    for (std::uint64_t i = 0; i < 50; ++i) {
      double u = to_unit(hash(t, i, 0));
      double v = to_unit(hash(t, i, 1));
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const auto& p = scene.welded().positions;
      const Vec3 point = (1 - u - v) * p[vertices[0]] + u * p[vertices[1]] + v * p[vertices[2]];
      const Vec3 normal = facets.facets[facets.facet_of_triangle[t]].frame.normal;
      on_surface.push_back(point);
      queries.push_back({point + 1e-4 * normal, glm::vec3(normal)});
    }
  }
  const Answers answers = ask(scene, queries, 2e-4);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    ASSERT_EQ(answers.found[i], 1);
    EXPECT_LT(length(Color(answers.rgb[i]) - linear(on_surface[i], {})), 2e-6);
  }
}

TEST(Points, OnlyWhatIsNearAndFacesAlongTheNormalAnswers) {
  LitScene scene({box({0, 0, 0}, {1, 1, 1})}, 0.5);
  scene.shine(
      [](const Vec3&, const Vec3& n) { return Color(n.x > 0.5 ? 1 : 0, n.y > 0.5 ? 1 : 0, n.z > 0.5 ? 1 : 0); });
  const Answers answers = ask(scene,
                              {{{0.5, 0.5, 1.1}, {0, 0, 2}},   // above the top
                               {{0.5, 0.5, 1.3}, {0, 0, 1}},   // too far above it
                               {{0.5, 0.5, 1.1}, {0, 0, -1}},  // the bottom faces that way, and is far
                               {{0.9, 0.5, 0.95}, {1, 0, 0}},  // the top is nearer, the side faces
                               {{1, 0.3, 1}, {1, 0, 3}},       // on an edge: what faces most
                               {{1, 0.3, 1}, {3, 0, 1}},
                               {{0.5, 0.5, 1}, {0, 0, 0}}},  // faces nothing
                              0.2);
  EXPECT_EQ(answers.found, (std::vector<std::uint8_t>{1, 0, 0, 1, 1, 1, 0}));
  EXPECT_EQ(answers.rgb[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(answers.rgb[1], glm::vec3(0.0f));
  EXPECT_EQ(answers.rgb[2], glm::vec3(0.0f));
  EXPECT_EQ(answers.rgb[3], glm::vec3(1, 0, 0));
  EXPECT_EQ(answers.rgb[4], glm::vec3(0, 0, 1));
  EXPECT_EQ(answers.rgb[5], glm::vec3(1, 0, 0));
  EXPECT_EQ(answers.rgb[6], glm::vec3(0.0f));
}

TEST(Points, EachSideOfATwoSidedSurfaceAnswersForItself) {
  Material leaf;
  leaf.two_sided = true;
  LitScene scene({grid(2, 2)}, 0.5, {leaf});
  scene.shine([](const Vec3&, const Vec3& n) { return n.z > 0 ? Color(1, 0, 0) : Color(0, 0, 1); });
  const Answers answers = ask(scene, {{{0.7, 0.6, -0.1}, {0, 0, 1}}, {{0.7, 0.6, 0.1}, {0, 0, -1}}}, 1);
  EXPECT_EQ(answers.found, (std::vector<std::uint8_t>{1, 1}));
  EXPECT_EQ(answers.rgb[0], glm::vec3(1, 0, 0));
  EXPECT_EQ(answers.rgb[1], glm::vec3(0, 0, 1));
}

TEST(Points, AMeshThatDoesNotReceiveIsPassedOver) {
  Mesh nearer = grid(1, 1);
  nearer.receives = false;
  for (glm::vec3& p : nearer.positions) {
    p.z = 0.5f;
  }
  LitScene scene({std::move(nearer), grid(1, 1)}, 0.5);
  scene.shine(linear);
  const Answers answers = ask(scene, {{{0.25, 0.25, 0.5}, {0, 0, 1}}}, 1);
  EXPECT_EQ(answers.found[0], 1);
  EXPECT_LT(length(Color(answers.rgb[0]) - linear({0.25, 0.25, 0}, {})), 1e-5);
}

TEST(Points, NothingIsAskedAndNothingIsAnswered) {
  LitScene scene({grid(1, 1)}, 0.5);
  scene.shine(linear);
  EXPECT_TRUE(ask(scene, {}, 1).found.empty());
  const double position[] = {0.5, 0.5, std::numeric_limits<double>::quiet_NaN()};
  const float normal[] = {0, 0, 1};
  glm::vec3 rgb(5.0f);
  const PointIndex index(scene.lit());
  index.sample(scene.lit(), Quantity::direct, 1, position, normal, 1e9, &rgb.x, nullptr);
  EXPECT_EQ(rgb, glm::vec3(0.0f));
}

}  // namespace
}  // namespace radvor::output_test
