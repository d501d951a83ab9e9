// The Voronoi cells of a triangle's three corners within the triangle, in closed form: what a facet that is a single
// small triangle has instead of a triangulation.
//
//        2                       2 . _                          an obtuse corner's cell reaches the long side
//       / \                       \    ' .  _
//      m   m       acute           m        m ' - . _          obtuse at 0: the bisectors of its sides meet the
//     /  c  \                       \      /          ' .      long side at p and q
//    0---m---1                       0-m--q-p---...     1
//
// Areas come from ratios of the triangle's area, so that they sum to it whatever the triangle's shape.
#pragma once

#include <array>
#include <cstdint>

#include "base/vector.h"

namespace radvor {

struct CornerCell {
  std::array<Vec2, 5> points;  ///< counter-clockwise, the corner first
  std::uint32_t count = 0;     ///< 3 to 5; 0 where the triangle has no area
  double area = 0;
  Vec2 centroid{0.0};
};

/// a * b - c * d within 1.5 ulp of its value (Kahan's algorithm; Jeannerod, Louvet and Muller, 2013).
double difference_of_products(double a, double b, double c, double d);

/// Twice the signed area of a triangle, to rounding wherever the differences of its coordinates are exact.
double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c);

/// Cells of a counter-clockwise triangle's corners; all empty, with the triangle's centroid, where its area is not
/// positive.
std::array<CornerCell, 3> triangle_cells(const std::array<Vec2, 3>& corners);

}  // namespace radvor
