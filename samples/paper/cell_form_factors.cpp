#include "cell_form_factors.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "lattice_cells.h"

namespace paper {
namespace {

constexpr double k_pi = std::numbers::pi;

/// A regular polygon of area 1 around the origin, counter-clockwise from above.
std::vector<glm::dvec3> unit_cell(int sides) {
  const double step = 2 * k_pi / sides;
  const double radius = std::sqrt(2 / (sides * std::sin(step)));
  std::vector<glm::dvec3> corners;
  corners.reserve(static_cast<std::size_t>(sides));
  for (int i = 0; i < sides; ++i) {
    corners.emplace_back(radius * std::cos(step * i), radius * std::sin(step * i), 0);
  }
  return corners;
}

/// J. Wallace, K. Elmquist and E. Haines, "A ray tracing algorithm for progressive radiosity" (1989), equation 4: from
/// a point to a disk that faces along (0, 0, 1), as seen from above it.
double disk_form_factor(const glm::dvec3& point, const glm::dvec3& normal, const glm::dvec3& centre, double area) {
  const glm::dvec3 way = centre - point;
  const double square = glm::dot(way, way);
  const double cosines = -way.z * glm::dot(way, normal) / square;
  return area * std::max(0.0, cosines) / (k_pi * square + area);
}

double rms_of_disk(int sides, double distance) {
  constexpr int k_directions = 4000;
  const std::vector<glm::dvec3> cell = unit_cell(sides);
  double squares = 0;
  for (int i = 0; i < k_directions; ++i) {  // a spiral: uniform over the hemisphere, free of the cell's symmetries
    const double z = (i + 0.5) / k_directions;
    const double angle = k_pi * (3 - std::sqrt(5.0)) * i;
    const double ring = std::sqrt(1 - z * z);
    const glm::dvec3 direction(ring * std::cos(angle), ring * std::sin(angle), z);
    const glm::dvec3 point = distance * direction;
    const double exact = form_factor(point, -direction, cell);
    const double error = disk_form_factor(point, -direction, glm::dvec3(0), 1) / exact - 1;
    squares += error * error / k_directions;
  }
  return std::sqrt(squares);
}

/// Three numbers of 0 to 1, as random as they need be and the same everywhere.
glm::dvec3 random_point(std::mt19937_64& random) {
  glm::dvec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    point[axis] = static_cast<double>(random() >> 11) * 0x1p-53;
  }
  return point;
}

std::vector<glm::dvec3> receivers_above() {
  constexpr int k_receivers = 100;
  std::mt19937_64 random(7);
  std::vector<glm::dvec3> receivers;
  receivers.reserve(k_receivers);
  for (int i = 0; i < k_receivers; ++i) {
    receivers.push_back(random_point(random) * glm::dvec3(1, 1, 0.4) + glm::dvec3(0, 0, 0.1));
  }
  return receivers;
}

struct Gathered {
  std::vector<double> disk, polygon;
};

double area_of(const std::vector<glm::dvec2>& polygon) {
  double doubled = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2& a = polygon[i];
    const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
    doubled += a.x * b.y - a.y * b.x;
  }
  return doubled / 2;
}

/// Receivers look down; the radiosity of a cell is that at its site.
Gathered gather(const Experiment& experiment, const std::vector<glm::dvec2>& sites,
                const std::vector<glm::dvec3>& receivers) {
  const Diagram diagram(sites);
  Gathered gathered{std::vector<double>(receivers.size()), std::vector<double>(receivers.size())};
  const glm::dvec3 down(0, 0, -1);
  for (std::uint32_t site = 0; site < sites.size(); ++site) {
    const double radiosity = experiment.irradiance(sites[site]);
    const std::vector<glm::dvec2> cell = diagram.cell(site);
    std::vector<glm::dvec3> corners;
    corners.reserve(cell.size());
    for (const glm::dvec2& corner : cell) {
      corners.emplace_back(corner, 0);
    }
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const glm::dvec3& point = receivers[i];
      gathered.disk[i] += radiosity * disk_form_factor(point, down, {sites[site], 0}, area_of(cell));
      gathered.polygon[i] += radiosity * form_factor(point, down, corners);
    }
  }
  return gathered;
}

double relative_mean_square(const std::vector<double>& values, const std::vector<double>& truth) {
  double squares = 0, mean = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    squares += (values[i] - truth[i]) * (values[i] - truth[i]);
    mean += truth[i];
  }
  return squares * static_cast<double>(values.size()) / (mean * mean);
}

TiledFloorRow::Error error_of(const Experiment& experiment, std::uint32_t lattice, double cells,
                              const std::vector<glm::dvec3>& receivers, const std::vector<double>& truth) {
  constexpr int k_placements = 16;
  const double spacing = spacing_for(lattice, cells);
  std::mt19937_64 random(16);
  double disk = 0, polygon = 0;
  for (int i = 0; i < k_placements; ++i) {
    const std::vector<glm::dvec2> sites = lattice_sites(lattice, spacing, glm::dvec2(random_point(random)) * spacing);
    const Gathered gathered = gather(experiment, sites, receivers);
    disk += relative_mean_square(gathered.disk, truth) / k_placements;
    polygon += relative_mean_square(gathered.polygon, truth) / k_placements;
  }
  return {std::sqrt(disk), std::sqrt(polygon)};
}

}  // namespace

std::vector<SingleCellRow> single_cells() {
  std::vector<SingleCellRow> rows;
  for (const double distance : {0.75, 1.0, 1.5, 2.0, 4.0, 8.0}) {
    rows.push_back({distance, rms_of_disk(6, distance), rms_of_disk(4, distance)});
  }
  return rows;
}

std::vector<TiledFloorRow> tiled_floors(const Experiment& experiment) {
  constexpr double k_reference_cells = 40'000;
  constexpr std::uint32_t k_hexagons = RADVOR_LATTICE_HEXAGONAL;
  constexpr std::uint32_t k_squares = RADVOR_LATTICE_QUADRILATERAL;
  const std::vector<glm::dvec3> receivers = receivers_above();
  const std::vector<glm::dvec2> fine =
      lattice_sites(k_hexagons, spacing_for(k_hexagons, k_reference_cells), glm::dvec2(0.5));
  const std::vector<double> truth = gather(experiment, fine, receivers).polygon;
  std::vector<TiledFloorRow> rows;
  for (const double cells : {64.0, 256.0, 1024.0}) {
    rows.push_back({cells, error_of(experiment, k_hexagons, cells, receivers, truth),
                    error_of(experiment, k_squares, cells, receivers, truth)});
  }
  return rows;
}

}  // namespace paper
