// Lattices and border sites: exact, nested, the same from all sides.
#include "surface/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "surface/border.h"
#include "surface/interior_sites.h"

namespace radvor {
namespace {

constexpr Lattice k_both[] = {Lattice::hexagonal, Lattice::quadrilateral};

bool multiple_of(double value, double unit) {
  return std::fmod(value, unit) == 0;
}

TEST(Lattice, AllCoordinatesAreMultiplesOfOneDyadicNumberDownToTheTwelfthLevel) {
  for (const Lattice kind : k_both) {
    const FacetLattice lattice(kind, 0.337, {1234.567, -0.01});
    int exponent = 0;
    ASSERT_EQ(std::frexp(lattice.quantum(), &exponent), 0.5);
    for (std::uint32_t level = 0; level <= 12; ++level) {
      for (const std::int64_t k : {-100001, -3, 0, 1, 7, 65537}) {
        const Vec2 point = lattice.point(level, {k, 3 * k + 1});
        EXPECT_TRUE(multiple_of(point.x, lattice.quantum()));
        EXPECT_TRUE(multiple_of(point.y, lattice.quantum()));
      }
    }
  }
}

TEST(Lattice, ALevelContainsTheOneBefore) {
  for (const Lattice kind : k_both) {
    const FacetLattice lattice(kind, 0.7, {0.1, 0.2});
    for (std::uint32_t level = 0; level < 12; ++level) {
      for (std::int64_t i = -5; i <= 5; ++i) {
        for (std::int64_t j = -5; j <= 5; ++j) {
          EXPECT_EQ(lattice.point(level, {i, j}), lattice.point(level + 1, {2 * i, 2 * j}));
          EXPECT_LE(FacetLattice::coarsest_level(level + 1, {2 * i, 2 * j}), level);
          EXPECT_EQ(FacetLattice::coarsest_level(level, {2 * i + 1, j}), level);
        }
      }
    }
  }
}

TEST(Lattice, NeighboursAreAtTheSpacing) {
  const FacetLattice hexagonal(Lattice::hexagonal, 0.3, {0, 0});
  const Vec2 centre = hexagonal.point(2, {3, 5});
  const LatticeIndex around[] = {{4, 5}, {3, 6}, {2, 6}, {2, 5}, {3, 4}, {4, 4}};
  for (const LatticeIndex& index : around) {
    EXPECT_NEAR(glm::distance(centre, hexagonal.point(2, index)), 0.3 / 4, 0.3 / 4 * 5e-4);
  }
}

TEST(Lattice, FourNeighboursOnTheQuadrilateralLatticeAreAnExactTie) {
  const FacetLattice lattice(Lattice::quadrilateral, 0.123456789, {17.3, -2.9});
  const Vec2 a = lattice.point(3, {10, 20});
  const Vec2 c = lattice.point(3, {11, 21});
  EXPECT_EQ(lattice.point(3, {11, 20}), Vec2(c.x, a.y));
  EXPECT_EQ(lattice.point(3, {10, 21}), Vec2(a.x, c.y));
  EXPECT_EQ(c.x - a.x, c.y - a.y);
}

TEST(InteriorSites, AreThoseInsideAndClearOfTheBorder) {
  // A square with a square hole and a slit, against a direct test of every lattice point.
  const std::vector<Segment> outline = {{{0, 0}, {4, 0}}, {{4, 0}, {4, 4}}, {{4, 4}, {0, 4}}, {{0, 4}, {0, 0}},
                                        {{1, 1}, {1, 2}}, {{1, 2}, {2, 2}}, {{2, 2}, {2, 1}}, {{2, 1}, {1, 1}}};
  const std::vector<Segment> slit = {{{2.5, 2.5}, {3.7, 3.1}}};
  const auto distance = [](const Segment& s, const Vec2& p) {
    const Vec2 along = s.b - s.a;
    const double part = std::clamp(glm::dot(p - s.a, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(p, s.a + part * along);
  };
  for (const Lattice kind : k_both) {
    const FacetLattice lattice(kind, 0.61, {1.9, 2.1});
    const double clearance = 0.077;
    std::pmr::vector<LatticeIndex> sites;
    find_interior_sites(lattice, 2, outline, slit, clearance, sites, std::pmr::get_default_resource());
    std::vector<std::pair<std::int64_t, std::int64_t>> found;
    for (const LatticeIndex& index : sites) {
      found.emplace_back(index.j, index.i);
    }
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    std::vector<std::pair<std::int64_t, std::int64_t>> expected;
    for (std::int64_t j = -60; j <= 60; ++j) {
      for (std::int64_t i = -90; i <= 90; ++i) {
        const Vec2 p = lattice.point(2, {i, j});
        const bool inside = p.x > 0 && p.x < 4 && p.y > 0 && p.y < 4 && !(p.x > 1 && p.x < 2 && p.y > 1 && p.y < 2);
        double nearest = distance(slit[0], p);
        for (const Segment& segment : outline) {
          nearest = std::min(nearest, distance(segment, p));
        }
        if (inside && nearest >= clearance) {
          expected.emplace_back(j, i);
        }
      }
    }
    EXPECT_GT(expected.size(), 300u);
    EXPECT_EQ(found, expected);
  }
}

TEST(EdgeSites, RunFromTheMiddleOutward) {
  const EdgeSites sites({0, 0, 0}, {1, 0, 0}, 0.125);
  ASSERT_EQ(sites.count(), 7u);
  for (std::uint32_t k = 0; k < 7; ++k) {
    EXPECT_EQ(sites.position(k), Vec3(0.125 * (k + 1), 0, 0));
  }
}

TEST(EdgeSites, LeaveAtLeastHalfTheSpacingAtTheEnds) {
  for (const double length : {0.3, 0.99, 1.0, 1.01, 1.9, 2.0, 2.1, 3.0, 17.3, 1000.0}) {
    const EdgeSites sites({0, 0, 0}, {0, length, 0}, 1.0);
    if (sites.count() == 0) {
      EXPECT_LT(length, 1.0);
      continue;
    }
    EXPECT_EQ(sites.count() % 2, 1u);
    const double gap = sites.position(0).y;
    EXPECT_GE(gap, 0.4999);
    EXPECT_LT(gap, 1.5);
    EXPECT_NEAR(length - sites.position(sites.count() - 1).y, gap, 1e-12 * length);
    for (std::uint32_t k = 1; k < sites.count(); ++k) {
      EXPECT_NEAR(sites.position(k).y - sites.position(k - 1).y, 1.0, 1e-12 * length);
    }
  }
}

TEST(EdgeSites, AnEdgeWithoutLengthHasNone) {
  EXPECT_EQ(EdgeSites({1, 2, 3}, {1, 2, 3}, 0.1).count(), 0u);
}

}  // namespace
}  // namespace radvor
