// Lights in words, points and values as CSV, cameras in words.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "camera.h"
#include "failure.h"
#include "light_lines.h"
#include "output_file.h"
#include "point_files.h"
#include "samples/temporary_folder.h"

namespace bake {
namespace {

using test::TemporaryFolder;

template <class Function>
std::string refusal(ExitCode code, Function&& function) {
  try {
    function();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), code);
    return failure.what();
  }
  return "not refused";
}

TEST(LightLines, Sky) {
  const radvor_light_desc light = parse_light("sky 1 2 +3e-1");
  EXPECT_EQ(light.struct_size, sizeof light);
  EXPECT_EQ(light.type, std::uint32_t{RADVOR_LIGHT_SKY});
  EXPECT_EQ(light.color[0], 1.0f);
  EXPECT_EQ(light.color[2], 0.3f);
}

TEST(LightLines, SunAndPointWithAndWithoutSize) {
  const radvor_light_desc sun = parse_light("sun 0 -1 0.5 3 2 1 0.0093");
  EXPECT_EQ(sun.type, std::uint32_t{RADVOR_LIGHT_DIRECTIONAL});
  EXPECT_EQ(sun.direction[1], -1.0f);
  EXPECT_EQ(sun.direction[2], 0.5f);
  EXPECT_EQ(sun.color[0], 3.0f);
  EXPECT_EQ(sun.angle, 0.0093f);
  EXPECT_EQ(parse_light("sun 0 -1 0 3 2 1").angle, 0.0f);
  const radvor_light_desc point = parse_light("  point 1 2 3\t4 5 6 0.1 ");
  EXPECT_EQ(point.type, std::uint32_t{RADVOR_LIGHT_POINT});
  EXPECT_EQ(point.position[2], 3.0);
  EXPECT_EQ(point.color[0], 4.0f);
  EXPECT_EQ(point.radius, 0.1f);
}

TEST(LightLines, WhatMakesNoSenseIsRefused) {
  for (const char* words : {"", "lamp 1 1 1", "sky", "sky 1 1", "sky 1 1 1 1", "sky 1 1 x", "sky 1 1 -1", "sky 1 1 nan",
                            "sun 0 0 0 1 1 1", "sun 0 -1 0 1 1 1 10", "sun 0 -1 0 1 1 1 -1", "point 0 0 0 1 1 1 -1",
                            "point 0 0 0 1 1 1 1 1", "sky 1 1 1e39"}) {
    EXPECT_NE(refusal(ExitCode::usage, [&] { parse_light(words); }), "not refused") << words;
  }
}

TEST(LightLines, FilesHaveCommentsAndErrorsHaveLines) {
  const TemporaryFolder folder;
  const std::string good = folder.write("good.txt", "# two\r\n\r\nsky 1 1 1 # dim\r\nsun 0 -1 0 1 1 1\r\n");
  EXPECT_EQ(load_lights(good).size(), 2u);
  const std::string bad = folder.write("bad.txt", "sky 1 1 1\n\nsun 1 1 1\n");
  EXPECT_EQ(refusal(ExitCode::input, [&] { load_lights(bad); }).find(bad + ":3: light \"sun 1 1 1\""), 0u);
}

TEST(PointFiles, ColumnsByNameOthersPassedOver) {
  const TemporaryFolder folder;
  const Points points =
      load_points(folder.write("in.csv", "id,nz,x, y,z,nx,ny,r\r\n7,1,0.1,0.2,0.3,-0,0,9\r\n\r\n8,0,1,2,3,0,1,9\r\n"));
  EXPECT_EQ(points.positions, (std::vector<double>{0.1, 0.2, 0.3, 1, 2, 3}));
  EXPECT_EQ(points.normals, (std::vector<float>{0, 0, 1, 0, 1, 0}));
}

TEST(PointFiles, ErrorsNameFileAndLine) {
  const TemporaryFolder folder;
  const std::string file = folder.path("in.csv");
  const auto words = [&](const char* text) {
    folder.write("in.csv", text);
    return refusal(ExitCode::input, [&] { load_points(file); });
  };
  EXPECT_EQ(words("x,y,z\n1,2,3\n"), file + ":1: the header names no column nx (wanted: x,y,z,nx,ny,nz)");
  EXPECT_EQ(words("x,y,z,nx,ny,nz\n1,2,3,0,0,1\n1,2,3,0,0\n"), file + ":3: nz is not a finite number");
  EXPECT_EQ(words("x,y,z,nx,ny,nz\n1,inf,3,0,0,1\n"), file + ":2: y is not a finite number");
  EXPECT_EQ(words(""), file + ": no header line (wanted: x,y,z,nx,ny,nz)");
  EXPECT_EQ(load_points(folder.write("empty.csv", "x,y,z,nx,ny,nz\n")).count(), 0u);
}

TEST(PointFiles, ValuesReadBackAsTheSameFloats) {
  const TemporaryFolder folder;
  save_values(folder.path("out.csv"), {0.1f, 1.0f, 16777217.0f, 0, 0, 0}, {1, 0});
  EXPECT_EQ(folder.read("out.csv"), "r,g,b,found\n0.1,1,16777216,1\n0,0,0,0\n");
}

TEST(OutputFile, AppearsWholeOrNotAtAll) {
  const TemporaryFolder folder;
  folder.write("out.txt", "old");
  {
    OutputFile out(folder.path("out.txt"));
    out.text("half");
  }
  EXPECT_EQ(folder.read("out.txt"), "old");
  EXPECT_FALSE(std::filesystem::exists(folder.path("out.txt.part")));
  OutputFile out(folder.path("out.txt"));
  out.text("new");
  out.close();
  EXPECT_EQ(folder.read("out.txt"), "new");
  EXPECT_NE(refusal(ExitCode::output, [] { OutputFile("/nowhere/out.txt"); }), "not refused");
  EXPECT_NE(refusal(ExitCode::output, [&] { OutputFile(folder.path("")); }), "not refused");
}

TEST(OutputFile, DevicesAreWrittenStraight) {
  OutputFile out("/dev/null");
  out.text("gone");
  out.close();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(CameraWords, EyeTargetFieldOfView) {
  const Camera camera = parse_camera("1 2 3 0 0 -1 90");
  EXPECT_EQ(camera.eye, glm::dvec3(1, 2, 3));
  EXPECT_EQ(camera.target, glm::dvec3(0, 0, -1));
  EXPECT_DOUBLE_EQ(camera.field_of_view, std::numbers::pi / 2);
  for (const char* words : {"1 2 3 0 0 -1", "1 2 3 1 2 3 40", "1 2 3 0 0 0 0", "1 2 3 0 0 0 180", "a b c d e f g"}) {
    EXPECT_NE(refusal(ExitCode::usage, [&] { parse_camera(words); }), "not refused") << words;
  }
}

}  // namespace
}  // namespace bake
