// Refinement that pauses: the surface is what it was until the end, and then what comes of refining it at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "support/counted_memory.h"
#include "surface/made_surface.h"
#include "surface/refined_scenes.h"

namespace radvor {
namespace {

using test::expect_true;
using test::heap;
using test::k_scenes;
using test::MadeSurface;
using test::Make;
using test::options;
using test::positions;
using test::room;
using test::some_sites;

// What may be asked of a surface, sites apart.
struct Seen {
  explicit Seen(const Surface& surface, std::size_t facets) {
    const auto add = [&](const Vec3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); };
    for (const Share& share : surface.shares()) {
      add(share.centroid);
      numbers.insert(numbers.end(), {share.area, static_cast<double>(share.sample), static_cast<double>(share.facet)});
    }
    for (const Sample& sample : surface.samples()) {
      add(sample.point);
      add(sample.normal);
      add(surface.sites()[sample.site].position);
      numbers.insert(numbers.end(), {sample.area, static_cast<double>(sample.first_share)});
    }
    std::pmr::vector<Vec3> cell;
    std::size_t triangle_count = 0;
    for (std::uint32_t share = 0; share < surface.shares().size(); ++share) {
      surface.cell(share, cell);
      std::for_each(cell.begin(), cell.end(), add);
    }
    for (std::uint32_t facet = 0; facet < facets; ++facet) {
      const auto of = surface.triangles(facet);
      triangles.insert(triangles.end(), of.begin(), of.end());
      triangle_count += of.size();
      if (!of.empty()) {
        const Frame& frame = surface.facets().facets[facet].frame;
        const FacetPoint found = surface.locate(facet, frame.to_plane(surface.shares()[of[0][0]].centroid));
        triangles.push_back(found.shares);
        numbers.insert(numbers.end(), found.weights.begin(), found.weights.end());
      }
    }
    numbers.push_back(surface.constraint_count());
    EXPECT_EQ(surface.triangle_count(), triangle_count);
  }
  bool operator==(const Seen&) const = default;

  std::vector<double> numbers;
  std::vector<ShareTriangle> triangles;
};

TEST(RefineInSteps, ItIsAsBeforeUntilTheEnd) {
  for (const Make make : k_scenes) {
    MadeSurface in_steps(make(), options(0.9, 3)), at_once(make(), options(0.9, 3));
    const std::size_t facets = at_once.facets.facets.size();
    Pace pace(heap());
    pace.pause_at({}, {});  // long ago
    std::mt19937 random(5);
    for (int round = 0; round < 3; ++round) {
      const Seen before(in_steps.surface, facets);
      const auto sites = some_sites(at_once.surface, 20, random);
      const Share& share = at_once.surface.shares()[random() % at_once.surface.shares().size()];
      const std::array wanted = {WantedSite{share.facet, share.centroid}};
      const auto most = static_cast<std::uint32_t>(round < 2 ? 0 : at_once.surface.sites().size() + 15);
      std::pmr::vector<SampleOrigin> origins;
      Steps steps = in_steps.surface.refine(sites, most, wanted, origins, pace);
      int pauses = 0;
      for (; steps.go_on(); ++pauses) {
        ASSERT_TRUE(Seen(in_steps.surface, facets) == before) << round << ", " << pauses;
      }
      EXPECT_GT(pauses, 5);
      const auto expected = at_once.surface.refine(sites, most, wanted);
      EXPECT_EQ(positions(in_steps.surface), positions(at_once.surface));
      EXPECT_TRUE(Seen(in_steps.surface, facets) == Seen(at_once.surface, facets));
      ASSERT_EQ(origins.size(), expected.size());
      for (std::size_t i = 0; i < origins.size(); ++i) {
        EXPECT_EQ(origins[i].samples, expected[i].samples);
        EXPECT_EQ(origins[i].weights, expected[i].weights);
        EXPECT_EQ(origins[i].kept, expected[i].kept);
      }
      expect_true(in_steps);
    }
  }
}

TEST(RefineInSteps, LeftOffForGoodItLetsAllGo) {
  test::CountedMemory frames;
  bool is_over = false;
  for (int pauses = 0; !is_over; ++pauses) {
    MadeSurface made(room(), options(0.9, 3));
    const std::vector<std::uint32_t> sites{0, 1, 2, 3};
    std::pmr::vector<SampleOrigin> origins;
    Pace pace(&frames);
    pace.pause_at({}, {});  // long ago
    {
      Steps steps = made.surface.refine(sites, 0, {}, origins, pace);
      for (int k = 0; k < pauses; ++k) {
        is_over = !steps.go_on();
        EXPECT_EQ(is_over, !origins.empty());
      }
      EXPECT_GT(frames.bytes, 0u);
    }
    EXPECT_EQ(frames.bytes, 0u);
    EXPECT_TRUE(!is_over || pauses > 5);
  }
}

}  // namespace
}  // namespace radvor
