// The files a bake is written to, read back without the libraries that wrote them.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "gltf_file.h"
#include "ply_file.h"
#include "samples/temporary_folder.h"
#include "samples/tiny_bake.h"
#include "stats_file.h"

namespace bake {
namespace {

using Json = nlohmann::json;
using test::TemporaryFolder;
using test::TinyBake;

template <class Value>
Value value_at(const std::string& bytes, std::size_t offset) {
  Value value;
  EXPECT_LE(offset + sizeof value, bytes.size());
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// A .glb taken apart after section 4 of the glTF 2.0 specification.
struct Glb {
  Json json;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(value_at<std::uint32_t>(bytes, 4), 2u);
    EXPECT_EQ(value_at<std::uint32_t>(bytes, 8), bytes.size());
    const auto json_size = value_at<std::uint32_t>(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(json_size % 4, 0u);
    json = Json::parse(bytes.substr(20, json_size));
    const auto binary_size = value_at<std::uint32_t>(bytes, 20 + json_size);
    EXPECT_EQ(bytes.substr(24 + json_size, 4), std::string("BIN\0", 4));
    EXPECT_EQ(28 + json_size + binary_size, bytes.size());
    binary = bytes.substr(28 + json_size);
  }

  template <class Value>
  std::vector<Value> values(std::size_t accessor_id, std::size_t components) const {
    const Json& accessor = json.at("accessors").at(accessor_id);
    const Json& view = json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::size_t count = accessor.at("count").get<std::size_t>() * components;
    const std::size_t offset = accessor.value("byteOffset", std::size_t{0});
    EXPECT_EQ(offset % sizeof(Value), 0u);
    EXPECT_LE(offset + count * sizeof(Value), view.at("byteLength").get<std::size_t>());
    std::vector<Value> read;
    for (std::size_t i = 0; i < count; ++i) {
      read.push_back(value_at<Value>(binary, view.value("byteOffset", std::size_t{0}) + offset + i * sizeof(Value)));
    }
    return read;
  }
};

TEST(Glb, MeshesMaterialsAndLight) {
  const TinyBake bake;
  const TemporaryFolder folder;
  save_glb(folder.path("out.glb"), bake.scene, bake.meshes());
  const Glb glb(folder.read("out.glb"));

  EXPECT_EQ(glb.json.at("asset").at("version"), "2.0");
  EXPECT_EQ(glb.json.at("extensionsUsed"), (Json{"KHR_materials_unlit", "KHR_materials_emissive_strength"}));
  const Json& materials = glb.json.at("materials");
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0].at("pbrMetallicRoughness").at("baseColorFactor"), (Json{0.5, 0.5, 0.5, 1.0}));
  EXPECT_TRUE(materials[0].at("extensions").at("KHR_materials_unlit").is_object());
  EXPECT_EQ(materials[1].at("emissiveFactor"), (Json{1.0, 0.5, 0.25}));
  EXPECT_EQ(materials[1].at("extensions").at("KHR_materials_emissive_strength").at("emissiveStrength"), 8.0);

  ASSERT_EQ(glb.json.at("meshes").size(), 2u);
  ASSERT_EQ(glb.json.at("nodes").size(), 2u);
  EXPECT_EQ(glb.json.at("scenes").at(0).at("nodes"), (Json{0, 1}));
  const Json& square = glb.json.at("meshes").at(0);
  EXPECT_EQ(square.at("name"), "square");
  ASSERT_EQ(square.at("primitives").size(), 2u);  // one a material
  const Json& primitive = square.at("primitives").at(0);
  const Json& attributes = primitive.at("attributes");
  EXPECT_EQ(glb.values<float>(attributes.at("POSITION"), 3), (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  const Json& positions = glb.json.at("accessors").at(attributes.at("POSITION").get<std::size_t>());
  EXPECT_EQ(positions.at("min"), (Json{0.0, 0.0, 0.0}));
  EXPECT_EQ(positions.at("max"), (Json{1.0, 1.0, 0.0}));
  EXPECT_EQ(glb.values<float>(attributes.at("NORMAL"), 3), (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(glb.values<float>(attributes.at("TEXCOORD_0"), 2), (std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}));
  EXPECT_EQ(glb.values<float>(attributes.at("_RADVOR_IRRADIANCE"), 3),
            (std::vector<float>{1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}));
  EXPECT_EQ(primitive.at("material"), 0);
  EXPECT_EQ(glb.values<std::uint32_t>(primitive.at("indices"), 1), (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(glb.values<std::uint32_t>(square.at("primitives").at(1).at("indices"), 1),
            (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_FALSE(glb.json.at("meshes").at(1).at("primitives").at(0).at("attributes").contains("TEXCOORD_0"));
}

TEST(Glb, ColorsAreIrradianceOverPiTimesOneScaleForTheFile) {
  const TinyBake bake;
  const TemporaryFolder folder;
  save_glb(folder.path("out.glb"), bake.scene, bake.meshes());
  const Glb glb(folder.read("out.glb"));
  const double scale = glb.json.at("scenes").at(0).at("extras").at("radvor_color_scale");
  EXPECT_NEAR(scale, std::numbers::pi / 10, 1e-6);  // the brightest irradiance is 10
  float brightest = 0;
  for (const Json& mesh : glb.json.at("meshes")) {
    EXPECT_EQ(mesh.at("extras").at("radvor_color_scale"), scale);
    const Json& attributes = mesh.at("primitives").at(0).at("attributes");
    const auto colors = glb.values<float>(attributes.at("COLOR_0"), 3);
    const auto irradiance = glb.values<float>(attributes.at("_RADVOR_IRRADIANCE"), 3);
    for (std::size_t i = 0; i < colors.size(); ++i) {
      EXPECT_NEAR(colors[i], irradiance[i] / std::numbers::pi * scale, 1e-6);
      brightest = std::max(brightest, colors[i]);
    }
  }
  EXPECT_NEAR(brightest, 1.0f, 1e-6f);
  EXPECT_LE(brightest, 1.0f);
}

TEST(Glb, ViewsOfVertexDataHaveStridesAndLieInTheBuffer) {
  const TinyBake bake;
  const TemporaryFolder folder;
  save_glb(folder.path("out.glb"), bake.scene, bake.meshes());
  const Glb glb(folder.read("out.glb"));
  std::size_t end = 0;
  for (const Json& view : glb.json.at("bufferViews")) {
    EXPECT_EQ(view.value("byteOffset", std::size_t{0}), end);
    end += view.at("byteLength").get<std::size_t>();
    EXPECT_EQ(view.contains("byteStride"), view.at("target") == 34962);  // ARRAY_BUFFER
  }
  EXPECT_EQ(glb.json.at("buffers").at(0).at("byteLength"), end);
  EXPECT_LE(end, glb.binary.size());
}

TEST(Glb, DarkAndEmptyScenes) {
  TinyBake bake;
  std::vector<BakedMesh> meshes = bake.meshes();
  const std::vector<float> dark(12, 0.0f);
  meshes[0].mesh.irradiance = dark.data();
  meshes[1].mesh.triangle_count = 0;
  const TemporaryFolder folder;
  save_glb(folder.path("out.glb"), bake.scene, meshes);
  const Glb glb(folder.read("out.glb"));
  EXPECT_EQ(glb.json.at("meshes").size(), 1u);
  EXPECT_EQ(glb.json.at("scenes").at(0).at("extras").at("radvor_color_scale"), 1.0);
}

TEST(Ply, ColumnsAndFaces) {
  const TinyBake bake;
  const TemporaryFolder folder;
  save_ply(folder.path("out.ply"), bake.meshes());
  const std::string bytes = folder.read("out.ply");
  const std::string end = "end_header\n";
  const std::size_t data = bytes.find(end) + end.size();
  const std::string header = bytes.substr(0, data);
  EXPECT_NE(header.find("element vertex 7\n"), std::string::npos) << header;
  EXPECT_NE(header.find("element face 3\n"), std::string::npos) << header;
  ASSERT_EQ(bytes.size(), data + 7 * 12 * 4 + 3 * (1 + 5 * 4));
  EXPECT_EQ(value_at<float>(bytes, data + 4 * (12 * 1 + 0)), 1.0f);  // x of the second vertex
  EXPECT_EQ(value_at<float>(bytes, data + 4 * (12 * 1 + 6)), 2.0f);  // its irradiance
  EXPECT_EQ(value_at<float>(bytes, data + 4 * (12 * 1 + 9)), 4.0f);  // its radiance
  const std::size_t last = data + 7 * 48 + 2 * 21;
  EXPECT_EQ(value_at<std::uint8_t>(bytes, last), 3);
  EXPECT_EQ(value_at<std::uint32_t>(bytes, last + 1), 4u);   // the second mesh's vertices follow the first's
  EXPECT_EQ(value_at<std::uint32_t>(bytes, last + 13), 1u);  // material
  EXPECT_EQ(value_at<std::uint32_t>(bytes, last + 17), 1u);  // mesh
}

TEST(Stats, EveryFieldAndTheOptions) {
  const TinyBake bake;
  bake::Run run;
  run.result = RADVOR_TIME_SPENT;
  run.stats.rays = 5000000000;
  run.stats.escaped_power = 1.5;
  Options options;
  options.scene = "sc\xE4ne.obj";
  options.bake.tolerance = 0.25f;
  options.bake.disable = RADVOR_DISABLE_LAZY | RADVOR_DISABLE_INDIRECT;
  options.bake.lattice = RADVOR_LATTICE_QUADRILATERAL;
  const Json json = Json::parse(stats_json(run, options, bake.scene));
  EXPECT_EQ(json.at("rays"), 5000000000);
  EXPECT_EQ(json.at("escaped_power"), 1.5);
  EXPECT_EQ(json.at("result"), "time spent");
  EXPECT_EQ(json.at("options").at("tolerance"), 0.25);
  EXPECT_EQ(json.at("options").at("disable"), (Json{"lazy", "indirect"}));
  EXPECT_EQ(json.at("options").at("lattice"), "quad");
  EXPECT_TRUE(json.at("options").at("patch_spacing").is_null());

  // Every field of the struct in the header is there under its name.
  std::ifstream stream(RADVOR_SOURCE_DIR "/include/radvor.h");
  const std::string header{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t begin = header.find("typedef struct radvor_stats {");
  const std::size_t end = header.find("} radvor_stats;");
  ASSERT_NE(begin, std::string::npos);
  std::size_t fields = 0;
  for (std::size_t at = begin; (at = header.find_first_of("\n", at)) < end; ++at) {
    std::string line = header.substr(at + 1, header.find('\n', at + 1) - at - 1);
    line = line.substr(0, line.find("/*"));
    for (const char* type : {"uint32_t", "uint64_t", "double"}) {
      const std::size_t found = line.find(type);
      if (line.find(';') == std::string::npos || found == std::string::npos) {
        continue;
      }
      std::string name;
      for (const char c : line.substr(found + std::strlen(type))) {
        if (c == ',' || c == ';') {
          if (name != "struct_size") {
            EXPECT_TRUE(json.contains(name)) << name;
            ++fields;
          }
          name.clear();
        } else if (c != ' ') {
          name += c;
        }
      }
    }
  }
  EXPECT_GE(fields, 28u);
}

}  // namespace
}  // namespace bake
