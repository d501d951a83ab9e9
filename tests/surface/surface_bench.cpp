// Processor time to build surfaces and to refine them, on one core, per site: what a bake spends on meshing. Real
// scenes where they are there, and a room of boxes.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

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
    return choose_spacing(scene, welded, facets, request);
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

}  // namespace
