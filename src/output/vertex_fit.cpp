#include "output/vertex_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "output/mesh_facets.h"
#include "output/source_triangles.h"

namespace radvor {
namespace {

/// Two triangles have at most 6 corners in common.
struct Piece {
  std::array<Vec2, 6> points;
  std::size_t count = 0;
};

/// The part of a convex polygon on the left of the line from a to b (Sutherland & Hodgman 1974).
Piece clip(const Piece& polygon, const Vec2& a, const Vec2& b) {
  Piece inside;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec2& here = polygon.points[i];
    const Vec2& next = polygon.points[(i + 1) % polygon.count];
    const double side_here = cross(b - a, here - a);
    const double side_next = cross(b - a, next - a);
    if (side_here >= 0 && inside.count < inside.points.size()) {
      inside.points[inside.count++] = here;
    }
    if ((side_here < 0) != (side_next < 0) && side_here != 0 && side_next != 0 && inside.count < inside.points.size()) {
      inside.points[inside.count++] = here + side_here / (side_here - side_next) * (next - here);
    }
  }
  return inside;
}

Piece intersection(const std::array<Vec2, 3>& one, const std::array<Vec2, 3>& other) {
  Piece piece;
  std::ranges::copy(one, piece.points.begin());
  piece.count = 3;
  for (std::size_t i = 0; i < 3 && piece.count > 0; ++i) {
    piece = clip(piece, other[i], other[(i + 1) % 3]);
  }
  return piece;
}

/// The quadratic form of the fit. With x the vertices' values and L the light, half its gradient is M x - b, where
/// M = sum over triangles of area / 12 * [2 1 1; 1 2 1; 1 1 2] and b = integral of (vertex's hat function times L).
class Fit {
 public:
  Fit(const LitSurface& lit, Quantity quantity, bool back, std::span<const Color> start)
      : lit_(lit),
        quantity_(quantity),
        back_(back),
        start_(start),
        elements_(&lit.host.memory),
        diagonal_(start.size(), 0.0, &lit.host.memory),
        pull_(start.size(), Color(0.0), &lit.host.memory) {}

  void add_facet(std::uint32_t facet) {
    const Surface& surface = lit_.surface;
    const SourceTriangles sources(surface, facet, &lit_.host.memory);
    for (const SourceTriangle& source : sources.all()) {
      const double area = std::max(source.area(), 0.0);
      elements_.push_back({surface.welded().triangles[source.triangle].corners, area});
      for (const std::uint32_t vertex : elements_.back().vertices) {
        diagonal_[vertex] += area / 6;
      }
    }
    const Frame& frame = surface.facets().facets[facet].frame;
    for (const ShareTriangle& shares : surface.triangles(facet)) {
      SourceTriangle lit_triangle{};  // its weights interpolate the light
      std::array<Color, 3> light;
      for (std::size_t i = 0; i < 3; ++i) {
        const Share& share = surface.shares()[shares[i]];
        lit_triangle.corners[i] = frame.to_plane(surface.sites()[surface.samples()[share.sample].site].position);
        light[i] = corner_value(lit_, quantity_, back_ ? share.other_side : shares[i]);
      }
      if (lit_triangle.area() <= 0) {
        continue;  // too thin for its own arithmetic, and for any weight
      }
      if (sources.all().size() == 1) {
        add_piece({{lit_triangle.corners[0], lit_triangle.corners[1], lit_triangle.corners[2]}, 3},
                  sources.all().front(), lit_triangle, light);
        continue;
      }
      sources.for_each_near(plane_box(lit_triangle.corners), [&](const SourceTriangle& source) {
        add_piece(intersection(lit_triangle.corners, source.corners), source, lit_triangle, light);
      });
    }
  }

  /// Projected gradient steps with Nesterov's momentum. Scaled by its diagonal, M has eigenvalues between 1/2 and 2
  /// whatever the triangles (Wathen 1987): a step of half the inverse diagonal never overshoots, the best momentum is
  /// (sqrt(4) - 1) / (sqrt(4) + 1), and every step halves the excess of the squared difference (Nesterov 2004, 2.2).
  void solve(std::pmr::vector<Color>& values) const {
    constexpr int k_steps = 64;
    constexpr double k_momentum = 1.0 / 3.0;
    std::pmr::memory_resource* memory = &lit_.host.memory;
    std::pmr::vector<Color> ahead(values, memory);
    std::pmr::vector<Color> slope(values.size(), memory);
    for (int step = 0; step < k_steps; ++step) {
      gradient(ahead, slope);
      double largest = 0;
      double largest_change = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (diagonal_[i] == 0) {
          continue;
        }
        const Color next = max(ahead[i] - slope[i] / (2.0 * diagonal_[i]), Color(0.0));
        const Color change = next - values[i];
        ahead[i] = next + k_momentum * change;
        values[i] = next;
        for (glm::length_t k = 0; k < 3; ++k) {
          largest = std::max(largest, next[k]);
          largest_change = std::max(largest_change, std::abs(change[k]));
        }
      }
      if (largest_change <= 0x1p-32 * largest) {
        return;
      }
    }
  }

 private:
  struct Element {
    std::array<std::uint32_t, 3> vertices;
    double area;
  };

  /// b is kept as what it adds to M times the start: the integral of (hat function times (L - the start)). Where the
  /// adaptive mesh leaves a gap, by rounding or by repair, the start then stands in for the light.
  void add_piece(const Piece& piece, const SourceTriangle& source, const SourceTriangle& lit_triangle,
                 const std::array<Color, 3>& light) {
    if (source.area() <= 0) {
      return;
    }
    const auto& vertices = lit_.surface.welded().triangles[source.triangle].corners;
    for (std::size_t fan = 2; fan < piece.count; ++fan) {
      const std::array<Vec2, 3> part = {piece.points[0], piece.points[fan - 1], piece.points[fan]};
      const double area = 0.5 * cross(part[1] - part[0], part[2] - part[0]);
      for (std::size_t i = 0; i < 3; ++i) {  // midpoints of edges are exact for quadratics
        const Vec2 middle = 0.5 * (part[i] + part[(i + 1) % 3]);
        const auto to_light = lit_triangle.weights(middle);
        const auto to_vertices = source.weights(middle);
        Color difference{0.0};
        for (std::size_t k = 0; k < 3; ++k) {
          difference += to_light[k] * light[k] - to_vertices[k] * start_[vertices[k]];
        }
        for (std::size_t k = 0; k < 3; ++k) {
          pull_[vertices[k]] += area / 3 * to_vertices[k] * difference;
        }
      }
    }
  }

  void gradient(std::span<const Color> values, std::span<Color> slope) const {
    for (std::size_t i = 0; i < values.size(); ++i) {
      slope[i] = -pull_[i];
    }
    for (const Element& element : elements_) {
      std::array<Color, 3> moved;
      for (std::size_t k = 0; k < 3; ++k) {
        moved[k] = values[element.vertices[k]] - start_[element.vertices[k]];
      }
      const Color sum = moved[0] + moved[1] + moved[2];
      for (std::size_t k = 0; k < 3; ++k) {
        slope[element.vertices[k]] += element.area / 12 * (sum + moved[k]);
      }
    }
  }

  const LitSurface& lit_;
  Quantity quantity_;
  bool back_;
  std::span<const Color> start_;
  std::pmr::vector<Element> elements_;
  std::pmr::vector<double> diagonal_;
  std::pmr::vector<Color> pull_;
};

}  // namespace

void fit_vertices(const LitSurface& lit, std::uint32_t mesh, Quantity quantity, bool back,
                  std::pmr::vector<Color>& values) {
  const std::pmr::vector<Color> start(values, &lit.host.memory);
  Fit fit(lit, quantity, back, start);
  const FacetRange range = facets_of_mesh(lit.surface.facets(), mesh);
  for (std::uint32_t facet = range.first; facet < range.last; ++facet) {
    if (!back || two_sided(lit.surface, facet)) {
      fit.add_facet(facet);
    }
  }
  fit.solve(values);
}

}  // namespace radvor
