// The programs from the outside: what they write, say, and exit with.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "samples/temporary_folder.h"
#include "structure/command.h"

namespace bake {
namespace {

using test::TemporaryFolder;

struct Outcome {
  int code;  ///< of exit, or -1
  std::string output;
};

Outcome run(const std::string& command) {
  const radvor::test::CommandResult result = radvor::test::run_command(command);
  return {WIFEXITED(result.status) ? WEXITSTATUS(result.status) : -1, result.output};
}

Outcome bake_program(const std::string& arguments) {
  return run(RADVOR_BAKE_PROGRAM " " + arguments);
}

/// A closed room of 2 x 2 x 2 whose ceiling shines: bakes at once.
const char* const k_room_obj =
    "mtllib room.mtl\n"
    "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\nv 0 0 2\nv 2 0 2\nv 0 2 2\nv 2 2 2\n"
    "g walls\nusemtl white\nf 1 5 6 2\nf 1 2 4 3\nf 5 7 8 6\nf 1 3 7 5\nf 2 6 8 4\n"
    "g ceiling\nusemtl lamp\nf 3 4 8 7\n";
const char* const k_room_mtl = "newmtl white\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n";

class Program : public ::testing::Test {
 protected:
  Program() : scene(folder.write("room.obj", k_room_obj)) { folder.write("room.mtl", k_room_mtl); }
  std::string out(const std::string& name) const { return folder.path(name); }

  TemporaryFolder folder;
  const std::string scene;
  /// Coarse: the tests are about the program.
  const std::string quick = " --tolerance 0.2 --patch-spacing 0.5 --min-spacing 0.25 ";
};

TEST_F(Program, HelpAndVersion) {
  const Outcome help = bake_program("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* option :
       {"-o,",           "--tolerance",   "--threads",   "--lattice",        "--patch-spacing", "--min-spacing",
        "--max-bounces", "--max-seconds", "--max-sites", "--element-levels", "--weld-distance", "--crease-angle",
        "--seed",        "--disable",     "--light ",    "--lights",         "--points ",       "--points-out",
        "--quantity",    "--stats",       "--preview",   "--wireframe",      "--camera",        "--quiet",
        "--embree",      "--version",     "Exit codes"}) {
    EXPECT_NE(help.output.find(option), std::string::npos) << option;
  }
  const Outcome version = bake_program("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.output.find("radvor 0."), 0u) << version.output;
}

TEST_F(Program, WrongCommandLinesExitWith2) {
  for (const std::string& arguments : {
           std::string(),
           scene + " --nonsense",
           scene + " --lattice round",
           scene + " --disable facing,magic",
           scene + " --quantity heat",
           scene + " --tolerance much",
           scene + " --tolerance -1",
           scene + " --threads -1",
           scene + " --light 'sun 1 2 3'",
           scene + " --camera '1 2 3'",
           scene + " -o out.obj",
           scene + " --preview out.jpg",
           scene + " --points in.csv",
           scene + " --wireframe",
       }) {
    const Outcome outcome = bake_program(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.output;
    EXPECT_EQ(outcome.output.find("radvor-bake: "), 0u) << outcome.output;
  }
}

TEST_F(Program, WrongInputExitsWith3AndNamesThePlace) {
  const std::string bad = folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  const Outcome outcome = bake_program(bad);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.output.find(bad + ":2: "), std::string::npos) << outcome.output;
  EXPECT_EQ(bake_program("/nowhere.obj").code, 3);
  EXPECT_EQ(bake_program(scene + " --lights /nowhere.txt").code, 3);
  EXPECT_EQ(bake_program(scene + " --points /nowhere.csv --points-out " + out("o.csv")).code, 3);
}

TEST_F(Program, UnwritableOutputExitsWith5BeforeTheBake) {
  for (const char* option : {"-o /nowhere/out.glb", "--stats /nowhere/out.json", "--preview /nowhere/out.png"}) {
    const Outcome outcome = bake_program(scene + " " + option);
    EXPECT_EQ(outcome.code, 5) << outcome.output;
    EXPECT_EQ(outcome.output.find("converged"), std::string::npos) << outcome.output;
  }
}

TEST_F(Program, AFailingBakeExitsWith4) {
  const Outcome outcome = bake_program(scene + quick + "--embree /nowhere/libembree.so");
  EXPECT_EQ(outcome.code, 4) << outcome.output;
  EXPECT_NE(outcome.output.find("/nowhere/libembree.so"), std::string::npos) << outcome.output;
}

TEST_F(Program, WritesAllThatIsAskedFor) {
  const std::string points = folder.write("in.csv", "x,y,z,nx,ny,nz,r\n1,0,1,0,1,0,9\n0,1,1,1,0,0,9\n1,1,1,0,1,0,9\n");
  const Outcome outcome =
      bake_program(scene + quick + "-o " + out("o.glb") + " --points " + points + " --points-out " + out("o.csv") +
                   " --stats " + out("o.json") + " --preview " + out("o.png") + " --wireframe --threads 1 --seed 7");
  ASSERT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("converged in"), std::string::npos) << outcome.output;
  EXPECT_EQ(folder.read("o.glb").substr(0, 4), "glTF");
  EXPECT_EQ(folder.read("o.png").substr(1, 3), "PNG");
  const nlohmann::json stats = nlohmann::json::parse(folder.read("o.json"));
  EXPECT_EQ(stats.at("result"), "converged");
  EXPECT_EQ(stats.at("options").at("seed"), 7);
  EXPECT_EQ(stats.at("input_triangles"), 12);
  EXPECT_GE(stats.at("facets"), 6);
  EXPECT_GT(stats.at("rays"), 0);

  // The floor's middle sees the ceiling under F = 0.2395 (unit sphere analogy: 4 corner factors), lit further by walls
  // of albedo 0.5; a point in the open air has no surface.
  std::istringstream lines(folder.read("o.csv"));
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) {
    rows.push_back(line);
  }
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], "r,g,b,found");
  EXPECT_EQ(rows[1].back(), '1') << rows[1];
  EXPECT_EQ(rows[2].back(), '1') << rows[2];
  EXPECT_EQ(rows[3], "0,0,0,0");
  const double floor = std::stod(rows[1]);
  EXPECT_GT(floor, 0.2395 * M_PI);
  EXPECT_LT(floor, M_PI);
}

TEST_F(Program, LightsAndQuantities) {
  const std::string points = folder.write("in.csv", "x,y,z,nx,ny,nz\n1,0,1,0,1,0\n");
  const std::string lights = folder.write("lights.txt", "# one\npoint 1 1 1 1 2 3\n");
  double direct_and_indirect = 0, irradiance = 0;
  for (const char* quantity : {"irradiance", "direct", "indirect"}) {
    const Outcome outcome =
        bake_program(scene + quick + "--quiet --lights " + lights + " --light 'point 1 1 1 1 2 3' --points " + points +
                     " --points-out " + out("o.csv") + " --quantity " + quantity);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(outcome.output, "");
    const double red = std::stod(folder.read("o.csv").substr(std::string("r,g,b,found\n").size()));
    (quantity == std::string("irradiance") ? irradiance : direct_and_indirect) += red;
    if (quantity == std::string("direct")) {
      EXPECT_NEAR(red, 2 + 0.2395 * M_PI, 0.2);  // two lamps of 1 W/sr at 1 m, and the ceiling
    }
  }
  EXPECT_NEAR(irradiance, direct_and_indirect, 1e-4 * irradiance);
}

TEST_F(Program, InterruptedItWritesWhatThereIs) {
  // A tolerance that takes long; the signal comes after a moment. In the foreground timeout sends it once: otherwise to
  // the whole group as well, and the second kills.
  const Outcome outcome =
      run("timeout --foreground --signal=INT --preserve-status 2 " RADVOR_BAKE_PROGRAM " " + scene +
          " --tolerance 1e-6 --patch-spacing 0.02 --element-levels 1 --stats " + out("o.json") + " -o " + out("o.ply"));
  ASSERT_EQ(outcome.code, 128 + SIGINT) << outcome.output;
  EXPECT_EQ(nlohmann::json::parse(folder.read("o.json")).at("result"), "cancelled");
  EXPECT_EQ(folder.read("o.ply").substr(0, 3), "ply");
}

TEST_F(Program, TimeSpentIsNoFailure) {
  const Outcome outcome = bake_program(scene + " --tolerance 1e-6 --patch-spacing 0.02 --min-spacing 0.002" +
                                       " --max-seconds 0.3 --stats " + out("o.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_EQ(nlohmann::json::parse(folder.read("o.json")).at("result"), "time spent");
}

TEST(Hello, PrintsTheLightAtTheEightCorners) {
  const Outcome outcome = run(RADVOR_HELLO_PROGRAM);
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = outcome.output.find("irradiance ", at)) != std::string::npos; ++at) {
    EXPECT_GT(std::stod(outcome.output.substr(at + 11)), 0) << outcome.output;
    ++lines;
  }
  EXPECT_EQ(lines, 8u);
}

}  // namespace
}  // namespace bake
