// Processor time to build surfaces, to refine them, per site, and to find points on them, on one core: what a bake
// spends on meshing. Real scenes where they are there, and a room of boxes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "scene/facets.h"
#include "scene/obj_scene.h"
#include "support/test_host.h"
#include "surface/solids.h"
#include "surface/spacing.h"
#include "surface/surface.h"

namespace {

using namespace radvor;

struct Given {
  explicit Given(std::int64_t which)
      : host(1),
        scene(make(which, host)),
        welded(weld(scene, 0, host)),
        facets(find_facets(scene, welded, std::numbers::pi / 6, host)) {}

  static Scene make(std::int64_t which, test::TestHost& host) {
    static constexpr const char* k_names[] = {"", "cornell", "kenney-fps", "dungeon", "living-room"};
    if (which > 0) {
      if (auto real = test::real_scene(k_names[which], &host.memory)) {
        return std::move(*real);
      }
    }
    test::SceneBuilder builder(&host.memory);
    test::room_with_boxes(builder);
    return builder.take();
  }

  SurfaceOptions options(std::uint32_t element_levels) const {
    SpacingRequest request;
    request.refines = true;
    request.element_levels = element_levels;
    SurfaceOptions options = choose_spacing(scene, welded, facets, request);
    options.raises_first = false;  // that is a refinement, measured by itself
    return options;
  }

  test::TestHost host;
  Scene scene;
  WeldedScene welded;
  Facets facets;
};

void per_site(benchmark::State& state, std::size_t sites) {
  state.counters["sites"] = static_cast<double>(sites);
  state.counters["us_per_site"] = benchmark::Counter(
      static_cast<double>(sites) * 1e-6, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void build(benchmark::State& state) {
  Given given(state.range(0));
  const SurfaceOptions options = given.options(static_cast<std::uint32_t>(state.range(1)));
  std::size_t sites = 0;
  for (auto _ : state) {
    const Surface surface(given.scene, given.welded, given.facets, options, given.host);
    sites = surface.sites().size();
  }
  per_site(state, sites);
}
BENCHMARK(build)
    ->ArgNames({"scene", "levels"})
    ->Args({0, 0})
    ->Args({0, 2})
    ->Args({1, 0})
    ->Args({1, 1})
    ->Args({1, 2})
    ->Args({2, 1})
    ->Args({3, 1})
    ->Args({4, 1})
    ->Unit(benchmark::kMillisecond);

// Along a shadow's edge, a plane through the scene's middle: in each round the sites whose surroundings it crosses.
void refine(benchmark::State& state) {
  Given given(state.range(0));
  const SurfaceOptions options = given.options(0);
  const Vec3 middle = 0.5 * (given.welded.low + given.welded.high);
  const Vec3 across = glm::normalize(Vec3(1, 0.37, 0.21));
  std::size_t more = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::optional<Surface> surface(std::in_place, given.scene, given.welded, given.facets, options, given.host);
    const std::size_t before = surface->sites().size();
    state.ResumeTiming();
    std::vector<std::uint32_t> sites;
    for (std::uint32_t level = 0; level < surface->max_level(); ++level) {
      const double near = std::ldexp(options.patch_spacing, -static_cast<int>(level));
      sites.clear();
      for (std::uint32_t site = 0; site < surface->sites().size(); ++site) {
        if (surface->level_of(site) == level &&
            std::abs(glm::dot(surface->sites()[site].position - middle, across)) < near) {
          sites.push_back(site);
        }
      }
      benchmark::DoNotOptimize(surface->refine(sites));
    }
    more = surface->sites().size() - before;
    state.PauseTiming();
    surface.reset();
    state.ResumeTiming();
  }
  per_site(state, more);
}
BENCHMARK(refine)->ArgNames({"scene"})->Args({0})->Args({1})->Args({2})->Args({3})->Args({4})->Unit(
    benchmark::kMillisecond);

// Rays that hit a refined surface anywhere: the triangle of each point.
void locate(benchmark::State& state) {
  Given given(state.range(0));
  const SurfaceOptions options = given.options(0);
  Surface surface(given.scene, given.welded, given.facets, options, given.host);
  const Vec3 middle = 0.5 * (given.welded.low + given.welded.high);
  for (std::uint32_t level = 0; level < surface.max_level(); ++level) {
    std::vector<std::uint32_t> sites;
    for (std::uint32_t site = 0; site < surface.sites().size(); ++site) {
      if (surface.level_of(site) == level && std::abs(surface.sites()[site].position.x - middle.x) <
                                                 std::ldexp(options.patch_spacing, -static_cast<int>(level))) {
        sites.push_back(site);
      }
    }
    surface.refine(sites);
  }
  // By area, in an order without any coherence.
  std::vector<double> sums;
  for (const Triangle& triangle : given.welded.triangles) {
    const auto corner = [&](std::size_t k) { return given.welded.positions[triangle.vertices[k]]; };
    sums.push_back((sums.empty() ? 0 : sums.back()) +
                   glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))));
  }
  std::vector<PlanePoint> points;
  for (std::uint64_t k = 0; k < 1 << 16; ++k) {
    const double draw = to_unit(hash(k, 0)) * sums.back();
    const auto t = static_cast<std::size_t>(std::lower_bound(sums.begin(), sums.end(), draw) - sums.begin());
    const auto& vertices = given.welded.triangles[t].vertices;
    const double u = 1 - std::sqrt(to_unit(hash(k, 1)));
    const double v = (1 - u) * to_unit(hash(k, 2));
    const std::uint32_t facet = given.facets.facet_of_triangle[t];
    points.push_back({facet, given.facets.facets[facet].frame.to_plane(
                                 (1 - u - v) * given.welded.positions[vertices[0]] +
                                 u * given.welded.positions[vertices[1]] + v * given.welded.positions[vertices[2]])});
  }
  std::size_t next = 0;
  const auto together = static_cast<std::size_t>(state.range(1));
  std::vector<FacetPoint> found(together);
  while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(together))) {
    const std::span some = std::span(points).subspan(next, together);
    next = (next + together) % points.size();
    if (together == 1) {
      benchmark::DoNotOptimize(surface.locate(some[0].facet, some[0].at));
    } else {
      surface.locate(some, found.data());
      benchmark::DoNotOptimize(found.data());
    }
  }
  state.counters["sites"] = static_cast<double>(surface.sites().size());
}
BENCHMARK(locate)->ArgNames({"scene", "together"})->ArgsProduct({{0, 1, 2, 3, 4}, {1, 16}});

}  // namespace

BENCHMARK_MAIN();
