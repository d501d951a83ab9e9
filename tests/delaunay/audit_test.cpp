// The audit itself: whatever is put out of order behind the triangulation's back, it finds.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "base/error.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {
namespace {

// Spoils something, and expects the audit to say so.
void expect_found(const Triangulation& d, const char* words, const std::function<void()>& spoil) {
  ASSERT_NO_THROW(d.validate());
  spoil();
  try {
    d.validate();
    FAIL() << "not found: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::internal);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

Vec2& position_of(Triangulation& d, VertexId v) {
  return const_cast<Vec2&>(d.positions()[v]);
}

// A lattice of 5 x 5 with a border around its middle, a removed vertex, and what lies behind it.
class Audited : public ::testing::Test {
 protected:
  Audited() : d_(std::pmr::new_delete_resource()) {
    for (int i = 0; i < 25; ++i) {
      d_.insert(Vec2(i / 5, i % 5));
    }
    d_.constrain(6, 8, constraint::k_border);
    d_.constrain(8, 18, constraint::k_border);
    d_.constrain(18, 16, constraint::k_border);
    d_.constrain(16, 6, constraint::k_border);
    d_.mark_domain();
    d_.remove(24);
    d_.remove(d_.insert(Vec2(0.25, 0.125)));  // eighths are on the lattice from now on
  }

  Mesh& mesh() { return const_cast<Mesh&>(d_.mesh()); }
  Vec2& position(VertexId v) { return position_of(d_, v); }
  HalfEdge edge(VertexId a, VertexId b) const {
    const HalfEdge h = d_.find_edge(a, b);
    EXPECT_NE(h, k_none);
    return h;
  }
  void finds(const char* words, const std::function<void()>& spoil) { expect_found(d_, words, spoil); }

  Triangulation d_;
};

TEST_F(Audited, twins_that_are_not) {
  finds("another neighbour", [&] { mesh().write(triangle_of(edge(0, 1))).twin[corner_of(edge(0, 1))] = edge(12, 13); });
}

TEST_F(Audited, a_corner_twice) {
  finds("a corner twice", [&] {
    auto& corners = mesh().write(0).vertex;
    corners[0] = corners[1];
  });
}

TEST_F(Audited, a_vertex_that_lost_its_star) {
  finds("not its own", [&] { mesh().set_out(12, edge(13, 12)); });
}

TEST_F(Audited, a_constraint_of_one_side) {
  finds("two opinions", [&] { mesh().write(triangle_of(edge(6, 7))).constraint[corner_of(edge(6, 7))] = 0; });
}

TEST_F(Audited, a_domain_without_a_border) {
  finds("where no border is", [&] { mesh().set_constraint(edge(6, 7), constraint::k_discontinuous); });
}

TEST_F(Audited, a_state_out_of_the_blue) {
  d_.unmark_domain();
  finds("state", [&] {
    for (TriangleId t = 0; t < d_.triangle_bound(); ++t) {
      mesh().set_state(t, static_cast<std::uint8_t>(mesh().state(t) | Triangle::k_outside));
    }
  });
}

TEST_F(Audited, a_tie_against_the_canonical_choice) {
  finds("not canonical", [&] {
    const HalfEdge sides[] = {edge(1, 2), d_.twin(edge(1, 2))};
    for (const HalfEdge side : sides) {  // one of the two squares beside it has its diagonal here
      for (HalfEdge h = next(side); h != side; h = next(h)) {
        if (d_.lies_on_circle(h)) {
          mesh().flip(h);
          return;
        }
      }
    }
  });
}

TEST_F(Audited, an_edge_that_is_not_delaunay) {
  finds("locally Delaunay", [&] { position(12).x += 0.25; });
}

TEST_F(Audited, a_vertex_beside_the_lattice) {
  finds("not on the lattice", [&] { position(0) += Vec2(0x1p-40, 0); });
}

TEST_F(Audited, a_coordinate_out_of_range) {
  finds("out of range", [&] { position(0).x = -0x1p201; });
}

TEST_F(Audited, a_free_record_in_use) {
  finds("free", [&] {
    mesh().set_state(mesh().first_free(), 0);
    mesh().write(triangle_of(edge(0, 1))).state = Triangle::k_free;
  });
}

TEST(audit, a_triangle_turned_over) {
  Triangulation d(std::pmr::new_delete_resource());
  for (const Vec2 p : {Vec2(0, 0), Vec2(4, 0), Vec2(0, 4)}) {
    d.insert(p);
  }
  expect_found(d, "counter-clockwise", [&] { position_of(d, 2) = Vec2(0, -4); });
}

TEST(audit, a_hull_with_a_dent) {
  Triangulation d(std::pmr::new_delete_resource());
  for (const Vec2 p : {Vec2(0, 0), Vec2(4, 0), Vec2(2, 4), Vec2(2, -0.5)}) {
    d.insert(p);
  }
  expect_found(d, "not convex", [&] { position_of(d, 3) = Vec2(2, 0.5); });
}

TEST(audit, two_vertices_at_one_place_of_a_chain) {
  Triangulation d(std::pmr::new_delete_resource());
  for (int i = 0; i < 5; ++i) {
    d.insert(Vec2(i, 2 * i));
  }
  expect_found(d, "at one place", [&] { position_of(d, 2) = d.position(3); });
}

}  // namespace
}  // namespace radvor::delaunay
