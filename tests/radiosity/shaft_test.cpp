// Exact visibility of polygonal emitters: what triangles hide of a polygon, and which triangles can.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "plates.h"
#include "radiosity/emitter.h"
#include "radiosity/form_factor.h"
#include "radiosity/occluder_tree.h"
#include "radiosity/visible_polygon.h"

namespace radvor {
namespace {

using Polygon = std::vector<Vec3>;
using Corners = std::array<Vec3, 3>;

constexpr double k_lift = 1e-12;
const Vec3 k_up(0, 0, 1);
const Vec3 k_down(0, 0, -1);

// Axis-parallel rectangle at height z that faces down.
Polygon rectangle(double x0, double x1, double y0, double y1, double z) {
  return {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}};
}

double rectangle_factor(const Vec3& x, double x0, double x1, double y0, double y1, double z) {
  return x0 < x1 && y0 < y1 ? polygon_form_factor(x, k_up, rectangle(x0, x1, y0, y1, z), k_down) : 0;
}

OccluderTree tree_of(const Plates& plates) {
  return {{plates.positions, plates.corners}, std::pmr::get_default_resource()};
}

// What `x` on a floor sees of `polygon` past all plates, by shaft and by clipping.
double seen(const Vec3& x, const Polygon& polygon, const Vec3& normal, const Plates& plates) {
  const OccluderTree tree = tree_of(plates);
  std::vector<std::uint32_t> found(plates.corners.size() / 3);
  const Vec3 eye = x + k_lift * k_up;
  const auto count = tree.between(eye, polygon, normal, k_lift, found);
  EXPECT_TRUE(count);
  VisiblePolygon visible(eye, polygon, normal, k_lift);
  for (std::size_t i = 0; i < *count; ++i) {
    EXPECT_TRUE(visible.subtract(tree.triangle(found[i])));
  }
  return visible.form_factor(x, k_up);
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 point_in_box(std::mt19937& random, const Vec3& low, const Vec3& high) {
  const double x = uniform(random, low.x, high.x), y = uniform(random, low.y, high.y);
  return {x, y, uniform(random, low.z, high.z)};
}

TEST(VisiblePolygon, HalfPlanePenumbra) {
  // Square at z = 2 over the half-plane z = 1, x < 0: hidden is what lies beyond the line that the half-plane's edge
  // projects to, x = -(receiver's x); the rest is a rectangle.
  Plates plates;
  plates.add({-100, -100, 1}, {0, -100, 1}, {0, 100, 1}, {-100, 100, 1});
  const Polygon light = rectangle(-.5, .5, -.5, .5, 2);
  for (int i = -80; i <= 120; ++i) {
    const Vec3 x(0.01 * i, 0.003 * i, 0);
    EXPECT_NEAR(seen(x, light, k_down, plates), rectangle_factor(x, std::max(-.5, -x.x), .5, -.5, .5, 2), 1e-11) << x.x;
  }
}

TEST(VisiblePolygon, ObstructedSquares) {
  // The shadow of a plate parallel to the light is a rectangle; area means over the lower square: facts of View3D's
  // examples (closed forms), by Gauss's rule on each side of the plate's shadow lines.
  const double heights[] = {1.0 / 3, 0.4, 0.5};
  const double exact[] = {0.10635096, 0.10190811, 0.099506295};
  const double node = std::sqrt(0.6);
  for (int k = 0; k < 3; ++k) {
    const double h = heights[k];
    Plates plates;
    plates.add({.25, .25, h}, {.75, .25, h}, {.75, .75, h}, {.25, .75, h});
    const Polygon light = rectangle(0, 1, 0, 1, 1);
    const int cells = 24;
    double mean = 0;
    for (int a = 0; a < 3 * cells; ++a) {
      for (int b = 0; b < 3 * cells; ++b) {
        const auto place = [&](int i) { return (i / 3 + 0.5 + 0.5 * node * (i % 3 - 1)) / cells; };
        const auto weight = [&](int i) { return (i % 3 == 1 ? 8.0 : 5.0) / 18 / cells; };
        const Vec3 x(place(a), place(b), 0);
        const double got = seen(x, light, k_down, plates);
        const auto shadow = [&](double edge, double from) { return std::clamp(from + (edge - from) / h, 0.0, 1.0); };
        EXPECT_NEAR(got,
                    rectangle_factor(x, 0, 1, 0, 1, 1) -
                        rectangle_factor(x, shadow(.25, x.x), shadow(.75, x.x), shadow(.25, x.y), shadow(.75, x.y), 1),
                    1e-11);
        mean += got * weight(a) * weight(b);
      }
    }
    EXPECT_NEAR(mean / exact[k], 1, 1e-4) << h;
  }
}

TEST(VisiblePolygon, NestedOccludersHideWhatTheLargestDoes) {
  const Polygon light = rectangle(-1, 1, -1, 1, 2);
  const Vec3 x(0.2, 0.1, 0);
  Plates alone, nested;
  const auto frustum = [&](Plates& plates, double z, double size) {  // seen from x: the same square, scaled
    const double t = z / 2;
    const auto at = [&](double u, double v) { return x + t * (Vec3(size * u, size * v, 2) - x); };
    plates.add(at(-.5, -.5), at(.5, -.5), at(.5, .5), at(-.5, .5));
  };
  frustum(alone, 1, 1);
  for (const double z : {0.3, 0.9, 1.0, 1.5, 1.9}) {
    frustum(nested, z, z == 0.9 ? 1.0 : 0.6);
  }
  const double exact = rectangle_factor(x, -1, 1, -1, 1, 2) - rectangle_factor(x, -.5, .5, -.5, .5, 2);
  EXPECT_NEAR(seen(x, light, k_down, alone), exact, 1e-11);
  EXPECT_NEAR(seen(x, light, k_down, nested), exact, 1e-11);
}

TEST(VisiblePolygon, NoLightThroughSharedEdges) {
  // A plate of many jittered triangles that share edges and corners hides what one plate would: all, or up to its edge.
  std::mt19937 random(7);
  const Polygon light = rectangle(-.5, .5, -.5, .5, 2);
  for (int round = 0; round < 50; ++round) {
    const int side = 2 + round % 4;
    const bool all = round % 2 == 0;
    Plates plates;
    for (int i = 0; i <= side; ++i) {
      for (int k = 0; k <= side; ++k) {
        Vec3 corner(-2.0 + 4.0 * i / side, -2.0 + (all ? 4.0 : 2.0) * k / side, 1);
        if (i % side != 0 && k % side != 0) {
          corner += point_in_box(random, {-.3 / side, -.3 / side, -.4}, {.3 / side, .3 / side, .4});
        }
        plates.positions.push_back(corner);
      }
    }
    for (int i = 0; i < side; ++i) {
      for (int k = 0; k < side; ++k) {
        const auto a = static_cast<std::uint32_t>(i * (side + 1) + k);
        const auto b = a + static_cast<std::uint32_t>(side) + 1;
        if ((i + k) % 2 == 0) {
          plates.corners.insert(plates.corners.end(), {a, b, b + 1, a, b + 1, a + 1});
        } else {
          plates.corners.insert(plates.corners.end(), {a, b, a + 1, b, b + 1, a + 1});
        }
      }
    }
    const Vec3 x = point_in_box(random, {-.2, -.2, 0}, {.2, .2, 0});
    const double exact = all ? 0 : rectangle_factor(x, -.5, .5, std::max(-.5, -x.y), .5, 2);
    EXPECT_NEAR(seen(x, light, k_down, plates), exact, 1e-12) << round;
  }
}

TEST(VisiblePolygon, WallsThatTouchTheEmitterOrTheFloor) {
  const Polygon light = rectangle(-.5, .5, -.5, .5, 2);
  Plates hanging;  // from the light down to z = 1.5, at x = 0
  hanging.add({0, -9, 1.5}, {0, 9, 1.5}, {0, 9, 2}, {0, -9, 2});
  for (const double at : {-1.2, -0.3, -1e-3, 1e-3, 0.3, 1.2}) {
    const Vec3 x(at, 0, 0);
    const double edge = std::clamp(-at / 3, -.5, .5);  // of its shadow on the light
    const double exact = rectangle_factor(x, -.5, .5, -.5, .5, 2) -
                         rectangle_factor(x, std::min(0.0, edge), std::max(0.0, edge), -.5, .5, 2);
    EXPECT_NEAR(seen(x, light, k_down, hanging), exact, 1e-11) << at;
  }
  Plates standing;  // on the floor up to z = 0.5, at x = 0, and the floor itself
  standing.add({0, -9, 0}, {0, 9, 0}, {0, 9, .5}, {0, -9, .5});
  standing.add({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0});
  for (const double at : {-1.2, -0.1, -1e-3}) {
    const Vec3 x(at, 0, 0);
    const double edge = std::clamp(-3 * at, -.5, .5);
    EXPECT_NEAR(seen(x, light, k_down, standing), rectangle_factor(x, -.5, edge, -.5, .5, 2), 1e-11) << at;
  }
}

TEST(VisiblePolygon, ItsOwnPlaneAndWhatLiesBehindHideNothing) {
  const Polygon light = rectangle(-.5, .5, -.5, .5, 2);
  Plates plates;
  plates.add(light[0], light[1], light[2], light[3]);
  plates.add({-9, -9, 2}, {9, -9, 2}, {9, 9, 2}, {-9, 9, 2});
  plates.add({-9, -9, 3}, {9, -9, 3}, {9, 9, 3}, {-9, 9, 3});
  plates.add({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0});
  plates.add({-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1});
  const Vec3 x(0.3, 0.4, 0);
  std::array<std::uint32_t, 1> found;
  EXPECT_EQ(tree_of(plates).between(x + k_lift * k_up, light, k_down, k_lift, found), 0u);
  EXPECT_NEAR(seen(x, light, k_down, plates), rectangle_factor(x, -.5, .5, -.5, .5, 2), 1e-15);
}

TEST(VisiblePolygon, TrianglesWithoutWidthHideNothing) {
  const Polygon light = rectangle(-.5, .5, -.5, .5, 2);
  const Vec3 x(0.1, 0.2, 0);
  const double whole = rectangle_factor(x, -.5, .5, -.5, .5, 2);
  std::mt19937 random(11);
  for (int round = 0; round < 2000; ++round) {
    const Vec3 a = point_in_box(random, {-1, -1, 0.01}, {1, 1, 2});
    const Vec3 b = point_in_box(random, {-1, -1, 0.01}, {1, 1, 2});
    const double t = uniform(random, 0, 1);
    Corners needle = {a, b, a + t * (b - a)};  // no area, but for rounding
    switch (round % 5) {
      case 1:
        needle[2] = b;
        break;
      case 2:
        needle[1] = needle[2] = a;
        break;
      case 3:  // the eye on its plane
        needle[2] = x + uniform(random, -1, 1) * (a - x) + uniform(random, -1, 1) * (b - x);
        break;
      case 4:  // the eye in line with a side, 1e-13 wide
        needle[2] = x + 0.7 * (a - x) + Vec3(1e-13, -1e-13, 0);
        break;
      default:
        break;
    }
    VisiblePolygon visible(x, light, k_down, k_lift);
    ASSERT_TRUE(visible.subtract(needle));
    EXPECT_NEAR(visible.form_factor(x, k_up), whole, 1e-12) << round;
  }
}

TEST(VisiblePolygon, ThinTrianglesHideTheirShare) {
  // A square cut into needles from one corner, 1e-9 to 1 wide, hides what the square does.
  const Polygon light = rectangle(-1, 1, -1, 1, 2);
  const Vec3 x(0.05, 0.02, 0);
  VisiblePolygon visible(x, light, k_down, k_lift);
  double previous = 0;
  for (const double t : {1e-9, 1e-8, 1e-6, 1e-3, 0.1, 0.5, 1.0}) {
    ASSERT_TRUE(visible.subtract({Vec3(-.25, -.25, 1), Vec3(.25, -.25 + previous / 2, 1), Vec3(.25, -.25 + t / 2, 1)}));
    ASSERT_TRUE(visible.subtract({Vec3(-.25, -.25, 1), Vec3(-.25 + t / 2, .25, 1), Vec3(-.25 + previous / 2, .25, 1)}));
    previous = t;
  }
  EXPECT_NEAR(visible.form_factor(x, k_up),
              rectangle_factor(x, -1, 1, -1, 1, 2) - rectangle_factor(x, -.5 - x.x, .5 - x.x, -.5 - x.y, .5 - x.y, 2),
              1e-12);
}

TEST(VisiblePolygon, TooManyPiecesIsSaid) {
  // A fence: each stake splits all that is left of the light in its way.
  VisiblePolygon visible({0, 0, 0}, rectangle(-1, 1, -1, 1, 2), k_down, k_lift);
  bool held = true;
  int stakes = 0;
  for (; held && stakes < 200; ++stakes) {
    const double at = -0.4 + 0.8 * stakes / 200;
    held = visible.subtract({Vec3(at, -9, 1), Vec3(at + 0.001, -9, 1), Vec3(at, 9, 1)});
  }
  EXPECT_FALSE(held);
  EXPECT_GT(stakes, 30);
}

// Triangles of all sizes at random between a floor and a light.
Plates soup(std::mt19937& random, std::size_t count) {
  Plates plates;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 centre = point_in_box(random, {-1, -1, 0}, {1, 1, 2});
    const double size = std::exp(uniform(random, std::log(0.02), std::log(1.5)));
    for (int k = 0; k < 3; ++k) {
      plates.corners.push_back(static_cast<std::uint32_t>(plates.positions.size()));
      plates.positions.push_back(centre + point_in_box(random, Vec3(-size), Vec3(size)));
    }
  }
  return plates;
}

TEST(VisiblePolygon, RandomSoupsAgreeWithRays) {
  // Uniform points on the light; the bound is five standard errors as the sample has them, and all deviations together
  // must be those of an unbiased estimate.
  std::mt19937 random(3);
  const Corners light = {Vec3(-.6, -.5, 2.2), Vec3(0.1, .7, 1.9), Vec3(.8, -.3, 2.1)};
  const Vec3 twice = glm::cross(light[1] - light[0], light[2] - light[0]);
  const Vec3 normal = glm::normalize(twice);
  ASSERT_LT(normal.z, 0);
  const double area = 0.5 * glm::length(twice);
  const int samples = 4000;
  double squares = 0;
  int compared = 0;
  for (int round = 0; round < 150; ++round) {
    const Plates plates = soup(random, 1 + static_cast<std::size_t>(round) % 24);
    const BruteForceVisibility visibility = plates.visibility();
    const Vec3 x = point_in_box(random, {-1, -1, 0}, {1, 1, 0.5});
    const double exact = seen(x, {light.begin(), light.end()}, normal, plates);
    double sum = 0, sum_of_squares = 0, largest = 0;
    for (int i = 0; i < samples; ++i) {
      const double s = std::sqrt(uniform(random, 0, 1)), t = uniform(random, 0, 1);
      const Vec3 y = (1 - s) * light[0] + s * (1 - t) * light[1] + s * t * light[2];
      std::uint8_t blocked = 0;
      const Vec3 target = y + normal * visibility.lift();
      visibility.blocked_from(x + k_lift * k_up, std::span(&target, 1), &blocked);
      const double whole = area * kernel(x, k_up, y, normal);
      const double value = blocked ? 0 : whole;
      largest = std::max(largest, whole);
      sum += value;
      sum_of_squares += value * value;
    }
    const double mean = sum / samples;
    const double error = std::sqrt((sum_of_squares / samples - mean * mean) / samples);
    // Where no sample is seen, or none is hidden, the error says nothing: the rule of three, at like confidence.
    EXPECT_NEAR(mean, exact, 5 * error + 15.0 / samples * largest) << round;
    if (sum_of_squares > 0) {
      squares += (mean - exact) * (mean - exact) / (error * error);
      ++compared;
    }
  }
  ASSERT_GT(compared, 80);
  EXPECT_NEAR(squares / compared, 1, 5 * std::sqrt(2.0 / compared));
}

TEST(OccluderTree, FindsAllThatHideAndSaysIfTooMany) {
  std::mt19937 random(5);
  int hiding = 0, candidates = 0;
  for (int round = 0; round < 100; ++round) {
    const Plates plates = soup(random, 200);
    const OccluderTree tree = tree_of(plates);
    const Polygon light = rectangle(-.5, uniform(random, -.4, .5), -.5, .5, 2);
    const Vec3 x = point_in_box(random, {-1, -1, 0}, {1, 1, 0.5});
    std::vector<std::uint32_t> found(200);
    const auto count = tree.between(x, light, k_down, k_lift, found);
    ASSERT_TRUE(count);
    found.resize(*count);
    for (std::uint32_t i = 0; i < 200; ++i) {
      VisiblePolygon visible(x, light, k_down, k_lift);
      ASSERT_TRUE(visible.subtract(tree.triangle(i)));
      if (!visible.whole()) {
        ++hiding;
        EXPECT_EQ(std::count(found.begin(), found.end(), i), 1) << round;
      }
    }
    candidates += static_cast<int>(*count);
    if (*count > 0) {
      EXPECT_EQ(tree.between(x, light, k_down, k_lift, std::span(found).first(*count - 1)), std::nullopt);
    }
    EXPECT_EQ(tree.between(x, light, k_down, k_lift, found), count);
  }
  EXPECT_LT(candidates, 2 * hiding);
}

// Both triangles of a rectangle that emits radiosity 1, with all that goes with it.
double irradiance(const Polygon& light, const Vec3& x, const Plates& plates, TransportCounters& counters) {
  const OccluderTree tree = tree_of(plates);
  const BruteForceVisibility visibility = plates.visibility();
  Tracer tracer(visibility);
  EmitterAccuracy accuracy;
  accuracy.mean_irradiance = 0.05;
  double sum = 0;
  Sight sight;
  for (const Corners& corners : {Corners{light[0], light[1], light[2]}, Corners{light[0], light[2], light[3]}}) {
    const Emitter emitter{corners, k_down, Color(1.0), 0.5};
    sum += irradiance_of_emitter(emitter, receiver_at(x, k_up, visibility), tracer, accuracy, &tree, sight).r;
  }
  counters += tracer.counters;
  return sum;
}

TEST(ExactEmitter, PenumbraNeedsNoRay) {
  Plates plates;
  plates.add({-100, -100, 1}, {0, -100, 1}, {0, 100, 1}, {-100, 100, 1});
  TransportCounters counters;
  for (int i = -80; i <= 120; ++i) {
    const Vec3 x(0.01 * i, 0.003 * i, 0);
    EXPECT_NEAR(irradiance(rectangle(-.5, .5, -.5, .5, 2), x, plates, counters),
                rectangle_factor(x, std::max(-.5, -x.x), .5, -.5, .5, 2), 1e-9)
        << x.x;
  }
  EXPECT_EQ(counters.rays, 0);
  EXPECT_GT(counters.skipped_clear, 0);
}

TEST(ExactEmitter, NothingOfTheSmallestOccluderIsMissed) {
  // A grain that rays to the light's strata pass by.
  Plates plates;
  plates.add({.012, .007, 1}, {.013, .007, 1}, {.013, .009, 1}, {.012, .009, 1});
  TransportCounters counters;
  const Vec3 x(0, 0, 0);
  EXPECT_NEAR(irradiance(rectangle(-.5, .5, -.5, .5, 2), x, plates, counters),
              rectangle_factor(x, -.5, .5, -.5, .5, 2) - rectangle_factor(x, .024, .026, .014, .018, 2), 1e-11);
}

TEST(ExactEmitter, APanelIsItsHalvesTogether) {
  std::mt19937 random(11);
  int seen_in_part = 0, crowds = 0;
  for (int round = 0; round < 200; ++round) {
    const Plates plates = soup(random, round % 4 == 0 ? 200 : 8);
    const OccluderTree tree = tree_of(plates);
    const BruteForceVisibility visibility = plates.visibility();
    const Polygon light = rectangle(-.5, uniform(random, -.4, .5), -.5, .5, 2);
    const double area = light[2].x - light[0].x;
    const std::array<Emitter, 2> halves = {Emitter{{light[0], light[1], light[2]}, k_down, Color(1.0), 0.5 * area},
                                           Emitter{{light[0], light[2], light[3]}, k_down, Color(1.0), 0.5 * area}};
    const Receiver receiver = receiver_at(point_in_box(random, {-1, -1, 0}, {1, 1, 0.2}), k_up, visibility);
    EmitterAccuracy accuracy;
    accuracy.mean_irradiance = 0.05;
    Tracer apart(visibility), together(visibility);
    double expected = 0;
    for (const Emitter& half : halves) {
      Sight sight;
      expected += irradiance_of_emitter(half, receiver, apart, accuracy, &tree, sight).r;
    }
    Sight sight;
    const double found = irradiance_of_panel(halves, light, receiver, together, accuracy, &tree, sight).r;
    if (apart.counters.rays == 0 && together.counters.rays == 0) {  // exact both times
      EXPECT_NEAR(found, expected, 1e-9) << round;
      EXPECT_EQ(sight.open, found > 0) << round;
      const double whole = polygon_form_factor(receiver.point, receiver.normal, light, k_down);
      seen_in_part += found > 0 && found < whole ? 1 : 0;
    } else {
      ++crowds;
      EXPECT_NEAR(found, expected, 0.1) << round;
    }
  }
  EXPECT_GT(seen_in_part, 50);
  EXPECT_GT(crowds, 10);
}

TEST(ExactEmitter, CutByTheHorizonBeforeWhatLiesUnderIt) {
  // A wall half under the floor's level, on the floor: what is under it is not there, and the floor hides none of it.
  Plates floor;
  floor.add({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0});
  const Polygon wall = {{1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}};
  const Polygon upper = {{1, -1, 0}, {1, -1, 1}, {1, 1, 1}, {1, 1, 0}};
  const Vec3 towards(-1, 0, 0);
  const OccluderTree tree = tree_of(floor);
  const BruteForceVisibility visibility = floor.visibility();
  Tracer tracer(visibility);
  double sum = 0;
  Sight sight;
  for (const Corners& corners : {Corners{wall[0], wall[1], wall[2]}, Corners{wall[0], wall[2], wall[3]}}) {
    const Emitter emitter{corners, towards, Color(1.0), 2};
    sum += irradiance_of_emitter(emitter, receiver_at({0, 0, 0}, k_up, visibility), tracer, {}, &tree, sight).r;
  }
  EXPECT_NEAR(sum, polygon_form_factor({0, 0, 0}, k_up, upper, towards), 1e-12);
  EXPECT_EQ(tracer.counters.skipped_clear, 2);
}

TEST(ExactEmitter, ManyOccludersAreLeftToRays) {
  // A fence of 100 stakes: more than are clipped. Half of the light passes.
  Plates plates;
  for (int i = 0; i < 100; ++i) {
    const double at = -0.5 + 0.01 * i;
    plates.add({at, -9, 1}, {at + .005, -9, 1}, {at + .005, 9, 1}, {at, 9, 1});
  }
  TransportCounters counters;
  const Vec3 x(0, 0, 0);
  const double whole = rectangle_factor(x, -.5, .5, -.5, .5, 2);
  EXPECT_NEAR(irradiance(rectangle(-.5, .5, -.5, .5, 2), x, plates, counters) / whole, 0.5, 0.05);
  EXPECT_GT(counters.rays, 100);
}

}  // namespace
}  // namespace radvor
