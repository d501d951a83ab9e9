// Materials, meshes and lights: every kind of mistake is refused with the right code and words, and changes nothing.
#include <gtest/gtest.h>
#include <radvor.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "api/engine.h"
#include "api/refusal.h"
#include "api/room.h"

namespace radvor::test {
namespace {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_infinity = std::numeric_limits<float>::infinity();

template <class Desc>
using Add = radvor_result (*)(radvor_scene*, const Desc*, std::uint32_t*);

// After every refusal a valid description gets the id that it would have got without it.
template <class Desc>
void expect_refusals(const char* function, Add<Desc> add, const Desc& valid, std::uint32_t next_id,
                     const std::vector<Refusal<Desc>>& table) {
  const Engine engine;
  const SceneOf scene(engine);
  for (const Refusal<Desc>& line : table) {
    Desc spoilt = valid;
    line.spoil(spoilt);
    std::uint32_t id = 12345;
    expect_refusal(engine, line.result, function, line.words, [&] { return add(scene, &spoilt, &id); });
    EXPECT_EQ(id, 12345u) << line.words;
  }
  std::uint32_t id = 12345;
  expect_refusal(engine, RADVOR_ERROR_INVALID_ARGUMENT, function, "desc is NULL",
                 [&] { return add(scene, nullptr, &id); });
  expect_refusal(engine, RADVOR_ERROR_INVALID_ARGUMENT, function, " is NULL",
                 [&] { return add(scene, &valid, nullptr); });
  EXPECT_EQ(add(nullptr, &valid, &id), RADVOR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(id, 12345u);
  EXPECT_EQ(add(scene, &valid, &id), RADVOR_OK) << engine.error();
  EXPECT_EQ(id, next_id);
  EXPECT_EQ(add(scene, &valid, &id), RADVOR_OK) << engine.error();
  EXPECT_EQ(id, next_id + 1);
}

TEST(Scene, NeedsAContextAndAPlaceForTheHandle) {
  const Engine engine;
  radvor_scene* scene = reinterpret_cast<radvor_scene*>(std::uintptr_t{64});
  EXPECT_EQ(radvor_scene_create(nullptr, &scene), RADVOR_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(scene, nullptr);
  EXPECT_EQ(radvor_scene_create(engine.context(), nullptr), RADVOR_ERROR_INVALID_ARGUMENT);
  radvor_scene_destroy(nullptr);
}

TEST(Scene, RefusesBadMaterials) {
  using Desc = radvor_material_desc;
  expect_refusals<Desc>(
      "radvor_scene_add_material", radvor_scene_add_material, gray(0.5f, 1), 2,
      {{"struct_size is 0", RADVOR_ERROR_INVALID_ARGUMENT, [](Desc& d) { d.struct_size = 0; }},
       {"material 2: flags is 0x6, of which 0x6 is unknown", RADVOR_ERROR_INVALID_ARGUMENT,
        [](Desc& d) { d.flags = 6; }},
       {"material 2: albedo[0] is -0.1", RADVOR_ERROR_INVALID_ARGUMENT, [](Desc& d) { d.albedo[0] = -0.1f; }},
       {"material 2: albedo[1] is 1.5", RADVOR_ERROR_INVALID_ARGUMENT, [](Desc& d) { d.albedo[1] = 1.5f; }},
       {"material 2: albedo[2] is nan", RADVOR_ERROR_INVALID_ARGUMENT, [](Desc& d) { d.albedo[2] = k_nan; }},
       {"material 2: emission[0] is inf", RADVOR_ERROR_INVALID_ARGUMENT, [](Desc& d) { d.emission[0] = k_infinity; }},
       {"material 2: emission[1] is nan", RADVOR_ERROR_INVALID_ARGUMENT, [](Desc& d) { d.emission[1] = k_nan; }},
       {"material 2: emission[2] is -1", RADVOR_ERROR_INVALID_ARGUMENT, [](Desc& d) { d.emission[2] = -1; }},
       {"material 2: transmission[0] is nan", RADVOR_ERROR_INVALID_ARGUMENT,
        [](Desc& d) { d.transmission[0] = k_nan; }},
       {"material 2: transmission[1] is 2", RADVOR_ERROR_INVALID_ARGUMENT, [](Desc& d) { d.transmission[1] = 2; }},
       {"material 2: transmission", RADVOR_ERROR_UNSUPPORTED, [](Desc& d) { d.transmission[2] = 0.5f; }}});
}

TEST(Scene, RefusesBadMeshes) {
  static FloorAndLamp room;
  static std::vector<float> positions, normals(24, 1), colors(24, 1), uvs(16, 0);
  static std::vector<std::uint32_t> indices, materials;
  static std::vector<std::uint16_t> short_indices;
  static double transform[12];
  const auto spoilt = [](auto values, std::size_t i, auto value) {
    values[i] = value;
    return values;
  };
  const auto identity_but = [](std::size_t i, double value) {
    for (std::size_t k = 0; k < 12; ++k) {
      transform[k] = k % 5 == 0 ? 1 : 0;
    }
    transform[i] = value;
    return transform;
  };
  using Desc = radvor_mesh_desc;
  const radvor_result argument = RADVOR_ERROR_INVALID_ARGUMENT, geometry = RADVOR_ERROR_INVALID_GEOMETRY;
  Desc valid = room.desc();
  valid.normals = normals.data();
  valid.colors = colors.data();
  valid.uvs = uvs.data();
  expect_refusals<Desc>("radvor_scene_add_mesh", radvor_scene_add_mesh, valid, 0,
                        {{"struct_size is 0", argument, [](Desc& d) { d.struct_size = 0; }},
                         {"mesh 0: flags is 0x8", argument, [](Desc& d) { d.flags = 8; }},
                         {"mesh 0: positions is NULL", argument, [](Desc& d) { d.positions = nullptr; }},
                         {"mesh 0: indices is NULL", argument, [](Desc& d) { d.indices = nullptr; }},
                         {"vertex_count is 0", argument, [](Desc& d) { d.vertex_count = 0; }},
                         {"triangle_count 0", argument, [](Desc& d) { d.triangle_count = 0; }},
                         {"4294967295 vertices", RADVOR_ERROR_LIMIT, [](Desc& d) { d.vertex_count = UINT32_MAX; }},
                         {"4294967295 triangles", RADVOR_ERROR_LIMIT, [](Desc& d) { d.triangle_count = UINT32_MAX; }},
                         {"mesh 0: position_stride is 11 bytes", argument, [](Desc& d) { d.position_stride = 11; }},
                         {"mesh 0: normal_stride is 8 bytes", argument, [](Desc& d) { d.normal_stride = 8; }},
                         {"mesh 0: color_stride is 1 bytes", argument, [](Desc& d) { d.color_stride = 1; }},
                         {"mesh 0: uv_stride is 7 bytes", argument, [](Desc& d) { d.uv_stride = 7; }},
                         {"mesh 0: position_stride", argument, [](Desc& d) { d.position_stride = SIZE_MAX; }},
                         {"mesh 0: index_size is 3", argument, [](Desc& d) { d.index_size = 3; }},
                         {"mesh 0: index_size is 8", argument, [](Desc& d) { d.index_size = 8; }},
                         {"corner 1 of triangle 3 has index 8, but vertex_count is 8", geometry,
                          [=](Desc& d) { d.indices = (indices = spoilt(room.indices, 10, 8u)).data(); }},
                         {"corner 0 of triangle 0 has index 4294967295", geometry,
                          [=](Desc& d) { d.indices = (indices = spoilt(room.indices, 0, UINT32_MAX)).data(); }},
                         {"corner 2 of triangle 1 has index 65535", geometry,
                          [=](Desc& d) {
                            short_indices = spoilt(std::vector<std::uint16_t>(12, 1), 5, std::uint16_t{65535});
                            d.indices = short_indices.data();
                            d.index_size = 2;
                          }},
                         {"mesh 0: material is 2, but the scene has 2 materials", argument,
                          [](Desc& d) {
                            d.triangle_materials = nullptr;
                            d.material = 2;
                          }},
                         {"mesh 0: triangle_materials[3] is 7", argument,
                          [=](Desc& d) { d.triangle_materials = (materials = spoilt(room.materials, 3, 7u)).data(); }},
                         {"component 1 of positions[2] is nan", geometry,
                          [=](Desc& d) { d.positions = (positions = spoilt(room.positions, 7, k_nan)).data(); }},
                         {"component 2 of positions[7] is -inf", geometry,
                          [=](Desc& d) { d.positions = (positions = spoilt(room.positions, 23, -k_infinity)).data(); }},
                         {"positions[0] comes to 1e+17 on axis 0", RADVOR_ERROR_LIMIT,
                          [=](Desc& d) { d.positions = (positions = spoilt(room.positions, 0, 1e17f)).data(); }},
                         {"positions[0] comes to -2e+16 on axis 1", RADVOR_ERROR_LIMIT,
                          [=](Desc& d) { d.transform = identity_but(7, -2e16); }},
                         {"transform[3] is nan", geometry, [=](Desc& d) { d.transform = identity_but(3, NAN); }},
                         {"transform[11] is inf", geometry, [=](Desc& d) { d.transform = identity_but(11, INFINITY); }},
                         {"comes to inf on axis 2", RADVOR_ERROR_LIMIT,
                          [=](Desc& d) {
                            d.positions = (positions = spoilt(room.positions, 2, 1e10f)).data();
                            d.transform = identity_but(10, 1e308);
                          }},
                         {"component 0 of normals[1] is nan", geometry,
                          [=](Desc& d) { d.normals = (positions = spoilt(normals, 3, k_nan)).data(); }},
                         {"component 2 of colors[7] is nan", argument,
                          [=](Desc& d) { d.colors = (positions = spoilt(colors, 23, k_nan)).data(); }},
                         {"component 1 of colors[0] is -1, below 0", argument,
                          [=](Desc& d) { d.colors = (positions = spoilt(colors, 1, -1.0f)).data(); }},
                         {"component 1 of uvs[7] is inf", geometry,
                          [=](Desc& d) { d.uvs = (positions = spoilt(uvs, 15, k_infinity)).data(); }}});
}

TEST(Scene, RefusesBadLights) {
  using Desc = radvor_light_desc;
  const radvor_result argument = RADVOR_ERROR_INVALID_ARGUMENT, geometry = RADVOR_ERROR_INVALID_GEOMETRY;
  Desc valid{};
  valid.struct_size = sizeof valid;
  valid.type = RADVOR_LIGHT_SPOT;
  valid.position[1] = 2;
  valid.direction[1] = -3;
  valid.color[0] = 1;
  const auto as = [](Desc& d, std::uint32_t type) { d.type = type; };
  static const float pixels[3] = {1, 1, 1};
  expect_refusals<Desc>(
      "radvor_scene_add_light", radvor_scene_add_light, valid, 0,
      {{"struct_size is 0", argument, [](Desc& d) { d.struct_size = 0; }},
       {"light 0: type is 4", argument, [](Desc& d) { d.type = 4; }},
       {"light 0: type is 4294967295", argument, [](Desc& d) { d.type = UINT32_MAX; }},
       {"light 0: group is 1", RADVOR_ERROR_UNSUPPORTED, [](Desc& d) { d.group = 1; }},
       {"light 0: reserved is 1", argument, [](Desc& d) { d.reserved = 1; }},
       {"light 0: color[0] is nan", argument, [](Desc& d) { d.color[0] = k_nan; }},
       {"light 0: color[1] is -1", argument, [](Desc& d) { d.color[1] = -1; }},
       {"light 0: color[2] is inf", argument, [](Desc& d) { d.color[2] = k_infinity; }},
       {"light 0: position[0] is nan", geometry, [](Desc& d) { d.position[0] = NAN; }},
       {"light 0: position[1] is inf", geometry, [](Desc& d) { d.position[1] = INFINITY; }},
       {"light 0: position[2] is 1e+17", RADVOR_ERROR_LIMIT, [](Desc& d) { d.position[2] = 1e17; }},
       {"light 0: direction[1] is nan", geometry, [](Desc& d) { d.direction[1] = k_nan; }},
       {"light 0: direction is 0 0 0", argument, [](Desc& d) { d.direction[1] = 0; }},
       {"light 0: direction is 0 0 0", argument,
        [=](Desc& d) {
          as(d, RADVOR_LIGHT_DIRECTIONAL);
          d.direction[1] = 0;
        }},
       {"light 0: radius is nan", argument, [](Desc& d) { d.radius = k_nan; }},
       {"light 0: radius is -1", argument, [](Desc& d) { d.radius = -1; }},
       {"light 0: outer_angle is 1.6", argument, [](Desc& d) { d.outer_angle = 1.6f; }},
       {"light 0: outer_angle is nan", argument, [](Desc& d) { d.outer_angle = k_nan; }},
       {"light 0: outer_angle is -1", argument, [](Desc& d) { d.outer_angle = -1; }},
       {"light 0: inner_angle is 0.5, not below outer_angle, 0.5", argument,
        [](Desc& d) { d.inner_angle = d.outer_angle = 0.5f; }},
       {"light 0: inner_angle is 1, not below outer_angle, 0.785", argument, [](Desc& d) { d.inner_angle = 1; }},
       {"light 0: inner_angle is nan", argument, [](Desc& d) { d.inner_angle = k_nan; }},
       {"light 0: angle is 4", argument,
        [=](Desc& d) {
          as(d, RADVOR_LIGHT_DIRECTIONAL);
          d.angle = 4;
        }},
       {"light 0: angle is -1", argument,
        [=](Desc& d) {
          as(d, RADVOR_LIGHT_DIRECTIONAL);
          d.angle = -1;
        }},
       {"light 0: image: only a sky", argument, [](Desc& d) { d.image = pixels; }},
       {"light 0: image is NULL, but 2 by 1", argument,
        [=](Desc& d) {
          as(d, RADVOR_LIGHT_SKY);
          d.image_width = 2;
          d.image_height = 1;
        }},
       {"light 0: image", RADVOR_ERROR_UNSUPPORTED, [=](Desc& d) {
          as(d, RADVOR_LIGHT_SKY);
          d.image = pixels;
          d.image_width = d.image_height = 1;
        }}});
}

TEST(Scene, RefusesSitesThatAreNotOnTheMesh) {
  const Engine engine;
  const SceneOf scene(engine);
  const FloorAndLamp room;
  EXPECT_EQ(scene.add(room.desc()), 0u);
  radvor_mesh_desc dark = room.desc();
  dark.flags = RADVOR_MESH_NO_RECEIVE;
  EXPECT_EQ(scene.add(dark), 1u);
  // The floor, the lamp, an edge, a corner; off by as much as rounding to float explains.
  std::vector<double> on = {0.3, 1e-7, 0.4, 0.5, 1, 0.5, 0.5, 0, 0, 1, 0, 1};
  EXPECT_EQ(radvor_scene_add_sites(scene, 0, on.data(), 4), RADVOR_OK) << engine.error();
  EXPECT_EQ(radvor_scene_add_sites(scene, 0, nullptr, 0), RADVOR_OK) << engine.error();
  const auto refused = [&](radvor_result result, const char* words, std::uint32_t mesh, std::vector<double> points) {
    expect_refusal(engine, result, "radvor_scene_add_sites", words, [&] {
      return radvor_scene_add_sites(scene, mesh, points.data(), static_cast<std::uint32_t>(points.size() / 3));
    });
  };
  refused(RADVOR_ERROR_INVALID_ARGUMENT, "there is no mesh 2", 2, on);
  refused(RADVOR_ERROR_INVALID_ARGUMENT, "mesh 1 does not receive", 1, on);
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "point 1, (0.5 0.25 0.5), lies on no triangle of mesh 0", 0,
          {0.3, 0, 0.4, 0.5, 0.25, 0.5});
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "point 0, (1.001 0 0.5), lies on no triangle of mesh 0", 0, {1.001, 0, 0.5});
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "point 0, (nan 0 0.5), is not finite", 0, {NAN, 0, 0.5});
  refused(RADVOR_ERROR_INVALID_GEOMETRY, "point 0, (0 inf 0.5), is not finite", 0, {0, INFINITY, 0.5});
  expect_refusal(engine, RADVOR_ERROR_INVALID_ARGUMENT, "radvor_scene_add_sites", "positions is NULL",
                 [&] { return radvor_scene_add_sites(scene, 0, nullptr, 1); });
  EXPECT_EQ(radvor_scene_add_sites(nullptr, 0, on.data(), 1), RADVOR_ERROR_INVALID_ARGUMENT);
}

TEST(Scene, SitesGivenAreSitesOfTheBake) {
  const Engine engine;
  const FloorAndLamp room;
  const double point[3] = {0.3141, 0, 0.4142};
  const auto floor_vertices = [&](bool given) {
    const SceneOf scene(engine);
    EXPECT_EQ(scene.add(room.desc()), 0u);
    if (given) {
      EXPECT_EQ(radvor_scene_add_sites(scene, 0, point, 1), RADVOR_OK) << engine.error();
    }
    radvor_bake_options options = coarse();
    options.patch_spacing = 0.8f;
    options.min_spacing = 0.4f;
    options.disable = RADVOR_DISABLE_REFINEMENT;
    radvor_solution* solution = nullptr;
    EXPECT_EQ(radvor_solution_create(scene, &options, &solution), RADVOR_OK) << engine.error();
    radvor_output_mesh mesh{};
    mesh.struct_size = sizeof mesh;
    EXPECT_EQ(radvor_solution_mesh(solution, 0, &mesh), RADVOR_OK) << engine.error();
    std::size_t there = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
      there += mesh.positions[3 * v] == 0.3141f && mesh.positions[3 * v + 2] == 0.4142f ? 1u : 0u;
    }
    radvor_solution_destroy(solution);
    return there;
  };
  EXPECT_EQ(floor_vertices(false), 0u);
  EXPECT_EQ(floor_vertices(true), 1u);
}

TEST(Scene, TakesTheExtremesOfEachRange) {
  const Engine engine;
  const SceneOf scene(engine);
  std::uint32_t id = RADVOR_NONE;
  radvor_material_desc white = gray(1, std::numeric_limits<float>::max());
  white.flags = RADVOR_MATERIAL_TWO_SIDED;
  EXPECT_EQ(radvor_scene_add_material(scene, &white, &id), RADVOR_OK) << engine.error();

  radvor_light_desc light{};
  light.struct_size = sizeof light;
  EXPECT_EQ(radvor_scene_add_light(scene, &light, &id), RADVOR_OK) << "a dark point light: " << engine.error();
  light.type = RADVOR_LIGHT_SKY;
  EXPECT_EQ(radvor_scene_add_light(scene, &light, &id), RADVOR_OK) << "up is +y: " << engine.error();
  light.type = RADVOR_LIGHT_SPOT;
  light.direction[2] = std::numeric_limits<float>::denorm_min();
  light.outer_angle = 1.5707964f;  // pi / 2 in float, a little more than pi / 2
  EXPECT_EQ(radvor_scene_add_light(scene, &light, &id), RADVOR_OK) << engine.error();
  light.type = RADVOR_LIGHT_DIRECTIONAL;
  light.direction[2] = std::numeric_limits<float>::max();
  light.angle = 3.1415927f;
  light.position[0] = NAN;  // not read
  EXPECT_EQ(radvor_scene_add_light(scene, &light, &id), RADVOR_OK) << engine.error();
  EXPECT_EQ(id, 3u);
}

TEST(Scene, ReadsStridedAndUnalignedArrays) {
  const Engine engine;
  const SceneOf scene(engine);
  const FloorAndLamp room;
  constexpr std::size_t k_stride = 29;
  std::vector<char> bytes(k_stride * 8 + 1, '\xff');  // NaNs between the vertices
  for (std::size_t i = 0; i < 8; ++i) {
    std::memcpy(&bytes[1 + i * k_stride], &room.positions[3 * i], 12);
  }
  radvor_mesh_desc desc = room.desc();
  desc.positions = reinterpret_cast<const float*>(&bytes[1]);
  desc.position_stride = k_stride;
  desc.index_size = 2;
  const std::vector<std::uint16_t> indices(room.indices.begin(), room.indices.end());
  desc.indices = indices.data();
  EXPECT_EQ(scene.add(desc), 0u) << engine.error();
}

TEST(Scene, OutOfMemoryAtAnyBlockChangesNothing) {
  Engine engine;
  const FloorAndLamp room;
  std::vector<float> uvs(16, 0);
  radvor_mesh_desc desc = room.desc();
  desc.uvs = uvs.data();
  desc.normals = desc.colors = room.positions.data();
  desc.triangle_materials = nullptr;
  int refusals = 0;
  const auto retry = [&](const char* what, const std::function<radvor_result()>& call) {
    radvor_result result = RADVOR_ERROR_OUT_OF_MEMORY;
    for (std::uint64_t n = 1; result != RADVOR_OK; ++n) {
      const std::size_t blocks = engine.live_blocks();
      engine.refuse_from(n);
      result = call();
      engine.refuse_from(0);
      if (result != RADVOR_OK) {
        ASSERT_EQ(result, RADVOR_ERROR_OUT_OF_MEMORY) << what << " at block " << n << ": " << engine.error();
        EXPECT_EQ(engine.live_blocks(), blocks) << what << " at block " << n;
        ++refusals;
      }
      ASSERT_LT(n, 1000u) << what;
    }
  };
  radvor_scene* scene = nullptr;
  retry("create", [&] { return radvor_scene_create(engine.context(), &scene); });
  const radvor_material_desc material = gray(0.5f);
  radvor_light_desc light{};
  light.struct_size = sizeof light;
  for (std::uint32_t i = 0; i < 5; ++i) {
    std::uint32_t id = RADVOR_NONE;
    retry("material", [&] { return radvor_scene_add_material(scene, &material, &id); });
    EXPECT_EQ(id, i);
    retry("mesh", [&] { return radvor_scene_add_mesh(scene, &desc, &id); });
    EXPECT_EQ(id, i);
    retry("light", [&] { return radvor_scene_add_light(scene, &light, &id); });
    EXPECT_EQ(id, i);
    const double on_floor[3] = {0.5, 0, 0.5};
    retry("sites", [&] { return radvor_scene_add_sites(scene, i, on_floor, 1); });
  }
  EXPECT_GT(refusals, 30);
  radvor_scene_destroy(scene);
}

}  // namespace
}  // namespace radvor::test
