// A point that stands lift() off a surface is never blocked by that surface: for triangles and flat neighbourhoods of
// many shapes, anywhere, at any scale, in any direction, grazing ones above all.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/floating_point.h"
#include "visibility/brute_force_visibility.h"
#include "visibility/embree_visibility.h"
#include "visibility/sanitizers.h"
#include "visibility/triangle_soup.h"

namespace radvor {
namespace {

struct Plane {
  Vec3 origin, along, across, normal;
  Vec3 at(double u, double v) const { return origin + u * along + v * across; }
};

Plane random_plane(Random& random, double size) {
  const Vec3 normal = random.direction();
  const Vec3 along = glm::normalize(glm::cross(normal, random.direction()));
  return {0.4 * random.in_cube(), size * along, size * glm::cross(normal, along), normal};
}

// Two triangles far apart, one at each corner of the cube: they fix the frame, so that the size of what lies between
// them is a size relative to the scene's.
void add_corners_of_cube(TriangleSoup& soup) {
  for (const double side : {-1.0, 1.0}) {
    const Vec3 corner(side);
    soup.add(corner, corner + 1e-3 * side * Vec3(1, 0, 0), corner + 1e-3 * side * Vec3(0, 1, 0));
  }
}

struct Placement {
  double scale;
  Vec3 offset;
};

// Segments from lifted points of the plane, (u, v) in the unit square, outwards: a third anywhere, a third grazing the
// plane, a third grazing it along its first direction; from tiny to beyond the scene. Both ways, as either end is
// lifted.
std::vector<Sightline> lifted_segments(const Plane& plane, Random& random, const Visibility& visibility,
                                       const Placement& placement, const std::vector<Vec2>& points) {
  std::vector<Sightline> segments;
  for (const Vec2& point : points) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 normal = side * plane.normal;
      Vec3 direction = random.direction();
      direction = glm::dot(direction, normal) < 0 ? -direction : direction;
      const std::uint32_t kind = random.below(3);
      if (kind > 0) {
        const Vec3 flat = kind == 1 ? direction - glm::dot(direction, normal) * normal : plane.along;
        direction = glm::normalize(flat) + std::pow(10.0, random.between(-7, -1)) * normal;
      }
      direction *= placement.scale * std::pow(10.0, random.between(-4, 0.5));
      const Vec3 on_surface = placement.scale * plane.at(point.x, point.y) + placement.offset;
      const Vec3 from = on_surface + visibility.lift() * normal;
      segments.push_back({from, from + direction});
      segments.push_back({from + direction, from});
    }
  }
  return segments;
}

std::vector<std::uint8_t> answers(const Visibility& visibility, const std::vector<Sightline>& segments) {
  std::vector<std::uint8_t> blocked(segments.size());
  visibility.blocked(segments, blocked.data());
  for (std::size_t i = 0; i < segments.size(); i += 7) {  // alone and packed by origin too
    std::uint8_t alone = 0;
    visibility.blocked_from(segments[i].from, {&segments[i].to, 1}, &alone);
    blocked[i] |= alone;
  }
  return blocked;
}

// shape gives the flat neighbourhood in (u, v) and points in it.
template <class MakeVisibility, class Shape>
void expect_unblocked(const MakeVisibility& make, const Shape& shape) {
  const FloatingPointGuard workers(Denormals::flush);
  Random random(4);
  for (const Placement& placement :
       {Placement{1, Vec3(0)}, Placement{1e-4, Vec3(0)}, Placement{1e4, Vec3(0)}, Placement{1, Vec3(1e6, -1e6, 1e6)},
        Placement{1e-3, Vec3(1e6, 2e6, -1e6)}, Placement{1e4, Vec3(-1e6, 1e6, 3e6)}}) {
    for (int trial = 0; trial < 150; ++trial) {
      const Plane plane = random_plane(random, std::pow(10.0, random.between(-2, -0.2)));
      TriangleSoup soup;
      std::vector<Vec2> points;
      shape(plane, random, soup, points);
      add_corners_of_cube(soup);
      for (Vec3& position : soup.positions) {
        position = placement.scale * position + placement.offset;
      }
      const auto visibility = make(soup);
      const auto blocked = answers(*visibility, lifted_segments(plane, random, *visibility, placement, points));
      ASSERT_EQ(std::count(blocked.begin(), blocked.end(), 1), 0)
          << "scale " << placement.scale << ", offset " << placement.offset.x << ", trial " << trial;
    }
  }
}

// One triangle of height 1 / aspect; points inside, on the edges, at the corners.
auto triangle_of_aspect(double most) {
  return [most](const Plane& plane, Random& random, TriangleSoup& soup, std::vector<Vec2>& points) {
    const double height = std::pow(most, -random.between(0, 1));
    const Vec2 corner[3] = {{0, 0}, {1, 0}, {random.between(-0.5, 1.5), height}};
    soup.add(plane.at(0, 0), plane.at(1, 0), plane.at(corner[2].x, height));
    for (int i = 0; i < 60; ++i) {
      double s = i % 5 == 0 ? 0 : random.between(0, 1);
      double t = i % 4 == 0 ? 0 : random.between(0, 1);
      s = s + t > 1 ? 1 - s : s;
      t = s + t > 1 ? 1 - t : t;
      points.push_back(corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0]));
    }
  };
}

// A fan about a point of a square with jagged spokes: triangles of all shapes that share a plane.
void fan(const Plane& plane, Random& random, TriangleSoup& soup, std::vector<Vec2>& points) {
  const Vec2 hub(random.between(0.2, 0.8), random.between(0.2, 0.8));
  const Vec2 square[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<Vec2> rim;
  for (int side = 0; side < 4; ++side) {
    double along = 0;
    while (along < 1) {
      rim.push_back(square[side] + along * (square[(side + 1) % 4] - square[side]));
      along += random.between(0.02, 0.6);
    }
  }
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vec2& next = rim[(i + 1) % rim.size()];
    soup.add(plane.at(hub.x, hub.y), plane.at(rim[i].x, rim[i].y), plane.at(next.x, next.y));
    points.push_back(rim[i]);
    points.push_back(0.5 * (hub + rim[i]));
  }
  for (int i = 0; i < 60; ++i) {
    points.emplace_back(random.between(0, 1), random.between(0, 1));
  }
}

class EmbreeLift : public testing::Test {
 protected:
  void SetUp() override { RADVOR_SKIP_WITHOUT_EMBREE(); }

  auto make() {
    return [this](const TriangleSoup& soup) {
      return std::make_unique<EmbreeVisibility>(library_, soup.occluders(), host_);
    };
  }

  EmbreeLibrary library_{""};
  Host host_ = make_host();
};

TEST_F(EmbreeLift, ClearsTheTriangleItself) {
  expect_unblocked(make(), triangle_of_aspect(100));
}

TEST_F(EmbreeLift, ClearsNeighboursInThePlane) {
  expect_unblocked(make(), fan);
}

// No fixed epsilon: a surface that is closer than a thousandth of the scene still blocks.
TEST_F(EmbreeLift, IsSmall) {
  const TriangleSoup ball = sphere(8, 9);
  EXPECT_GT(EmbreeVisibility(library_, ball.occluders(), host_).lift(), 0);
  EXPECT_LT(EmbreeVisibility(library_, ball.occluders(), host_).lift(), 4e-6);
}

auto make_brute_force() {
  return [](const TriangleSoup& soup) {
    return std::make_unique<BruteForceVisibility>(soup.occluders(), std::pmr::get_default_resource());
  };
}

TEST(BruteForceLift, ClearsTheTriangleItself) {
  expect_unblocked(make_brute_force(), triangle_of_aspect(1000));
}

TEST(BruteForceLift, ClearsNeighboursInThePlane) {
  expect_unblocked(make_brute_force(), fan);
}

}  // namespace
}  // namespace radvor
