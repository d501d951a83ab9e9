// Where points are, also where walks go astray.
#include <gtest/gtest.h>

#include <cmath>

#include "delaunay/triangulation.h"

namespace radvor::delaunay {
namespace {

// Is the answer true, by the signs alone?
void expect_true(const Triangulation& d, Vec2 point, const Location& at) {
  const auto side = [&](VertexId a, VertexId b) {
    return orientation(d.position(a), d.position(b), point, d.lattice());
  };
  const auto& v = at.vertices;
  switch (at.where) {
    case Where::vertex:
      EXPECT_EQ(d.position(v[0]), point);
      break;
    case Where::edge:
      EXPECT_NE(d.find_edge(v[0], v[1]), k_none);
      EXPECT_EQ(side(v[0], v[1]), 0);
      EXPECT_EQ(lexicographically_less(d.position(v[0]), point), lexicographically_less(point, d.position(v[1])));
      break;
    case Where::triangle:
      EXPECT_GT(side(v[0], v[1]), 0);
      EXPECT_GT(side(v[1], v[2]), 0);
      EXPECT_GT(side(v[2], v[0]), 0);
      break;
    case Where::outside:
      ADD_FAILURE() << point.x << ", " << point.y << " is inside of the hull";
  }
}

// Spokes that lean the same way around a diamond: a visibility walk to a point in the middle crosses one after the
// other and comes round to where it was. Both ways round, towards vertices, edges and triangles.
TEST(locate, a_pinwheel_does_not_turn_for_ever) {
  for (const double mirror : {1.0, -1.0}) {
    Triangulation d(std::pmr::new_delete_resource());
    VertexId inner[4], outer[4];
    Vec2 p(2, 0), q(6, 2);
    for (int i = 0; i < 4; ++i) {
      inner[i] = d.insert(Vec2(p.x, mirror * p.y));
      outer[i] = d.insert(Vec2(q.x, mirror * q.y));
      p = Vec2(-p.y, p.x);
      q = Vec2(-q.y, q.x);
    }
    for (int i = 0; i < 4; ++i) {
      d.constrain(inner[i], inner[(i + 1) % 4], constraint::k_discontinuous);
      d.constrain(inner[i], outer[i], constraint::k_discontinuous);
      d.constrain(inner[i], outer[(i + 1) % 4], constraint::k_discontinuous);
    }
    for (const Vec2 more : {Vec2(0, 0), Vec2(0.5, 0), Vec2(0, 0.25), Vec2(-0.25, -0.5)}) {
      for (int i = -16; i <= 16; ++i) {
        for (int j = -16; j <= 16; ++j) {
          const Vec2 point(i / 16.0, j / 16.0);
          for (int start = 0; start < 4; ++start) {
            VertexId hint = outer[start];
            expect_true(d, point, d.locate(point, &hint));
          }
        }
      }
      d.insert(more);
    }
    d.validate();
  }
}

}  // namespace
}  // namespace radvor::delaunay
