// The caller's floating-point environment does not matter: rounding modes, denormals flushed.
#include <cfenv>
#include <functional>

#include "api/triangulation.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace radvor::test {
namespace {

// A bit of everything that the environment could change; all numbers that came out.
std::vector<double> everything(const std::function<void()>& before_each) {
  const Engine engine;
  const Delaunay d(engine);
  std::vector<double> seen;
  const auto call = [&](auto&& function) {
    before_each();
    const radvor_result result = function();
    std::fesetround(FE_TONEAREST);
#if defined(__SSE2__)
    _mm_setcsr(0x1f80);
#endif
    seen.push_back(result);
  };
  // What is computed here is computed under our own environment.
  const auto random = random_points(200, 7);
  std::vector<double> circle, small, tiny;
  for (int i = 0; i < 100; ++i) {
    circle.push_back(std::cos(0.1 * i) / 3 + 0.3);
    circle.push_back(std::sin(0.1 * i) / 3 + 0.3);
  }
  for (const double x : random) {
    small.push_back(x * 0x1p-130);
    tiny.push_back(0x1p-142 * (1 + x));
  }
  std::uint32_t id = RADVOR_NONE;
  call([&] { return radvor_delaunay_insert_many(d, circle.data(), 100, nullptr); });
  for (std::size_t i = 0; i < 60; ++i) {
    call([&] { return radvor_delaunay_insert(d, random[2 * i], random[2 * i + 1], &id); });
    call([&] { return radvor_delaunay_insert_near(d, small[2 * i], random[2 * i + 1], &id); });
    call([&] { return radvor_delaunay_insert(d, tiny[2 * i], tiny[2 * i + 1], &id); });
  }
  for (std::uint32_t v = 0; v < 100; v += 9) {
    call([&] { return radvor_delaunay_remove(d, v); });
    call([&] { return radvor_delaunay_constrain_as(d, v + 1, v + 50, 2, RADVOR_CROSSING_SPLIT); });
    const auto a = d.position(v + 1), b = d.position(v + 2);
    const double x = (a[0] + b[0]) / 2, y = (a[1] + b[1]) / 2;
    call([&] { return radvor_delaunay_constrain_as(d, v + 1, v + 2, 1, RADVOR_CROSSING_SPLIT); });
    call([&] { return radvor_delaunay_split(d, v + 1, v + 2, x, y, &id); });
  }
  std::vector<double> values(radvor_delaunay_vertex_bound(d), 0.5);
  call([&] { return radvor_delaunay_set_values(d, values.data(), 0, static_cast<std::uint32_t>(values.size())); });
  call([&] { return radvor_delaunay_realign(d); });
  for (std::size_t i = 60; i < 100; ++i) {
    double value = 0, area = 0, centroid[2] = {0, 0};
    std::uint32_t where = 0;
    call([&] { return radvor_delaunay_locate(d, random[2 * i], random[2 * i + 1], nullptr, &where, nullptr); });
    call([&] { return radvor_delaunay_interpolate(d, i % 2, random[2 * i], random[2 * i + 1], nullptr, &value); });
    call([&] {
      return radvor_delaunay_cell(d, static_cast<std::uint32_t>(i), nullptr, 0, nullptr, nullptr, &area, centroid);
    });
    seen.insert(seen.end(), {double(where), std::isnan(value) ? -1 : value, area, centroid[0], centroid[1]});
    call([&] {
      return radvor_delaunay_bounded_cell(d, static_cast<std::uint32_t>(i), 0, &where, nullptr, nullptr, &area,
                                          centroid);
    });
    seen.insert(seen.end(), {double(where), area, centroid[0], centroid[1]});
  }
  call([&] { return radvor_delaunay_validate(d); });
  EXPECT_EQ(seen.back(), RADVOR_OK) << engine.error();
  const auto state = d.state();
  seen.insert(seen.end(), state.begin(), state.end());
  return seen;
}

TEST(DelaunayApi, RoundingAndDenormalModesOfTheCallerDoNotMatter) {
  const auto expected = everything([] {});
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    EXPECT_EQ(everything([rounding] { std::fesetround(rounding); }), expected) << "rounding " << rounding;
  }
#if defined(__SSE2__)
  EXPECT_EQ(everything([] { _mm_setcsr(_mm_getcsr() | 0x8040); }), expected) << "denormals flushed";
#endif
}

}  // namespace
}  // namespace radvor::test
