// No light leaks under walls and boxes: what is dark is dark to the last bit, what is lit keeps its light.
#include <gtest/gtest.h>

#include <cmath>

#include "rooms.h"
#include "test_bake.h"

namespace radvor {
namespace {

BakeOptions spaced(double patch_spacing) {
  BakeOptions options;
  options.tolerance = options.spacing.tolerance = 0.05;
  options.spacing.patch_spacing = patch_spacing;
  options.spacing.element_levels = 1;
  return options;
}

Light sun(const Vec3& direction) {
  Light light;
  light.type = LightType::directional;
  light.direction = glm::normalize(direction);
  light.color = Color(2.0);
  return light;
}

TEST(ContactLight, UnderABoxItIsDarkAndBesideItNotDarker) {
  for (const bool has_underside : {true, false}) {
    SceneBuilder builder;
    const std::uint32_t grey = builder.material(Color(0.5));
    builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, grey);
    const auto at = [](int i, double z) { return Vec3(i == 1 || i == 2 ? 2.3 : 1.1, i >= 2 ? 2.9 : 1.3, z); };
    for (int i = 0; i < 4; ++i) {
      builder.quad(at(i, 0), at((i + 1) % 4, 0), at((i + 1) % 4, 1), at(i, 1), grey);
    }
    builder.quad(at(0, 1), at(1, 1), at(2, 1), at(3, 1), grey);
    if (has_underside) {
      builder.quad(at(3, 0), at(2, 0), at(1, 0), at(0, 0), grey);
    }
    Scene scene = builder.take();
    scene.lights.push_back(sun({0, 0, -1}));
    TestBake bake(std::move(scene), spaced(0.5));
    ASSERT_EQ(bake.run(), BakeStatus::converged);
    std::size_t dark = 0;
    std::size_t lit = 0;
    const Surface& surface = bake->surface();
    for (std::size_t i = 0; i < surface.samples().size(); ++i) {
      const Sample& sample = surface.samples()[i];
      if (sample.point.z != 0 || sample.normal.z < 0.5) {
        continue;
      }
      const Vec3& p = sample.point;
      if (p.x > 1.1f && p.x < 2.3f && p.y > 1.3f && p.y < 2.9f) {
        EXPECT_EQ(bake.irradiance(i), Color(0.0)) << p.x << " " << p.y;
        ++dark;
      } else {
        EXPECT_NEAR(bake->direct()[i].g, 2.0, 1e-9) << p.x << " " << p.y;
        ++lit;
      }
    }
    EXPECT_GT(dark, 30u);
    EXPECT_GT(lit, 200u);
  }
}

Light bulb(const Vec3& position) {
  Light light;
  light.type = LightType::point;
  light.position = position;
  light.color = Color(3.0);
  return light;
}

// Direct light of a point: what is dark is dark because rays are blocked, whatever becomes of the rest of the light.
BakeOptions direct_alone(double patch_spacing) {
  BakeOptions options = spaced(patch_spacing);
  options.disable = Disable::indirect;
  return options;
}

TEST(ContactLight, ADarkClosedBoxOnALitFloorStaysDark) {
  // The box is hollow: its inside receives as well.
  SceneBuilder builder;
  const std::uint32_t grey = builder.material(Color(0.8), Color(0.0), true);
  builder.box({0, 0, 0}, {4, 4, 3}, true, grey);
  builder.box({0.7, 0.9, 0}, {1.9, 2.1, 1.2}, false, grey);
  Scene scene = builder.take();
  scene.lights.push_back(bulb({2.5, 2, 2.5}));
  TestBake bake(std::move(scene), direct_alone(0.6));
  ASSERT_EQ(bake.run(), BakeStatus::converged);
  std::size_t dark = 0;
  const Surface& surface = bake->surface();
  for (std::size_t i = 0; i < surface.samples().size(); ++i) {
    const Sample& sample = surface.samples()[i];
    const Vec3 p = sample.point + 1e-4 * sample.facet_normal;
    if (p.x > 0.7f && p.x < 1.9f && p.y > 0.9f && p.y < 2.1f && p.z > 0 && p.z < 1.2f) {
      EXPECT_EQ(bake->direct()[i], Color(0.0)) << p.x << " " << p.y << " " << p.z;
      ++dark;
    } else if (p.x > 2.5 && p.z < 0.1 && p.z > 0 && p.y > 0 && p.y < 4 && p.x < 4) {
      EXPECT_GT(bake->direct()[i].g, 0.01) << p.x << " " << p.y << " " << p.z;
    }
  }
  EXPECT_GT(dark, 100u);
}

// A long room, a light in its left part, a partition that just fits or that goes through floor, walls and ceiling: the
// right part is dark, however often light is reflected in the left one.
TEST(ContactLight, TwoRoomsShareAWallWithoutThickness) {
  for (const double beyond : {0.0, 0.25}) {
    for (const bool lamp_alone : {false, true}) {
      SceneBuilder builder;
      const std::uint32_t grey = builder.material(Color(0.8), Color(0.0), true);
      const std::uint32_t lamp = builder.material(Color(0.0), Color(5.0));
      builder.box({0, 0, 0}, {5, 2, 2}, true, grey);
      builder.quad({2.1, -beyond, -beyond}, {2.1, 2 + beyond, -beyond}, {2.1, 2 + beyond, 2 + beyond},
                   {2.1, -beyond, 2 + beyond}, grey);
      if (lamp_alone) {
        builder.quad({0.5, 1.5, 1.9}, {1.5, 1.5, 1.9}, {1.5, 0.5, 1.9}, {0.5, 0.5, 1.9}, lamp);
      }
      Scene scene = builder.take();
      if (!lamp_alone) {
        scene.lights.push_back(bulb({1, 1, 1.5}));
      }
      TestBake bake(std::move(scene), spaced(0.5));
      ASSERT_EQ(bake.run(), BakeStatus::converged);
      std::size_t dark = 0;
      std::size_t lit = 0;
      const Surface& surface = bake->surface();
      for (std::size_t i = 0; i < surface.samples().size(); ++i) {
        const Sample& sample = surface.samples()[i];
        const Vec3 p = sample.point + 1e-4 * sample.facet_normal;
        const bool in_house = p.y > 0 && p.y < 2 && p.z > 0 && p.z < 2 && p.x > 0 && p.x < 5;
        if (in_house && p.x > 2.1f) {
          EXPECT_EQ(bake.irradiance(i), Color(0.0)) << p.x << " " << p.y << " " << p.z;
          ++dark;
        } else if (in_house && p.z < 1.9f) {
          EXPECT_GT(bake.irradiance(i).g, 0.05) << p.x << " " << p.y << " " << p.z;
          ++lit;
        }
      }
      EXPECT_GT(dark, 300u);
      EXPECT_GT(lit, 200u);
    }
  }
}

TEST(ContactLight, NothingOfItWhereItIsTurnedOff) {
  for (const bool off : {true, false}) {
    SceneBuilder builder;
    const std::uint32_t grey = builder.material(Color(0.5));
    builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, grey);
    builder.box({1.1, 1.3, 0}, {2.3, 2.9, 1}, false, grey);
    BakeOptions options = spaced(0.5);
    options.disable = off ? Disable::intersections : 0;
    const TestBake bake(builder.take(), options);
    EXPECT_EQ((*bake).facets().contacts.edges.size(), off ? 0u : 4u);
  }
}

TEST(ContactLight, InsideASealedBoxUnderAnAreaLampIsDarkToTheLastBit) {
  // Found with contacts: clipping left splinters of 1e-19 along the edges of triangles that together hide the lamp.
  for (const bool refines : {false, true}) {
    SceneBuilder builder;
    const std::uint32_t grey = builder.material(Color(0.7));
    const std::uint32_t inner = builder.material(Color(0.7));
    builder.quad({0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, grey);
    builder.box({1.1, 1.3, 0}, {2.3, 2.9, 1.2}, false, grey);
    builder.box({1.15, 1.35, 0.05}, {2.25, 2.85, 1.15}, true, inner);
    builder.quad({1, 1, 3}, {1, 3, 3}, {3, 3, 3}, {3, 1, 3}, builder.material(Color(0.0), Color(10.0)));
    BakeOptions options = spaced(0.4);
    options.spacing.refines = refines;
    TestBake bake(builder.take(), options);
    ASSERT_EQ(bake.run(), BakeStatus::converged);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < bake->surface().samples().size(); ++i) {
      if (bake->facets().facets[bake->surface().samples()[i].facet].material == inner) {
        EXPECT_EQ(bake.irradiance(i), Color(0.0));
        ++inside;
      }
    }
    EXPECT_GT(inside, 50u);
  }
}

}  // namespace
}  // namespace radvor
