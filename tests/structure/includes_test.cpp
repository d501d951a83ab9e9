// The arrows of the architecture: which folder may include which, read from the #include lines themselves.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path k_root = RADVOR_SOURCE_DIR;

// src/ folder -> what it may include besides itself; CONTRIBUTING.md has the same table with the ideas.
const std::map<std::string, std::set<std::string>> k_arrows = {
    {"base", {}},
    {"delaunay", {"base"}},
    {"scene", {"base"}},
    {"visibility", {"base", "scene"}},
    {"surface", {"base", "scene", "delaunay"}},
    {"radiosity", {"base", "delaunay", "scene", "visibility", "surface"}},
    {"output", {"base", "delaunay", "scene", "surface", "radiosity"}},
    {"api", {"base", "delaunay", "scene", "visibility", "surface", "radiosity", "output"}},
};

// Folders that see radvor as an engine does.
const std::vector<std::string> k_public_only = {"bindings", "samples", "fuzz", "bench", "tests/api"};

std::vector<std::string> includes_of(std::istream& text) {
  static const std::regex k_line(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> found;
  for (std::string line; std::getline(text, line);) {
    std::smatch match;
    if (std::regex_search(line, match, k_line)) {
      found.push_back(match[1]);
    }
  }
  return found;
}

std::vector<fs::path> sources_under(const fs::path& folder) {
  static const std::set<std::string> k_extensions = {".h", ".hpp", ".c", ".cpp", ".inl", ".cc"};
  std::vector<fs::path> found;
  if (fs::exists(folder)) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file() && k_extensions.contains(entry.path().extension().string())) {
        found.push_back(entry.path());
      }
    }
  }
  return found;
}

std::vector<std::string> includes_of(const fs::path& file) {
  std::ifstream text(file);
  return includes_of(text);
}

std::string first_folder(const std::string& include) {
  const auto slash = include.find('/');
  return slash == std::string::npos ? std::string() : include.substr(0, slash);
}

// Why a file of src/<folder> may not include this; empty where it may.
std::string objection(const std::string& folder, const std::string& include) {
  if (include == "radvor.h" && folder != "api") {
    return "only src/api reads the caller's structs";
  }
  if (include.starts_with("embree") && folder != "visibility") {
    return "only src/visibility knows Embree";
  }
  const std::string other = first_folder(include);
  if (k_arrows.contains(other) && other != folder && !k_arrows.at(folder).contains(other)) {
    return folder + " may not include " + other;
  }
  return {};
}

TEST(Architecture, ObjectionsAreRaisedWhereTheyShould) {
  EXPECT_FALSE(objection("base", "scene/scene.h").empty());
  EXPECT_FALSE(objection("output", "visibility/visibility.h").empty());
  EXPECT_FALSE(objection("surface", "radiosity/bake.h").empty());
  EXPECT_FALSE(objection("scene", "radvor.h").empty());
  EXPECT_FALSE(objection("radiosity", "embree3/rtcore.h").empty());
  EXPECT_TRUE(objection("surface", "delaunay/cells.h").empty());
  EXPECT_TRUE(objection("base", "tbb/parallel_for.h").empty());
  std::istringstream text("#include <vector>\n  # include \"base/log.h\"\n// #include \"scene/x.h\"\n");
  EXPECT_EQ(includes_of(text), (std::vector<std::string>{"vector", "base/log.h"}));
}

TEST(Architecture, FoldersIncludeAlongTheArrows) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(k_root / "src")) {
    if (!entry.is_directory()) {
      continue;
    }
    const std::string folder = entry.path().filename().string();
    ASSERT_TRUE(k_arrows.contains(folder)) << "src/" << folder << " is not in the table of the architecture";
    for (const fs::path& file : sources_under(entry.path())) {
      ++files;
      for (const std::string& include : includes_of(file)) {
        EXPECT_EQ(objection(folder, include), "") << file << " includes " << include;
      }
    }
  }
  EXPECT_GT(files, 10u);
}

TEST(Architecture, AtMostOneFileIncludesEmbree) {
  std::vector<std::string> found;
  for (const fs::path& file : sources_under(k_root / "src")) {
    for (const std::string& include : includes_of(file)) {
      if (include.starts_with("embree")) {
        found.push_back(file.string());
        break;
      }
    }
  }
  EXPECT_LE(found.size(), 1u) << testing::PrintToString(found);
}

TEST(Architecture, WhoStandsOutsideUsesThePublicHeaderAlone) {
  for (const std::string& folder : k_public_only) {
    for (const fs::path& file : sources_under(k_root / folder)) {
      for (const std::string& include : includes_of(file)) {
        EXPECT_FALSE(fs::exists(k_root / "src" / include) || include.find("src/") != std::string::npos)
            << file << " includes " << include;
      }
    }
  }
}

TEST(Architecture, ThePublicHeaderShowsNoDependency) {
  const std::set<std::string> allowed = {"stddef.h", "stdint.h"};
  for (const std::string& include : includes_of(k_root / "include" / "radvor.h")) {
    EXPECT_TRUE(allowed.contains(include)) << include;
  }
}

}  // namespace
