// Bakes and what is read of them: every kind of mistake is refused with the right code and words, and changes nothing.
#include <gtest/gtest.h>
#include <radvor.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "api/engine.h"
#include "api/light_of.h"
#include "api/refusal.h"
#include "api/room.h"

namespace radvor::test {
namespace {

constexpr radvor_result k_argument = RADVOR_ERROR_INVALID_ARGUMENT;
constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_infinity = std::numeric_limits<float>::infinity();

// The two calls that make a solution, which refuse the same.
struct Maker {
  const char* name;
  radvor_result (*call)(const radvor_scene*, const radvor_bake_options*, radvor_solution**);
};
constexpr Maker k_makers[] = {{"radvor_bake", radvor_bake}, {"radvor_solution_create", radvor_solution_create}};

radvor_solution* const k_stale = reinterpret_cast<radvor_solution*>(std::uintptr_t{64});  // must become NULL

TEST(BakeOptions, OutOfRangeAreRefusedByName) {
  const Engine engine;
  const SceneOf scene(engine);
  const FloorAndLamp room;
  scene.add(room.desc());
  using Desc = radvor_bake_options;
  const std::vector<Refusal<Desc>> table = {
      {"struct_size is 0", k_argument, [](Desc& d) { d.struct_size = 0; }},
      {"struct_size is 68", k_argument, [](Desc& d) { d.struct_size = 68; }},
      {"lattice is 2", k_argument, [](Desc& d) { d.lattice = 2; }},
      {"disable is 0x400", k_argument, [](Desc& d) { d.disable = 1u << 10; }},
      {"reserved is 1", k_argument, [](Desc& d) { d.reserved = 1; }},
      {"tolerance is nan", k_argument, [](Desc& d) { d.tolerance = k_nan; }},
      {"tolerance is -0.5", k_argument, [](Desc& d) { d.tolerance = -0.5f; }},
      {"tolerance is 2", k_argument, [](Desc& d) { d.tolerance = 2; }},
      {"tie_tolerance is -1", k_argument, [](Desc& d) { d.tie_tolerance = -1; }},
      {"tie_tolerance is nan", k_argument, [](Desc& d) { d.tie_tolerance = k_nan; }},
      {"patch_spacing is -1", k_argument, [](Desc& d) { d.patch_spacing = -1; }},
      {"patch_spacing is inf", k_argument, [](Desc& d) { d.patch_spacing = k_infinity; }},
      {"min_spacing is nan", k_argument, [](Desc& d) { d.min_spacing = k_nan; }},
      {"min_spacing is 2, above patch_spacing, 1", k_argument,
       [](Desc& d) {
         d.min_spacing = 2;
         d.patch_spacing = 1;
       }},
      {"crease_angle is 3.2", k_argument, [](Desc& d) { d.crease_angle = 3.2f; }},
      {"crease_angle is nan", k_argument, [](Desc& d) { d.crease_angle = k_nan; }},
      {"weld_distance is -1", k_argument, [](Desc& d) { d.weld_distance = -1; }},
      {"weld_distance is inf", k_argument, [](Desc& d) { d.weld_distance = k_infinity; }},
      {"element_levels is 17", k_argument, [](Desc& d) { d.element_levels = 17; }},
      {"max_seconds is nan", k_argument, [](Desc& d) { d.max_seconds = NAN; }},
      {"max_seconds is -1", k_argument, [](Desc& d) { d.max_seconds = -1; }}};
  for (const Refusal<Desc>& line : table) {
    Desc options = coarse();
    line.spoil(options);
    for (const Maker& maker : k_makers) {
      radvor_solution* solution = k_stale;
      expect_refusal(engine, line.result, maker.name, line.words,
                     [&] { return maker.call(scene, &options, &solution); });
      EXPECT_EQ(solution, nullptr) << line.words;
    }
  }
}

TEST(Bake, NeedsAScenePlaceAndMesh) {
  const Engine engine;
  const SceneOf scene(engine);
  const radvor_bake_options options = coarse();
  for (const Maker& maker : k_makers) {
    radvor_solution* solution = k_stale;
    EXPECT_EQ(maker.call(nullptr, &options, &solution), k_argument);
    EXPECT_EQ(solution, nullptr);
    expect_refusal(engine, k_argument, maker.name, "NULL", [&] { return maker.call(scene, &options, nullptr); });
    solution = k_stale;
    expect_refusal(engine, k_argument, maker.name, "no mesh", [&] { return maker.call(scene, &options, &solution); });
    EXPECT_EQ(solution, nullptr);
  }
  radvor_solution_destroy(nullptr);
}

TEST(Bake, WithoutAnEmbreeIsUnsupportedAndSaysWhatWasTried) {
  std::string heard;
  radvor_context_desc desc{};
  desc.struct_size = sizeof desc;
  desc.embree_path = "/nowhere/libembree.so";
  desc.user = &heard;
  desc.log = [](void* user, std::int32_t, const char* text) { *static_cast<std::string*>(user) = text; };
  radvor_context* context = nullptr;
  ASSERT_EQ(radvor_context_create(&desc, &context), RADVOR_OK) << "who only triangulates needs none";
  radvor_scene* scene = nullptr;
  ASSERT_EQ(radvor_scene_create(context, &scene), RADVOR_OK);
  const radvor_material_desc material = gray(0.5f, 1);
  std::uint32_t id = RADVOR_NONE;
  ASSERT_EQ(radvor_scene_add_material(scene, &material, &id), RADVOR_OK);
  ASSERT_EQ(radvor_scene_add_material(scene, &material, &id), RADVOR_OK);
  const FloorAndLamp room;
  const radvor_mesh_desc mesh = room.desc();
  ASSERT_EQ(radvor_scene_add_mesh(scene, &mesh, &id), RADVOR_OK);
  radvor_solution* solution = k_stale;
  const radvor_bake_options options = coarse();
  EXPECT_EQ(radvor_bake(scene, &options, &solution), RADVOR_ERROR_UNSUPPORTED);
  EXPECT_EQ(solution, nullptr);
  EXPECT_NE(std::string(radvor_context_error(context)).find("/nowhere/libembree.so"), std::string::npos)
      << radvor_context_error(context);
  EXPECT_EQ(heard, radvor_context_error(context));
  radvor_scene_destroy(scene);
  radvor_context_destroy(context);
}

class Solution : public testing::Test {
 protected:
  void SetUp() override {
    scene_.add(room_.desc());
    const radvor_bake_options options = coarse();
    ASSERT_EQ(radvor_bake(scene_, &options, &solution_), RADVOR_OK) << engine_.error();
  }
  void TearDown() override { radvor_solution_destroy(solution_); }

  void refused(radvor_result expected, const char* function, const char* words,
               const std::function<radvor_result()>& call) {
    expect_refusal(engine_, expected, function, words, call);
  }

  Engine engine_;
  SceneOf scene_{engine_};
  FloorAndLamp room_;
  radvor_solution* solution_ = nullptr;
};

TEST_F(Solution, VerticesRefuseBadArguments) {
  std::vector<float> rgb(24, -7);
  const std::vector<float> untouched = rgb;
  const auto call = [&](std::uint32_t mesh, std::uint32_t quantity, std::uint32_t mode, float* out, std::size_t stride,
                        std::uint32_t count) {
    return [=, this] { return radvor_solution_vertices(solution_, mesh, quantity, mode, out, stride, count); };
  };
  const char* const function = "radvor_solution_vertices";
  EXPECT_EQ(radvor_solution_vertices(nullptr, 0, 0, 0, rgb.data(), 0, 8), k_argument);
  refused(k_argument, function, "rgb is NULL", call(0, 0, 0, nullptr, 0, 8));
  refused(k_argument, function, "mesh is 1, but the scene had 1", call(1, 0, 0, rgb.data(), 0, 8));
  refused(k_argument, function, "mesh is 4294967295", call(UINT32_MAX, 0, 0, rgb.data(), 0, 8));
  refused(k_argument, function, "quantity is 0x4", call(0, 4, 0, rgb.data(), 0, 8));
  refused(k_argument, function, "quantity is 0x20000", call(0, 1 << 17, 0, rgb.data(), 0, 8));
  refused(k_argument, function, "mode is 2", call(0, 0, 2, rgb.data(), 0, 8));
  refused(k_argument, function, "vertex_count is 7, but mesh 0 has 8", call(0, 0, 0, rgb.data(), 0, 7));
  refused(k_argument, function, "vertex_count is 0", call(0, 0, 0, rgb.data(), 0, 0));
  refused(k_argument, function, "stride is 8", call(0, 0, 0, rgb.data(), 8, 8));
  refused(k_argument, function, "stride is 13", call(0, 0, 0, rgb.data(), 13, 8));
  refused(k_argument, function, "stride is", call(0, 0, 0, rgb.data(), SIZE_MAX - 3, 8));
  EXPECT_EQ(rgb, untouched);
}

TEST_F(Solution, VerticesKeepToTheirStride) {
  std::vector<float> dense(24), strided(8 * 5, -7);
  ASSERT_EQ(radvor_solution_vertices(solution_, 0, RADVOR_RADIANCE, 0, dense.data(), 0, 8), RADVOR_OK);
  ASSERT_EQ(radvor_solution_vertices(solution_, 0, RADVOR_RADIANCE, 0, strided.data(), 20, 8), RADVOR_OK);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(strided[i], i % 5 < 3 ? dense[i / 5 * 3 + i % 5] : -7) << i;
  }
}

TEST_F(Solution, BacksOfOneSidedSurfacesAreDark) {
  std::vector<float> rgb(24, -7);
  ASSERT_EQ(radvor_solution_vertices(solution_, 0, RADVOR_IRRADIANCE | RADVOR_SIDE_BACK, 0, rgb.data(), 0, 8),
            RADVOR_OK);
  EXPECT_EQ(rgb, std::vector<float>(24, 0.0f));
}

TEST_F(Solution, PointsRefuseBadArguments) {
  const std::vector<double> positions = {0.5, 0, 0.5, 0.5, 0, 0.5};
  const std::vector<float> normals = {0, 1, 0, 0, 1, 0};
  std::vector<double> bad_positions = positions;
  std::vector<float> bad_normals = normals;
  bad_positions[4] = NAN;
  bad_normals[5] = k_infinity;
  std::vector<float> rgb(6, -7);
  std::vector<std::uint8_t> found(2, 7);
  const char* const function = "radvor_solution_points";
  const auto call = [&](std::uint32_t quantity, std::uint32_t count, const double* at, const float* facing, double far,
                        float* out) {
    return [=, this, &found] {
      return radvor_solution_points(solution_, quantity, count, at, facing, far, out, found.data());
    };
  };
  EXPECT_EQ(radvor_solution_points(nullptr, 0, 2, positions.data(), normals.data(), 1, rgb.data(), nullptr),
            k_argument);
  refused(k_argument, function, "positions is NULL", call(0, 2, nullptr, normals.data(), 1, rgb.data()));
  refused(k_argument, function, "normals is NULL", call(0, 2, positions.data(), nullptr, 1, rgb.data()));
  refused(k_argument, function, "rgb is NULL", call(0, 2, positions.data(), normals.data(), 1, nullptr));
  refused(k_argument, function, "quantity is 0x7", call(7, 2, positions.data(), normals.data(), 1, rgb.data()));
  refused(k_argument, function, "RADVOR_SIDE_BACK",
          call(RADVOR_SIDE_BACK, 2, positions.data(), normals.data(), 1, rgb.data()));
  refused(k_argument, function, "max_distance is nan", call(0, 2, positions.data(), normals.data(), NAN, rgb.data()));
  refused(k_argument, function, "max_distance is -1", call(0, 2, positions.data(), normals.data(), -1, rgb.data()));
  refused(RADVOR_ERROR_INVALID_GEOMETRY, function, "component 1 of positions[1] is nan",
          call(0, 2, bad_positions.data(), normals.data(), 1, rgb.data()));
  refused(RADVOR_ERROR_INVALID_GEOMETRY, function, "component 2 of normals[1] is inf",
          call(0, 2, positions.data(), bad_normals.data(), 1, rgb.data()));
  EXPECT_EQ(rgb, std::vector<float>(6, -7.0f));
  EXPECT_EQ(found, std::vector<std::uint8_t>(2, 7));
}

TEST_F(Solution, PointsFarAwayWithoutDirectionOrNumberAreNoError) {
  EXPECT_EQ(radvor_solution_points(solution_, 0, 0, nullptr, nullptr, 1, nullptr, nullptr), RADVOR_OK);
  const std::vector<double> positions = {1e300, -1e300, 1e300, 0.5, 0, 0.5, 0.5, 0, 0.5};
  const std::vector<float> normals = {0, 1, 0, 0, 0, 0, 0, 1, 0};
  std::vector<float> rgb(9, NAN);
  std::vector<std::uint8_t> found(3, 7);
  EXPECT_EQ(radvor_solution_points(solution_, 0, 3, positions.data(), normals.data(), 0.1, rgb.data(), found.data()),
            RADVOR_OK)
      << engine_.error();
  EXPECT_EQ(found, (std::vector<std::uint8_t>{0, 0, 1}));
  EXPECT_EQ(std::vector<float>(rgb.begin(), rgb.begin() + 6), std::vector<float>(6, 0.0f));
  EXPECT_GT(rgb[6], 0);
  std::vector<float> alone(9, NAN);
  EXPECT_EQ(radvor_solution_points(solution_, 0, 3, positions.data(), normals.data(), INFINITY, alone.data(), nullptr),
            RADVOR_OK)
      << engine_.error();
  EXPECT_EQ(alone[6], rgb[6]);
}

TEST_F(Solution, MeshRefusesBadArguments) {
  radvor_output_mesh mesh{};
  const char* const function = "radvor_solution_mesh";
  mesh.struct_size = sizeof mesh;
  EXPECT_EQ(radvor_solution_mesh(nullptr, 0, &mesh), k_argument);
  refused(k_argument, function, "output is NULL", [&] { return radvor_solution_mesh(solution_, 0, nullptr); });
  refused(k_argument, function, "mesh is 1", [&] { return radvor_solution_mesh(solution_, 1, &mesh); });
  mesh.struct_size = 0;
  refused(k_argument, function, "struct_size is 0", [&] { return radvor_solution_mesh(solution_, 0, &mesh); });
  mesh.struct_size = sizeof mesh + 4;
  refused(k_argument, function, "", [&] {
    struct {
      radvor_output_mesh known;
      std::uint32_t unknown = 1;
    } grown{mesh};
    return radvor_solution_mesh(solution_, 0, &grown.known);
  });
  EXPECT_EQ(mesh.positions, nullptr);
}

TEST_F(Solution, OutputsAreWrittenAsFarAsTheirSizeReaches) {
  radvor_output_mesh whole{}, small;
  whole.struct_size = sizeof whole;
  ASSERT_EQ(radvor_solution_mesh(solution_, 0, &whole), RADVOR_OK) << engine_.error();
  std::memset(&small, 0x5a, sizeof small);
  small.struct_size = offsetof(radvor_output_mesh, uvs);
  ASSERT_EQ(radvor_solution_mesh(solution_, 0, &small), RADVOR_OK) << engine_.error();
  EXPECT_EQ(small.struct_size, offsetof(radvor_output_mesh, uvs));
  EXPECT_EQ(small.triangle_count, whole.triangle_count);
  EXPECT_EQ(small.normals, whole.normals) << "asked twice, it is the same view";
  for (std::size_t i = offsetof(radvor_output_mesh, uvs); i < sizeof small; ++i) {
    EXPECT_EQ(reinterpret_cast<const unsigned char*>(&small)[i], 0x5a) << i;
  }
  radvor_stats stats;
  std::memset(&stats, 0x5a, sizeof stats);
  stats.struct_size = offsetof(radvor_stats, shots);
  ASSERT_EQ(radvor_solution_stats(solution_, &stats), RADVOR_OK) << engine_.error();
  EXPECT_GT(stats.sites, 8u);
  for (std::size_t i = offsetof(radvor_stats, shots); i < sizeof stats; ++i) {
    EXPECT_EQ(reinterpret_cast<const unsigned char*>(&stats)[i], 0x5a) << i;
  }
}

TEST_F(Solution, StatsRefuseBadArguments) {
  radvor_stats stats{};
  const char* const function = "radvor_solution_stats";
  stats.struct_size = sizeof stats;
  EXPECT_EQ(radvor_solution_stats(nullptr, &stats), k_argument);
  refused(k_argument, function, "stats is NULL", [&] { return radvor_solution_stats(solution_, nullptr); });
  stats.struct_size = 2;
  refused(k_argument, function, "struct_size is 2", [&] { return radvor_solution_stats(solution_, &stats); });
}

TEST_F(Solution, AdvanceRefusesBadArguments) {
  radvor_progress progress{};
  const char* const function = "radvor_solution_advance";
  progress.struct_size = sizeof progress;
  EXPECT_EQ(radvor_solution_advance(nullptr, 1, &progress), k_argument);
  refused(k_argument, function, "seconds is -1", [&] { return radvor_solution_advance(solution_, -1, &progress); });
  refused(k_argument, function, "seconds is nan", [&] { return radvor_solution_advance(solution_, NAN, &progress); });
  progress.struct_size = 6;
  refused(k_argument, function, "struct_size is 6", [&] { return radvor_solution_advance(solution_, 1, &progress); });
  EXPECT_EQ(progress.sites, 0u);
  EXPECT_EQ(radvor_solution_advance(solution_, 1, nullptr), RADVOR_OK) << engine_.error();
}

TEST_F(Solution, OutlivesItsScene) {
  const LightOf before = read_light(solution_, 8);
  radvor_scene* scene = nullptr;
  ASSERT_EQ(radvor_scene_create(engine_.context(), &scene), RADVOR_OK);
  const radvor_material_desc materials[] = {gray(0.5f), gray(0.5f, 4)};
  std::uint32_t id = RADVOR_NONE;
  for (const radvor_material_desc& material : materials) {
    ASSERT_EQ(radvor_scene_add_material(scene, &material, &id), RADVOR_OK);
  }
  const radvor_mesh_desc desc = room_.desc();
  ASSERT_EQ(radvor_scene_add_mesh(scene, &desc, &id), RADVOR_OK);
  radvor_solution* solution = nullptr;
  const radvor_bake_options options = coarse();
  ASSERT_EQ(radvor_solution_create(scene, &options, &solution), RADVOR_OK) << engine_.error();
  ASSERT_EQ(radvor_scene_add_mesh(scene, &desc, &id), RADVOR_OK) << "a change that the snapshot does not see";
  radvor_scene_destroy(scene);
  ASSERT_EQ(radvor_solution_advance(solution, 0, nullptr), RADVOR_OK) << engine_.error();
  EXPECT_TRUE(read_light(solution, 8) == before);
  radvor_solution_destroy(solution);
}

}  // namespace
}  // namespace radvor::test
