#include "surface/triangle_cells.h"

#include <cmath>

namespace radvor {

double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  const double error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  return difference_of_products(ab.x, ac.y, ab.y, ac.x);
}

namespace {

// Centroid of the fan about the first point; the fan's triangles are weighted by what their areas are in exact
// arithmetic, and rounding may make those of needles nonsense: then the mean of the points, which is inside as well.
Vec2 fan_centroid(const CornerCell& cell) {
  const Vec2& site = cell.points[0];
  Vec2 sum(0.0);
  Vec2 mean(0.0);
  double total = 0;
  bool positive = true;
  for (std::uint32_t k = 1; k < cell.count; ++k) {
    mean += cell.points[k] - site;
    if (k + 1 < cell.count) {
      const double area = doubled_area(site, cell.points[k], cell.points[k + 1]);
      positive = positive && area >= 0;
      sum += area / 3.0 * ((cell.points[k] - site) + (cell.points[k + 1] - site));
      total += area;
    }
  }
  return positive && total > 0 ? site + sum / total : site + mean / static_cast<double>(cell.count);
}

// Three bisectors meet inside: each cell is a quadrilateral. weights: barycentric, of the circumcentre.
void acute_cells(const std::array<Vec2, 3>& p, double area, const std::array<double, 3>& weights,
                 std::array<CornerCell, 3>& cells) {
  const Vec2 centre = p[0] + weights[1] * (p[1] - p[0]) + weights[2] * (p[2] - p[0]);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = (k + 1) % 3;
    const std::uint32_t last = (k + 2) % 3;
    cells[k].points = {p[k], 0.5 * (p[k] + p[next]), centre, 0.5 * (p[k] + p[last])};
    cells[k].count = 4;
    cells[k].area = 0.5 * area * (weights[next] + weights[last]);
  }
}

// The angle at corner `o` is obtuse: the bisectors of its two sides end on the opposite side, a to b.
void obtuse_cells(const std::array<Vec2, 3>& p, double area, std::uint32_t o, std::array<CornerCell, 3>& cells) {
  const std::uint32_t a = (o + 1) % 3;
  const std::uint32_t b = (o + 2) % 3;
  const Vec2 side = p[b] - p[a];
  const Vec2 from_a = p[o] - p[a];
  const Vec2 from_b = p[o] - p[b];
  const double near_a = 0.5 * glm::dot(from_a, from_a) / glm::dot(from_a, side);
  const double near_b = -0.5 * glm::dot(from_b, from_b) / glm::dot(from_b, side);
  const Vec2 at_a = p[a] + near_a * side;
  const Vec2 at_b = p[b] - near_b * side;
  const Vec2 middle_a = 0.5 * (p[o] + p[a]);
  const Vec2 middle_b = 0.5 * (p[o] + p[b]);
  cells[o].points = {p[o], middle_a, at_a, at_b, middle_b};
  cells[o].count = 5;
  cells[o].area = area * (1 - 0.5 * near_a - 0.5 * near_b);
  cells[a].points = {p[a], at_a, middle_a};
  cells[a].count = 3;
  cells[a].area = 0.5 * area * near_a;
  cells[b].points = {p[b], middle_b, at_b};
  cells[b].count = 3;
  cells[b].area = 0.5 * area * near_b;
}

}  // namespace

std::array<CornerCell, 3> triangle_cells(const std::array<Vec2, 3>& p) {
  std::array<CornerCell, 3> cells;
  const double doubled = doubled_area(p[0], p[1], p[2]);
  if (!(doubled > 0)) {
    for (CornerCell& cell : cells) {
      cell.centroid = (p[0] + p[1] + p[2]) / 3.0;
    }
    return cells;
  }
  // The circumcentre's barycentric weights are as the squared sides times the cosines opposite to them.
  std::array<double, 3> weights;
  double sum = 0;
  std::uint32_t widest = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec2 next = p[(k + 1) % 3] - p[k];
    const Vec2 last = p[(k + 2) % 3] - p[k];
    const Vec2 opposite = p[(k + 2) % 3] - p[(k + 1) % 3];
    weights[k] = glm::dot(opposite, opposite) * glm::dot(next, last);
    sum += weights[k];
    widest = weights[k] < weights[widest] ? k : widest;
  }
  if (weights[widest] < 0) {
    obtuse_cells(p, 0.5 * doubled, widest, cells);
  } else {
    acute_cells(p, 0.5 * doubled, {weights[0] / sum, weights[1] / sum, weights[2] / sum}, cells);
  }
  for (CornerCell& cell : cells) {
    cell.centroid = fan_centroid(cell);
  }
  return cells;
}

}  // namespace radvor
