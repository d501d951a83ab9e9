// The floating-point environment of the caller: of no influence on what comes out, and given back untouched.
#include <gtest/gtest.h>
#include <radvor.h>

#include <cfenv>
#include <string>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "api/engine.h"
#include "api/light_of.h"
#include "api/room.h"

namespace radvor::test {
namespace {

// Everything a caller can set; on x86 with MXCSR's flush-to-zero bits.
struct Environment {
  int rounding = FE_TONEAREST;
  unsigned control = 0;

  static Environment current() {
    Environment now;
    now.rounding = std::fegetround();
#if defined(__SSE2__)
    now.control = _mm_getcsr();
#endif
    return now;
  }

  bool operator==(const Environment&) const = default;
};

// Each call alone under the caller's environment, compared at once.
template <class Call>
auto watched(const Environment& wanted, Call&& call) {
  std::fesetround(wanted.rounding);
#if defined(__SSE2__)
  _mm_setcsr((_mm_getcsr() & ~0x8040u & ~0x3fu) | wanted.control);
#endif
  const Environment before = Environment::current();
  const auto result = call();
  const Environment after = Environment::current();
  std::fesetround(FE_TONEAREST);
#if defined(__SSE2__)
  _mm_setcsr(0x1f80);
#endif
  EXPECT_TRUE(before == after) << "rounding " << after.rounding << ", control " << after.control << ", was "
                               << before.rounding << ", " << before.control;
  return result;
}

LightOf bake_under(const Environment& environment) {
  const Engine engine;
  const FloorAndLamp room;
  const radvor_mesh_desc mesh = room.desc();
  const radvor_material_desc materials[] = {gray(0.5f), gray(0.5f, 4)};
  const radvor_bake_options options = coarse();
  radvor_light_desc light{};
  light.struct_size = sizeof light;
  light.type = RADVOR_LIGHT_DIRECTIONAL;
  light.direction[0] = 1;
  light.direction[1] = -3;
  light.color[0] = 1.0f / 3;
  radvor_context* context = nullptr;
  radvor_scene* scene = nullptr;
  radvor_solution* solution = nullptr;
  std::uint32_t id = RADVOR_NONE;
  const auto ok = [&](auto&& call) {
    EXPECT_EQ(watched(environment, call), RADVOR_OK) << radvor_context_error(context);
  };
  ok([&] { return radvor_context_create(&engine.desc(), &context); });
  ok([&] { return radvor_scene_create(context, &scene); });
  ok([&] { return radvor_scene_add_material(scene, &materials[0], &id); });
  ok([&] { return radvor_scene_add_material(scene, &materials[1], &id); });
  ok([&] { return radvor_scene_add_mesh(scene, &mesh, &id); });
  ok([&] { return radvor_scene_add_light(scene, &light, &id); });
  EXPECT_EQ(watched(environment, [&] { return radvor_scene_add_mesh(scene, nullptr, &id); }),
            RADVOR_ERROR_INVALID_ARGUMENT);
  ok([&] { return radvor_bake(scene, &options, &solution); });
  std::vector<float> rgb(24);
  radvor_output_mesh output{};
  output.struct_size = sizeof output;
  const double position[] = {0.5, 0, 0.5};
  const float normal[] = {0, 1, 0};
  ok([&] { return radvor_solution_points(solution, 0, 1, position, normal, 0.1, rgb.data(), nullptr); });
  ok([&] { return radvor_solution_mesh(solution, 0, &output); });
  ok([&] { return radvor_solution_vertices(solution, 0, 0, 0, rgb.data(), 0, 8); });
  LightOf seen = read_light(solution, 8);
  seen.vertices.push_back(rgb);  // made under the caller's environment, as the mesh was
  const auto destroyed = [&](auto&& destroy) {
    watched(environment, [&] {
      destroy();
      return 0;
    });
  };
  destroyed([&] { radvor_solution_destroy(solution); });
  destroyed([&] { radvor_scene_destroy(scene); });
  destroyed([&] { radvor_context_destroy(context); });
  return seen;
}

TEST(FloatingPoint, TheCallersEnvironmentNeitherMattersNorChanges) {
  const LightOf expected = bake_under({});
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    EXPECT_TRUE(bake_under({rounding, 0}) == expected) << "rounding " << rounding;
  }
#if defined(__SSE2__)
  EXPECT_TRUE(bake_under({FE_TONEAREST, 0x8040}) == expected) << "denormals flushed";
#endif
}

}  // namespace
}  // namespace radvor::test
