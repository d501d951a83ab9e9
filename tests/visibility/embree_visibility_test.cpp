// Embree against the oracle, on segments whose answer hangs on no rounding; and what only the whole can show: that
// nothing leaks, that threads change nothing, that the host's memory and threads are respected.
#include "visibility/embree_visibility.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <thread>

#include "base/floating_point.h"
#include "visibility/brute_force_visibility.h"
#include "visibility/sanitizers.h"
#include "visibility/triangle_soup.h"

namespace radvor {
namespace {

class Embree : public testing::Test {
 protected:
  void SetUp() override { RADVOR_SKIP_WITHOUT_EMBREE(); }

  EmbreeLibrary library_{""};
  Host host_ = make_host();
};

std::vector<std::uint8_t> answers(const Visibility& visibility, const std::vector<Sightline>& segments) {
  std::vector<std::uint8_t> blocked(segments.size());
  visibility.blocked(segments, blocked.data());
  return blocked;
}

std::vector<Sightline> clear_segments(const TriangleSoup& soup, std::uint64_t seed, std::size_t count) {
  Random random(seed);
  std::vector<Sightline> segments;
  std::size_t left_out = 0;
  while (segments.size() < count) {
    const Sightline segment{1.2 * random.in_cube(), 1.2 * random.in_cube()};
    if (is_clear(soup, segment, 1e-5)) {
      segments.push_back(segment);
    } else {
      ++left_out;
    }
  }
  EXPECT_LT(left_out, count / 4);
  return segments;
}

TriangleSoup moved(TriangleSoup soup, double scale, const Vec3& offset) {
  for (Vec3& position : soup.positions) {
    position = scale * position + offset;
  }
  return soup;
}

TEST_F(Embree, AgreesWithTheOracle) {
  const FloatingPointGuard workers(Denormals::flush);
  for (const std::size_t triangles : {1u, 2u, 12u, 100u, 300u}) {
    const TriangleSoup soup = random_soup(triangles, triangles, 0.5);
    const EmbreeVisibility embree(library_, soup.occluders(), host_);
    const BruteForceVisibility oracle(soup.occluders(), &host_.memory);
    const auto segments = clear_segments(soup, 17 * triangles, 3000);
    EXPECT_EQ(answers(embree, segments), answers(oracle, segments)) << triangles << " triangles";
    for (const Sightline& segment : segments) {
      const Vec3 direction = 0.01 * (segment.to - segment.from);
      const FirstHit expected = oracle.first_hit(segment.from, direction);
      const FirstHit hit = embree.first_hit(segment.from, direction);
      ASSERT_EQ(hit.triangle, expected.triangle);
      ASSERT_EQ(hit.front, expected.front);
      if (hit.triangle != FirstHit::k_miss) {
        const auto [a, b, c] = soup.triangle(hit.triangle);
        const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        ASSERT_LT(std::abs(glm::dot(normal, segment.from + hit.distance * direction - a)), embree.lift());
      }
    }
    // Many from one origin are what each is by itself, whatever their number and length.
    for (std::size_t k = 0; k + 40 <= segments.size(); k += 40) {
      std::vector<Vec3> directions;
      for (std::size_t i = 0; i <= k / 40 % 40; ++i) {
        directions.push_back(std::pow(10.0, static_cast<double>(i % 7) - 3) * (segments[k + i].to - segments[k].from));
      }
      std::vector<FirstHit> hits(directions.size());
      embree.first_hits(segments[k].from, directions, hits.data());
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const FirstHit alone = embree.first_hit(segments[k].from, directions[i]);
        ASSERT_EQ(hits[i].triangle, alone.triangle);
        ASSERT_EQ(hits[i].front, alone.front);
        ASSERT_NEAR(hits[i].distance, alone.distance, 1e-5 * alone.distance);
      }
    }
  }
}

TEST_F(Embree, AgreesAtAnyScaleAndPlace) {
  const FloatingPointGuard workers(Denormals::flush);
  const TriangleSoup soup = random_soup(5, 100, 0.5);
  const auto segments = clear_segments(soup, 6, 1000);
  const auto expected = answers(BruteForceVisibility(soup.occluders(), &host_.memory), segments);
  for (const double scale : {1e-30, 1e-4, 1.0, 1e4, 1e30}) {
    for (const Vec3& offset : {Vec3(0), scale * Vec3(1e6, -1e6, 3e5)}) {
      const TriangleSoup there = moved(soup, scale, offset);
      auto segments_there = segments;
      for (Sightline& segment : segments_there) {
        segment = {scale * segment.from + offset, scale * segment.to + offset};
      }
      const EmbreeVisibility embree(library_, there.occluders(), host_);
      EXPECT_EQ(answers(embree, segments_there), expected) << "scale " << scale << ", offset " << offset.x;
    }
  }
}

// Packets of every size from both calls, and not a byte behind the last answer.
TEST_F(Embree, AnswersAnyNumberOfSegments) {
  const TriangleSoup soup = random_soup(8, 60, 0.6);
  const EmbreeVisibility embree(library_, soup.occluders(), host_);
  const BruteForceVisibility oracle(soup.occluders(), &host_.memory);
  auto segments = clear_segments(soup, 9, 40);
  for (std::size_t count = 0; count <= 40; ++count) {
    std::vector<std::uint8_t> blocked(count + 1, 9);
    embree.blocked({segments.data(), count}, blocked.data());
    const auto expected = answers(oracle, {segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(count)});
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), blocked.begin())) << count;
    EXPECT_EQ(blocked[count], 9);
  }
  const Vec3 from(0.013, -0.021, 0.034);
  std::vector<Vec3> to;
  for (const Sightline& segment : clear_segments(soup, 10, 400)) {
    if (is_clear(soup, {from, segment.to}, 1e-5)) {
      to.push_back(segment.to);
    }
  }
  ASSERT_GT(to.size(), 40u);
  for (std::size_t count = 0; count <= 40; ++count) {
    std::vector<std::uint8_t> blocked(count + 1, 9);
    std::vector<std::uint8_t> expected(count + 1, 9);
    embree.blocked_from(from, {to.data(), count}, blocked.data());
    oracle.blocked_from(from, {to.data(), count}, expected.data());
    EXPECT_EQ(blocked, expected) << count;
  }
}

TEST_F(Embree, NothingBlocksInAnEmptyScene) {
  const EmbreeVisibility embree(library_, Occluders{}, host_);
  EXPECT_EQ(answers(embree, std::vector<Sightline>(20, {Vec3(0), Vec3(1, 2, 3)})), std::vector<std::uint8_t>(20, 0));
  EXPECT_EQ(embree.first_hit(Vec3(0), Vec3(1)).triangle, FirstHit::k_miss);
  EXPECT_EQ(embree.lift(), 0);
}

TEST_F(Embree, TrianglesWithoutAreaBlockNothing) {
  TriangleSoup soup;
  soup.add(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0));
  soup.add(Vec3(0.3), Vec3(0.3), Vec3(0.3));
  soup.add(Vec3(0, 1, 0), Vec3(0, 1, 0), Vec3(1, 1, 1));
  soup.add(Vec3(0.1, 0.2, 0.3), Vec3(0.2, 0.4, 0.6), Vec3(0.4, 0.8, 1.2));
  const EmbreeVisibility embree(library_, soup.occluders(), host_);
  Random random(3);
  std::vector<Sightline> segments(1000);
  for (Sightline& segment : segments) {
    segment = {2.0 * random.in_cube(), 2.0 * random.in_cube()};
  }
  EXPECT_EQ(answers(embree, segments), std::vector<std::uint8_t>(segments.size(), 0));
  TriangleSoup point;
  point.add(Vec3(4), Vec3(4), Vec3(4));
  const EmbreeVisibility at_a_point(library_, point.occluders(), host_);
  EXPECT_EQ(answers(at_a_point, segments), std::vector<std::uint8_t>(segments.size(), 0));
}

TEST_F(Embree, SegmentsWithoutLengthAreFree) {
  const TriangleSoup soup = sphere(8, 9);
  const EmbreeVisibility embree(library_, soup.occluders(), host_);
  EXPECT_EQ(answers(embree, std::vector<Sightline>(17, {Vec3(0.1), Vec3(0.1)})), std::vector<std::uint8_t>(17, 0));
}

TEST_F(Embree, PositionsThatNoTriangleNamesChangeNothing) {
  TriangleSoup soup = sphere(8, 9);
  const EmbreeVisibility without(library_, soup.occluders(), host_);
  soup.positions.emplace_back(1e30, -1e30, 0);
  const EmbreeVisibility with(library_, soup.occluders(), host_);
  EXPECT_EQ(with.lift(), without.lift());
}

// From inside a closed body, straight at its edges and into its triangles: nothing gets out. At corners Embree's own
// test is not watertight, with the robust flag either: known, and rare enough that rays not aimed at one never notice.
TEST_F(Embree, NothingSlipsThroughButAtCorners) {
  const FloatingPointGuard workers(Denormals::flush);
  const TriangleSoup ball = sphere(40, 61);
  const EmbreeVisibility embree(library_, ball.occluders(), host_);
  Random random(1);
  std::ptrdiff_t leaks_at_corners = 0;
  std::ptrdiff_t rays_at_corners = 0;
  for (int place = 0; place < 20; ++place) {
    const Vec3 from = 0.5 * random.in_cube();
    std::vector<Vec3> to;
    std::vector<Vec3> to_corners;
    for (std::size_t i = 0; i < ball.corners.size() / 3; ++i) {
      const auto [a, b, c] = ball.triangle(i);
      const double share = random.between(0.01, 0.99);
      for (const Vec3& target : {0.5 * (a + b), share * b + (1 - share) * c, 0.2 * a + 0.3 * b + 0.5 * c}) {
        to.push_back(from + 2.0 * (target - from));
        EXPECT_NE(embree.first_hit(from, target - from).triangle, FirstHit::k_miss);
      }
      to_corners.push_back(from + 2.0 * (a - from));
    }
    std::vector<std::uint8_t> blocked(to.size());
    embree.blocked_from(from, to, blocked.data());
    EXPECT_EQ(std::count(blocked.begin(), blocked.end(), 0), 0);
    std::vector<Sightline> segments(to.size());
    std::transform(to.begin(), to.end(), segments.begin(), [&](const Vec3& end) { return Sightline{from, end}; });
    const auto unpacked = answers(embree, segments);
    EXPECT_EQ(std::count(unpacked.begin(), unpacked.end(), 0), 0);

    std::vector<std::uint8_t> blocked_at_corners(to_corners.size());
    embree.blocked_from(from, to_corners, blocked_at_corners.data());
    leaks_at_corners += std::count(blocked_at_corners.begin(), blocked_at_corners.end(), 0);
    rays_at_corners += std::ssize(blocked_at_corners);
  }
  EXPECT_LT(leaks_at_corners, rays_at_corners / 200);  // measured with 3.13.5: 2 in 1000
}

// Rays at corners and edges, where the order of the tree's leaves decides which triangle is met: the same whatever
// number of threads built it or asks.
TEST_F(Embree, GivesTheSameAnswersForAnyNumberOfThreads) {
  const TriangleSoup soup = sphere(120, 260);  // large enough to be built in parallel
  std::vector<Vec3> targets = soup.positions;
  std::vector<std::uint32_t> expected_hits;
  std::vector<std::uint8_t> expected_blocked;
  const std::uint32_t cores = std::max(2u, std::thread::hardware_concurrency());
  for (const std::uint32_t threads : {cores, cores, cores, 2u, 1u}) {
    Host host = make_host(threads);
    const EmbreeVisibility embree(library_, soup.occluders(), host);
    std::vector<std::uint32_t> hits(targets.size());
    std::vector<std::uint8_t> blocked(targets.size());
    constexpr std::size_t k_chunk = 100;
    const auto chunks = static_cast<std::uint32_t>((targets.size() + k_chunk - 1) / k_chunk);
    host.jobs.for_each(chunks, [&](std::uint32_t chunk) {
      const std::size_t first = k_chunk * chunk;
      const std::size_t count = std::min(k_chunk, targets.size() - first);
      const Vec3 from(0.1, 0.2, 0.3);
      for (std::size_t i = first; i < first + count; ++i) {
        hits[i] = embree.first_hit(from, targets[i] - from).triangle;
      }
      embree.blocked_from(from, {&targets[first], count}, &blocked[first]);  // ends on the surface: rounding decides
    });
    if (expected_hits.empty()) {
      expected_hits = hits;
      expected_blocked = blocked;
      EXPECT_GT(std::count(blocked.begin(), blocked.end(), 1), 0);
      EXPECT_GT(std::count(blocked.begin(), blocked.end(), 0), 0);
    }
    EXPECT_EQ(hits, expected_hits) << threads << " threads";
    EXPECT_EQ(blocked, expected_blocked) << threads << " threads";
  }
}

TEST_F(Embree, KeepsItsArraysInTheHostsMemoryAndCountsEmbrees) {
  const TriangleSoup soup = sphere(40, 60);
  Host host = make_host(2);
  const std::uint64_t before = host.memory.live_bytes();
  {
    const EmbreeVisibility embree(library_, soup.occluders(), host);
    const std::size_t arrays = 12 * soup.positions.size() + 4 * soup.corners.size();
    EXPECT_GE(host.memory.live_bytes() - before, arrays);
    EXPECT_GT(embree.bytes(), arrays);  // the tree keeps copies of the corners
  }
  EXPECT_EQ(host.memory.live_bytes(), before);
}

TEST_F(Embree, LeavesTheHostsThreadLimitAlone) {
  using Control = tbb::global_control;
  const std::size_t before = Control::active_value(Control::max_allowed_parallelism);
  Host host = make_host(1);
  const EmbreeVisibility embree(library_, sphere(40, 60).occluders(), host);
  EXPECT_EQ(Control::active_value(Control::max_allowed_parallelism), before);
}

#if defined(__linux__)
std::ptrdiff_t threads_of_this_process() {
  const std::filesystem::directory_iterator threads("/proc/self/task");
  return std::distance(begin(threads), end(threads));
}

TEST_F(Embree, StartsNoThreadWhereTheHostLendsItsOwn) {
  Host host{HostMemory(nullptr, nullptr, nullptr), Log(nullptr, nullptr),
            Jobs(
                4,
                [](void*, std::uint32_t count, Jobs::Task task, void* data) {
                  for (std::uint32_t index = 0; index < count; ++index) {
                    task(data, index);
                  }
                },
                nullptr, std::pmr::get_default_resource())};
  const TriangleSoup soup = sphere(120, 260);  // large enough to be built in parallel
  const std::ptrdiff_t before = threads_of_this_process();
  const EmbreeVisibility embree(library_, soup.occluders(), host);
  EXPECT_EQ(threads_of_this_process(), before);
  EXPECT_NE(embree.first_hit(Vec3(0), Vec3(1, 2, 3)).triangle, FirstHit::k_miss);
}
#endif

}  // namespace
}  // namespace radvor
