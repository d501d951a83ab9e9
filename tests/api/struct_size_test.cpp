// Structs that grow: every size that some version of the header could give, and those that none could.
#include <gtest/gtest.h>
#include <radvor.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "api/engine.h"
#include "api/room.h"

namespace radvor::test {
namespace {

// A struct of the caller's with room behind it, as a newer header would have.
template <class Struct>
struct Grown {
  Struct known{};
  unsigned char unknown[64] = {};
};

class StructSize : public testing::Test {
 protected:
  radvor_result add_material(const radvor_material_desc* desc) {
    std::uint32_t id = RADVOR_NONE;
    return radvor_scene_add_material(scene_, desc, &id);
  }

  Engine engine_;
  SceneOf scene_{engine_};
};

TEST_F(StructSize, StrayNumbersAreRefused) {
  Grown<radvor_material_desc> grown{gray(0.5f), {}};
  for (const std::uint32_t size : {0u, 1u, 2u, 3u, 5u, 7u, 43u, 45u, 1025u, 65536u, UINT32_MAX, UINT32_MAX - 3}) {
    grown.known.struct_size = size;
    EXPECT_EQ(add_material(&grown.known), RADVOR_ERROR_INVALID_ARGUMENT) << size;
    EXPECT_NE(engine_.error().find("struct_size is " + std::to_string(size)), std::string::npos) << engine_.error();
  }
}

TEST_F(StructSize, SizesThatCutAPointerAreRefused) {
  const FloorAndLamp room;
  radvor_mesh_desc desc = room.desc();
  std::uint32_t id = RADVOR_NONE;
  for (const std::size_t size :
       {offsetof(radvor_mesh_desc, positions) + 4, offsetof(radvor_mesh_desc, transform) + 4}) {
    desc.struct_size = static_cast<std::uint32_t>(size);
    EXPECT_EQ(radvor_scene_add_mesh(scene_, &desc, &id), RADVOR_ERROR_INVALID_ARGUMENT) << size;
  }
}

TEST_F(StructSize, SmallerOnesLeaveTheRestAtItsDefault) {
  radvor_material_desc desc = gray(0.5f);
  desc.transmission[0] = 7;  // beyond the size given: not read
  desc.struct_size = offsetof(radvor_material_desc, transmission);
  EXPECT_EQ(add_material(&desc), RADVOR_OK) << engine_.error();
  desc.albedo[2] = -1;
  desc.struct_size = sizeof desc.struct_size;
  EXPECT_EQ(add_material(&desc), RADVOR_OK) << engine_.error();

  const FloorAndLamp room;
  radvor_mesh_desc mesh = room.desc();
  const double nonsense[12] = {NAN};
  mesh.transform = nonsense;
  mesh.struct_size = offsetof(radvor_mesh_desc, transform);
  std::uint32_t id = RADVOR_NONE;
  EXPECT_EQ(radvor_scene_add_mesh(scene_, &mesh, &id), RADVOR_OK) << engine_.error();
}

TEST_F(StructSize, LargerOnesPassWhereTheUnknownBytesAreZero) {
  Grown<radvor_material_desc> grown{gray(0.5f), {}};
  grown.known.struct_size = sizeof grown;
  EXPECT_EQ(add_material(&grown.known), RADVOR_OK) << engine_.error();
  grown.unknown[63] = 1;
  EXPECT_EQ(add_material(&grown.known), RADVOR_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(engine_.error().find("byte " + std::to_string(sizeof grown - 1)), std::string::npos) << engine_.error();
}

TEST(ContextStructSize, IsCheckedToo) {
  Grown<radvor_context_desc> grown;
  radvor_context* context = nullptr;
  for (const std::size_t size : {sizeof grown, sizeof grown.known, offsetof(radvor_context_desc, embree_path),
                                 offsetof(radvor_context_desc, parallel_for), sizeof(std::uint32_t)}) {
    grown.known.struct_size = static_cast<std::uint32_t>(size);
    EXPECT_EQ(radvor_context_create(&grown.known, &context), RADVOR_OK) << size;
    radvor_context_destroy(context);
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, sizeof grown.known - 1, sizeof grown.known - 4}) {
    grown.known.struct_size = static_cast<std::uint32_t>(size);
    EXPECT_EQ(radvor_context_create(&grown.known, &context), RADVOR_ERROR_INVALID_ARGUMENT) << size;
    EXPECT_EQ(context, nullptr);
  }
  grown.known.struct_size = sizeof grown;
  grown.unknown[0] = 1;
  EXPECT_EQ(radvor_context_create(&grown.known, &context), RADVOR_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace radvor::test
