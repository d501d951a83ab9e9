// Finding an Embree, refusing what is none, and speaking to an Embree 4.
#include "visibility/embree_library.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "base/error.h"
#include "visibility/brute_force_visibility.h"
#include "visibility/embree_visibility.h"
#include "visibility/sanitizers.h"
#include "visibility/triangle_soup.h"

namespace radvor {
namespace {

// What embree4_stand_in.cpp says of itself, for a scope.
class Setting {
 public:
  Setting(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Setting() { unsetenv(name_); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
};

std::string refusal(std::string_view path) {
  try {
    const EmbreeLibrary library(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unsupported);
    return error.what();
  }
  return "accepted";
}

testing::AssertionResult contains(const std::string& text, const char* part) {
  return text.find(part) == std::string::npos ? testing::AssertionFailure() << text : testing::AssertionSuccess();
}

int packets_of(int lanes) {
  void* library = dlopen(RADVOR_EMBREE4_STAND_IN, RTLD_NOW | RTLD_LOCAL);
  const auto count = reinterpret_cast<int (*)(int)>(dlsym(library, "stand_in_packets"));
  const int packets = count(lanes);
  dlclose(library);
  return packets;
}

TEST(EmbreeLibrary, FindsTheSystems) {
  RADVOR_SKIP_WITHOUT_EMBREE();
  const EmbreeLibrary library("");
  EXPECT_GE(library.version(), 31300u);
}

TEST(EmbreeLibrary, TakesAnExplicitFile) {
  const EmbreeLibrary library(RADVOR_EMBREE4_STAND_IN);
  EXPECT_EQ(library.version(), 40301u);
}

TEST(EmbreeLibrary, NamesTheFileThatIsNotThere) {
  EXPECT_TRUE(contains(refusal("/nowhere/libembree4.so.4"), "/nowhere/libembree4.so.4"));
}

TEST(EmbreeLibrary, RefusesWhatIsNoLibrary) {
  EXPECT_TRUE(contains(refusal(__FILE__), "embree_library_test.cpp"));
}

TEST(EmbreeLibrary, RefusesALibraryWithoutItsFunctions) {
  const std::string reason = refusal("libm.so.6");
  EXPECT_TRUE(contains(reason, "libm.so.6"));
  EXPECT_TRUE(contains(reason, "rtcNewDevice"));
}

TEST(EmbreeLibrary, RefusesOtherVersions) {
  for (const auto& [number, name] : {std::pair{"21707", "2.17.7"}, {"31205", "3.12.5"}, {"50000", "5.0.0"}}) {
    const Setting version("RADVOR_STAND_IN_VERSION", number);
    EXPECT_TRUE(contains(refusal(RADVOR_EMBREE4_STAND_IN), name));
  }
}

TEST(EmbreeLibrary, RefusesOneThatCullsBackFaces) {
  const Setting culls("RADVOR_STAND_IN_CULLS", "1");
  EXPECT_TRUE(contains(refusal(RADVOR_EMBREE4_STAND_IN), "culling"));
}

TEST(EmbreeLibrary, RefusesPathsLongerThanAnySystems) {
  EXPECT_NE(refusal(std::string(5000, 'x')), "accepted");
}

TEST(EmbreeLibrary, KeepsItsSymbolsToItself) {
  const EmbreeLibrary library(RADVOR_EMBREE4_STAND_IN);
  EXPECT_EQ(dlsym(RTLD_DEFAULT, "stand_in_packets"), nullptr);
}

// An Embree 4 in every width: called as an Embree 3 would be, the stand-in aborts or answers otherwise.
TEST(Embree4, AnswersAsTheOracleDoesInEveryWidth) {
  const EmbreeLibrary library(RADVOR_EMBREE4_STAND_IN);
  Host host = make_host();
  const TriangleSoup soup = random_soup(2, 40, 0.7);
  const BruteForceVisibility oracle(soup.occluders(), &host.memory);
  Random random(12);
  std::vector<Sightline> segments;
  while (segments.size() < 403) {
    const Sightline segment{random.in_cube(), random.in_cube()};
    if (is_clear(soup, segment, 1e-5)) {
      segments.push_back(segment);
    }
  }
  std::vector<std::uint8_t> expected(segments.size());
  oracle.blocked(segments, expected.data());
  ASSERT_GT(std::count(expected.begin(), expected.end(), 1), 50);
  ASSERT_GT(std::count(expected.begin(), expected.end(), 0), 50);
  for (const int lanes : {16, 8, 4, 1}) {
    const Setting widest("RADVOR_STAND_IN_LANES", std::to_string(lanes).c_str());
    const EmbreeVisibility embree(library, soup.occluders(), host);
    const int before = packets_of(lanes);
    std::vector<std::uint8_t> blocked(segments.size());
    embree.blocked(segments, blocked.data());
    EXPECT_EQ(blocked, expected) << lanes << " lanes";
    EXPECT_GE(packets_of(lanes) - before, 403 / lanes) << "the native width was not used";
    for (const Sightline& segment : segments) {
      const FirstHit hit = embree.first_hit(segment.from, segment.to - segment.from);
      const FirstHit oracles = oracle.first_hit(segment.from, segment.to - segment.from);
      EXPECT_EQ(hit.triangle, oracles.triangle);
      EXPECT_EQ(hit.front, oracles.front);
    }
    // From one origin, numbers that fill packets and that do not.
    const int packets_before = packets_of(lanes);
    for (std::size_t count = 1; count <= 40; ++count) {
      std::vector<Vec3> directions;
      for (std::size_t k = 0; k < count; ++k) {
        directions.push_back(segments[k].to - segments[0].from);
      }
      std::vector<FirstHit> hits(count);
      embree.first_hits(segments[0].from, directions, hits.data());
      for (std::size_t k = 0; k < count; ++k) {
        const FirstHit oracles = oracle.first_hit(segments[0].from, directions[k]);
        EXPECT_EQ(hits[k].triangle, oracles.triangle);
        EXPECT_EQ(hits[k].front, oracles.front);
      }
    }
    EXPECT_GT(packets_of(lanes) - packets_before, 20) << "the native width was not used";
  }
}

}  // namespace
}  // namespace radvor
