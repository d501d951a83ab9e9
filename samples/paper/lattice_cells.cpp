#include "lattice_cells.h"

#include <array>
#include <cmath>
#include <numbers>

namespace paper {

std::vector<glm::dvec2> lattice_sites(std::uint32_t lattice, double spacing, const glm::dvec2& anchor) {
  const bool hexagonal = lattice == RADVOR_LATTICE_HEXAGONAL;
  const double row_height = hexagonal ? spacing * std::numbers::sqrt3 / 2 : spacing;
  const int rows = static_cast<int>(std::ceil(1 / row_height)) + 1;
  std::vector<glm::dvec2> sites;
  for (int row = -rows; row <= rows; ++row) {
    const double shift = hexagonal && row % 2 != 0 ? 0.5 : 0.0;
    for (int column = -rows; column <= rows; ++column) {
      const glm::dvec2 site(anchor.x + (column + shift) * spacing, anchor.y + row * row_height);
      constexpr double k_rounding = 1e-12;  // sites on the square's border belong to it
      if (site.x > -k_rounding && site.x < 1 + k_rounding && site.y > -k_rounding && site.y < 1 + k_rounding) {
        sites.push_back(site);
      }
    }
  }
  return sites;
}

double spacing_for(std::uint32_t lattice, double density) {
  return std::sqrt((lattice == RADVOR_LATTICE_HEXAGONAL ? 2 / std::numbers::sqrt3 : 1) / density);
}

Diagram::Diagram(const std::vector<glm::dvec2>& sites) : sites_(sites), context_(make_context()) {
  radvor_delaunay* delaunay = nullptr;
  check(radvor_delaunay_create(context_.get(), &delaunay), context_.get(), "the triangulation");
  delaunay_.reset(delaunay);
  check(radvor_delaunay_insert_many(delaunay, &sites_.front().x, static_cast<std::uint32_t>(sites_.size()), nullptr),
        context_.get(), "the sites");
}

std::vector<glm::dvec2> Diagram::cell(std::uint32_t site) const {
  constexpr std::array<double, 8> k_square{0, 0, 1, 0, 1, 1, 0, 1};
  std::vector<glm::dvec2> polygon(64);
  auto size = static_cast<std::uint32_t>(polygon.size());
  check(radvor_delaunay_cell(delaunay_.get(), site, k_square.data(), 4, &polygon.front().x, &size, nullptr, nullptr),
        context_.get(), "a cell");
  polygon.resize(size);
  return polygon;
}

std::vector<std::uint32_t> Diagram::triangles() const {
  const std::uint32_t count = radvor_delaunay_triangle_count(delaunay_.get());
  std::vector<std::uint32_t> triangles(3 * std::size_t{count});
  check(radvor_delaunay_triangles(delaunay_.get(), triangles.data(), count), context_.get(), "the triangles");
  return triangles;
}

}  // namespace paper
