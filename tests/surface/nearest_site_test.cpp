// Every point of a facet belongs to the cell of the nearest site that it sees: against brute force.
#include <gtest/gtest.h>

#include <random>

#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor {
namespace {

using test::heap;
using test::MadeSurface;
using test::SceneBuilder;

struct Wall {
  Vec2 a, b;
};

// All of a facet's borders, slits and contacts, from the scene alone.
std::vector<Wall> walls_of(const MadeSurface& made, std::uint32_t facet) {
  std::vector<Wall> walls;
  const Frame& frame = made.facets.facets[facet].frame;
  for (const std::uint32_t triangle : made.facets.triangles_of(facet)) {
    for (const EdgeUse& use : made.welded.uses_of_triangle(triangle)) {
      const EdgeKind kind = made.facets.edge_kinds[use.edge];
      if (kind == EdgeKind::smooth || kind == EdgeKind::sharp) {
        const Edge& edge = made.welded.edges[use.edge];
        walls.push_back({frame.to_plane(made.welded.positions[edge.a]), frame.to_plane(made.welded.positions[edge.b])});
      }
    }
  }
  for (const ContactEdge& contact : made.facets.contacts.of_facet(facet)) {
    const Edge& edge = made.welded.edges[contact.edge];
    walls.push_back({frame.to_plane(made.welded.positions[edge.a]), frame.to_plane(made.welded.positions[edge.b])});
  }
  return walls;
}

bool sees(const std::vector<Wall>& walls, const Vec2& point, const Vec2& site) {
  for (const Wall& wall : walls) {
    const double from = cross(site - point, wall.a - point);
    const double to = cross(site - point, wall.b - point);
    const double near = cross(wall.b - wall.a, point - wall.a);
    const double far = cross(wall.b - wall.a, site - wall.a);
    const double slack = 1e-10;  // sites on walls are beside them by rounding
    if (((from > slack && to < -slack) || (from < -slack && to > slack)) &&
        ((near > slack && far < -slack) || (near < -slack && far > slack))) {
      return false;
    }
  }
  return true;
}

bool contains(const std::vector<Vec2>& polygon, const Vec2& point) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2& a = polygon[k];
    const Vec2& b = polygon[(k + 1) % polygon.size()];
    if ((a.y <= point.y) != (b.y <= point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      inside = !inside;
    }
  }
  return inside;
}

void check(const MadeSurface& made, std::uint32_t facet, std::mt19937& random, int points) {
  const Frame& frame = made.facets.facets[facet].frame;
  const std::vector<Wall> walls = walls_of(made, facet);
  struct Owner {
    Vec2 site;
    std::vector<Vec2> cell;
  };
  std::vector<Owner> owners;
  std::pmr::vector<Vec3> polygon;
  for (std::uint32_t s = 0; s < made.surface.shares().size(); ++s) {
    if (made.surface.shares()[s].facet == facet) {
      Owner& owner = owners.emplace_back();
      owner.site = frame.to_plane(test::site_of(made.surface, s).position);
      made.surface.cell(s, polygon);
      for (const Vec3& p : polygon) {
        owner.cell.emplace_back(glm::dot(p - frame.origin, frame.u), glm::dot(p - frame.origin, frame.v));
      }
    }
  }
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto triangles = made.facets.triangles_of(facet);
  int owned_once = 0;
  for (int trial = 0; trial < points; ++trial) {
    const Triangle& triangle = made.welded.triangles[triangles[random() % triangles.size()]];
    double u = uniform(random);
    double v = uniform(random);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3& a = made.welded.positions[triangle.vertices[0]];
    const Vec3 p = a + u * (made.welded.positions[triangle.vertices[1]] - a) +
                   v * (made.welded.positions[triangle.vertices[2]] - a);
    const Vec2 point(glm::dot(p - frame.origin, frame.u), glm::dot(p - frame.origin, frame.v));
    double nearest = 1e300;
    for (const Owner& owner : owners) {
      const double distance = glm::distance(owner.site, point);
      if (distance < nearest && sees(walls, point, owner.site)) {
        nearest = distance;
      }
    }
    int count = 0;
    for (const Owner& owner : owners) {
      if (contains(owner.cell, point)) {
        ++count;
        EXPECT_NEAR(glm::distance(owner.site, point), nearest, 1e-9) << "facet " << facet;
      }
    }
    owned_once += count == 1 ? 1 : 0;
  }
  EXPECT_GE(owned_once, points - points / 500) << "facet " << facet;  // rounding at the cells' borders
}

void check_all(const MadeSurface& made, int points) {
  std::mt19937 random(11);
  test::audit(made);
  for (std::uint32_t facet = 0; facet < made.facets.facets.size(); ++facet) {
    check(made, facet, random, points);
  }
}

TEST(NearestSite, InConcaveFacetsWithHoles) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 24; ++trial) {
    SceneBuilder builder(heap());
    std::vector<Vec2> outer, inner;
    test::random_rings(random, 4 + static_cast<std::size_t>(trial) / 2, outer, inner);
    builder.prism(outer, inner, 0.5f);
    check_all(MadeSurface(builder.take(), {Lattice::hexagonal, trial % 2 ? 5.0 : 0.2, 1, 0}), 300);
  }
}

TEST(NearestSite, InTheLShapedRoom) {
  SceneBuilder builder(heap());
  test::l_shaped_room(builder);
  check_all(MadeSurface(builder.take(), {Lattice::quadrilateral, 0.5, 1, 0}), 1000);
}

TEST(NearestSite, InTrianglesWithObtuseCornersAndNeedles) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  SceneBuilder builder(heap());
  for (int k = 0; k < 60; ++k) {
    const double flatness = k % 3 == 0 ? 1 : k % 3 == 1 ? 0.05 : 1e-4;
    const auto point = [&] {
      const double along = uniform(random);
      return Vec3(3.0 * k + along, 0.7 * along + flatness * uniform(random), 0.3 * k);
    };
    builder.triangle(point(), point(), point());
  }
  check_all(MadeSurface(builder.take(), {Lattice::hexagonal, 0.9, 1, 0}), 300);
}

TEST(NearestSite, AroundAWallWithoutThickness) {
  for (const double spacing : {0.5, 4.0}) {
    SceneBuilder builder(heap());
    test::floor_with_wall(builder);
    check_all(MadeSurface(builder.take(), {Lattice::hexagonal, spacing, 1, 0}), 2000);
  }
}

TEST(NearestSite, AroundBoxesThatStandOnAndCutThroughEachOther) {
  for (const double spacing : {0.4, 3.0}) {
    SceneBuilder builder(heap());
    test::room_with_boxes(builder);
    builder.begin_mesh();
    builder.box({1, 1.5, 0.5}, {2.5, 1.8, 5}, false);  // through the standing box, the floating one and the ceiling
    const MadeSurface made(builder.take(), {Lattice::hexagonal, spacing, 1, 0});
    EXPECT_GT(made.facets.contacts.edges.size(), 20u);
    check_all(made, 2000);
  }
}

}  // namespace
}  // namespace radvor
