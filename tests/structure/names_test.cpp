// One name, one type. Two types of one qualified name in one library are undefined behaviour that no compiler reports:
// the linker keeps one copy of each inline function made of them, and an iterator then steps by the other's size.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path k_root = RADVOR_SOURCE_DIR;

// Types defined at namespace scope, qualified; those of unnamed namespaces stay in their file and do not count. Counts
// on the layout that clang-format gives: such a definition, and the end of a namespace, start a line.
std::vector<std::string> types_of(std::istream& text) {
  static const std::regex k_opened(R"(^namespace ([\w:]+) \{)");
  static const std::regex k_closed(R"(^\}  // namespace)");
  static const std::regex k_type(
      R"(^(?:struct|class|union|enum(?: class)?) (?:alignas\([^)]*\) ?)?([\w:]+)(?: final)?(?: :[^:].*)? \{)");
  std::vector<std::string> open;
  std::vector<std::string> found;
  for (std::string line; std::getline(text, line);) {
    std::smatch match;
    if (line == "namespace {") {
      open.emplace_back();
    } else if (std::regex_search(line, match, k_opened)) {
      open.push_back(match[1]);
    } else if (std::regex_search(line, k_closed) && !open.empty()) {
      open.pop_back();
    } else if (std::regex_search(line, match, k_type)) {
      std::string name;
      bool unnamed = false;
      for (const std::string& space : open) {
        unnamed = unnamed || space.empty();
        name += space + "::";
      }
      if (!unnamed) {
        found.push_back(name + match[1].str());
      }
    }
  }
  return found;
}

// Files, for the same type may stand in both branches of an #if.
std::map<std::string, std::set<std::string>> files_of_types(const fs::path& folder) {
  std::map<std::string, std::set<std::string>> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".h" || extension == ".cpp") {
      std::ifstream text(entry.path());
      for (const std::string& type : types_of(text)) {
        files[type].insert(entry.path().string());
      }
    }
  }
  return files;
}

TEST(Names, TypesAreReadAsTheCompilerWould) {
  std::istringstream text(
      "namespace radvor {\n"
      "struct Segment {\n"
      "  struct Inner {};\n"
      "};\n"
      "class Declared;\n"
      "enum class Kind : std::uint8_t { one, two };\n"
      "namespace {\n"
      "struct Hidden {\n"
      "};\n"
      "}  // namespace\n"
      "class Bake::State : public Base {\n"
      "namespace delaunay {\n"
      "struct alignas(16) Triangle {\n"
      "}  // namespace delaunay\n"
      "}  // namespace radvor\n");
  EXPECT_EQ(types_of(text), (std::vector<std::string>{"radvor::Segment", "radvor::Kind", "radvor::Bake::State",
                                                      "radvor::delaunay::Triangle"}));
}

// Found by the address sanitizer: visibility and surface each had a radvor::Segment, of 48 and of 32 bytes.
TEST(Names, NoTypeOfTheLibraryIsDefinedTwice) {
  const auto files = files_of_types(k_root / "src");
  EXPECT_GT(files.size(), 50u);
  for (const auto& [type, places] : files) {
    EXPECT_EQ(places.size(), 1u) << type << " is defined in " << testing::PrintToString(places);
  }
}

}  // namespace
