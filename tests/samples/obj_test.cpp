// OBJ and MTL files as people have them.
#include <gtest/gtest.h>

#include "failure.h"
#include "obj_file.h"
#include "samples/temporary_folder.h"

namespace bake {
namespace {

using test::TemporaryFolder;

/// Loads text as a file; the folder may hold materials.
SceneData load(const TemporaryFolder& folder, const std::string& text, Warnings& warnings) {
  return load_obj(folder.write("scene.obj", text), warnings);
}

SceneData load(const std::string& text) {
  const TemporaryFolder folder;
  Warnings warnings;
  return load(folder, text, warnings);
}

/// The words with which loading fails, without the folder.
std::string refusal(const TemporaryFolder& folder, const std::string& text) {
  Warnings warnings;
  try {
    load(folder, text, warnings);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::input);
    const std::string words = failure.what();
    EXPECT_EQ(words.find(folder.path("")), 0u) << words;
    return words.substr(folder.path("").size());
  }
  return "";
}

std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  return refusal(folder, text);
}

const std::string k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, PositiveAndNegativeIndices) {
  const SceneData positive = load(k_square + "f 1 2 3\n");
  const SceneData negative = load(k_square + "f -4 -3 -2\nv 9 9 9\n");
  ASSERT_EQ(positive.meshes.size(), 1u);
  EXPECT_EQ(positive.meshes[0].positions, negative.meshes[0].positions);
  EXPECT_EQ(positive.meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(negative.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Obj, CarriageReturnsContinuedLinesCommentsAndByteOrderMark) {
  const SceneData scene = load(
      "\xEF\xBB\xBF# made by hand\r\nv 0 0 0 # a corner\r\nv 1 0\\\r\n 0\r\n\tv  1 1 0\r\n"
      "f 1 2 3 # the face\r\n");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(load("v 0 0 0\rv 1 0 0\rv 1 1 0\rf 1 2 3").triangle_count(), 1u);
}

TEST(Obj, VerticesAreOneForEachPositionNormalAndUv) {
  const SceneData scene = load(k_square +
                               "vn 0 0 1\nvn 0 1 0\nvt 0 0\nvt 1 1\n"
                               "f 1/1/1 2/1/1 3/1/1\nf 1/1/1 3/1/1 4/2/1\nf 1/1/2 2/1/2 3/2/2\n");
  ASSERT_EQ(scene.meshes.size(), 1u);
  const MeshData& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6}));
  EXPECT_EQ(mesh.positions.size(), 7u);
  EXPECT_EQ(mesh.normals.size(), 7u);
  EXPECT_EQ(mesh.normals[6], glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh.uvs[3], glm::vec2(1, 1));
}

TEST(Obj, FacesWithAndWithoutNormalsAreMeshesApart) {
  const SceneData scene = load(k_square + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\nf 1//1 2//1 4\n");
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].normals.size(), 3u);
  EXPECT_TRUE(scene.meshes[1].normals.empty());
  EXPECT_EQ(scene.meshes[1].triangle_materials.size(), 2u);
}

TEST(Obj, ObjectsAndGroupsAreMeshes) {
  const SceneData scene = load(k_square +
                               "f 1 2 3\no box\nf 1 2 3\ng lid left\nf 1 2 3\ng side\nf 1 2 3\ng lid left\nf 1 3 4\n"
                               "g\nf 1 2 4\n");
  std::vector<std::string> names;
  std::vector<std::size_t> counts;
  for (const MeshData& mesh : scene.meshes) {
    names.push_back(mesh.name);
    counts.push_back(mesh.triangle_materials.size());
  }
  EXPECT_EQ(names, (std::vector<std::string>{"", "box", "box/lid left", "box/side"}));
  EXPECT_EQ(counts, (std::vector<std::size_t>{1, 2, 2, 1}));
}

TEST(Obj, ManyGroups) {
  std::string text = k_square;
  for (int i = 0; i < 5000; ++i) {
    text += "g part" + std::to_string(i) + "\nf 1 2 3 4\n";
  }
  const SceneData scene = load(text);
  EXPECT_EQ(scene.meshes.size(), 5000u);
  EXPECT_EQ(scene.triangle_count(), 10000u);
  EXPECT_EQ(scene.meshes[4999].positions.size(), 4u);
}

TEST(Obj, PolygonsAndRepeatedCorners) {
  const TemporaryFolder folder;
  Warnings warnings;
  const SceneData scene = load(folder,
                               "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n"
                               "f 1 2 3 4 5 6\nf 1 1 2 3\nf 1 2 1\nf 1 2\n",
                               warnings);
  EXPECT_EQ(scene.triangle_count(), 5u);
  EXPECT_EQ(warnings.count(), 3u);  // two faces left out, and no material
  EXPECT_NE(warnings.words()[1].find("scene.obj:9: a face"), std::string::npos) << warnings.words()[1];
}

TEST(Obj, VertexColors) {
  const SceneData scene = load("v 0 0 0 1\nv 1 0 0 0.25 0.5 0.75\nv 1 1 0 1 0.1 0.2 0.3\nf 1 2 3\n");
  EXPECT_EQ(scene.meshes[0].colors, (std::vector<glm::vec3>{{1, 1, 1}, {0.25f, 0.5f, 0.75f}, {0.1f, 0.2f, 0.3f}}));
  EXPECT_TRUE(load(k_square + "f 1 2 3\n").meshes[0].colors.empty());
}

TEST(Obj, Materials) {
  const TemporaryFolder folder;
  folder.write("my colours.mtl",
               "newmtl wall\nKa 1 1 1\nKd 0.1 0.2 0.3 # paint\nNs 10\n\nnewmtl lamp\r\nKd 0 0 0\r\nKe 17 12 4\r\n");
  Warnings warnings;
  const SceneData scene = load(
      folder,
      "mtllib my colours.mtl\n" + k_square + "usemtl lamp \nf 1 2 3\nusemtl wall\nf 1 3 4\nusemtl nosuch\nf 1 2 4\n",
      warnings);
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(scene.materials[0].albedo, glm::vec3(0.5f));
  ASSERT_EQ(scene.meshes.size(), 1u);
  const std::vector<std::uint32_t>& used = scene.meshes[0].triangle_materials;
  ASSERT_EQ(used.size(), 3u);
  EXPECT_EQ(scene.materials[used[0]].emission, glm::vec3(17, 12, 4));
  EXPECT_EQ(scene.materials[used[0]].albedo, glm::vec3(0));
  EXPECT_EQ(scene.materials[used[1]].albedo, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(used[2], 0u);
  ASSERT_EQ(warnings.count(), 1u);
  EXPECT_NE(warnings.words()[0].find("scene.obj:11: material \"nosuch\""), std::string::npos) << warnings.words()[0];
}

TEST(Obj, MissingMaterialFileIsAWarningAndGrey) {
  const TemporaryFolder folder;
  Warnings warnings;
  const SceneData scene = load(folder, "mtllib gone\\away.mtl\r\n" + k_square + "usemtl a\r\nf 1 2 3\r\n", warnings);
  EXPECT_EQ(scene.meshes[0].triangle_materials, std::vector<std::uint32_t>{0});
  ASSERT_EQ(warnings.count(), 2u);
  EXPECT_NE(warnings.words()[0].find("scene.obj:1: material file"), std::string::npos) << warnings.words()[0];
  EXPECT_NE(warnings.words()[0].find("gone/away.mtl"), std::string::npos) << warnings.words()[0];
}

TEST(Obj, ColoursOutOfRangeAreClampedWithAWarning) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nKd 1.5 0.5 -1\nKe -1 0 2\n");
  Warnings warnings;
  const SceneData scene = load(folder, "mtllib a.mtl\n" + k_square + "usemtl a\nf 1 2 3\n", warnings);
  EXPECT_EQ(scene.materials[1].albedo, glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(scene.materials[1].emission, glm::vec3(0, 0, 2));
  EXPECT_EQ(warnings.count(), 2u);
}

TEST(Obj, ErrorsNameFileAndLine) {
  EXPECT_EQ(refusal(k_square + "f 1 2 7\n"), "scene.obj:5: vertex index 7 is out of range: there are 4");
  EXPECT_EQ(refusal(k_square + "f 1 2 -5\n"), "scene.obj:5: vertex index -5 is out of range: there are 4 so far");
  EXPECT_EQ(refusal(k_square + "f 1 2 x\n"), "scene.obj:5: a face corner has no vertex index");
  EXPECT_EQ(refusal(k_square + "f 1//1 2//1 3//1\n"), "scene.obj:5: normal index 1 is out of range: there are 0");
  EXPECT_EQ(refusal(k_square + "f 1/2 2/2 3/2\n"), "scene.obj:5: texture vertex index 2 is out of range: there are 0");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 nan 0\n"), "scene.obj:2: v wants three finite numbers, not \"v 1 nan 0\"");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 1\n"), "scene.obj:2: v wants three finite numbers, not \"v 1 1\"");
  EXPECT_EQ(refusal("v 0 0 1e39\n"), "scene.obj:1: a number is too large: \"v 0 0 1e39\"");
  EXPECT_EQ(refusal("v 0 0 0\r\n\r\n#\r\nvn 0 one 0\r\n"),
            "scene.obj:4: vn wants three finite numbers, not \"vn 0 one 0\"");
  EXPECT_EQ(refusal(k_square), "scene.obj: no faces in it");
}

TEST(Obj, MaterialErrorsNameFileAndLine) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nKd 0.5 0.5 0.5\nKe 1 2\n");
  EXPECT_EQ(refusal(folder, "mtllib a.mtl\n" + k_square + "f 1 2 3\n"),
            "a.mtl:3: Ke wants three numbers, not \"Ke 1 2\"");
}

TEST(Obj, MissingFileAndFolder) {
  Warnings warnings;
  EXPECT_THROW(load_obj("/nowhere/scene.obj", warnings), Failure);
  const TemporaryFolder folder;
  EXPECT_THROW(load_obj(folder.path(""), warnings), Failure);
}

}  // namespace
}  // namespace bake
