#include "figures.h"

#include <algorithm>
#include <random>

#include "canvas.h"
#include "lattice_cells.h"

namespace paper {
namespace {

constexpr std::size_t k_pixels = 400;
constexpr std::size_t k_exact_grid = 400;  // of the exact picture: a square for each pixel

void draw_triangles(Canvas& canvas, const std::vector<glm::dvec2>& sites, const std::vector<std::uint32_t>& triangles) {
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint32_t a = triangles[i + side];
      const std::uint32_t b = triangles[i + (side + 1) % 3];
      const auto twin = [&] {  // inner edges come twice, once each way; those of the hull once
        for (std::size_t j = 0; j < triangles.size(); j += 3) {
          for (std::size_t other = 0; other < 3; ++other) {
            if (triangles[j + other] == b && triangles[j + (other + 1) % 3] == a) {
              return true;
            }
          }
        }
        return false;
      };
      if (a < b || !twin()) {
        canvas.line(sites[a], sites[b], 1, 0);
      }
    }
  }
}

void draw_dots(Canvas& canvas, const std::vector<glm::dvec2>& sites, double radius) {
  for (const glm::dvec2& site : sites) {
    canvas.dot(site, radius, 0);
  }
}

double brightest(const Experiment& experiment) {
  return experiment.unoccluded({0.5, 0.5});
}

void shade(Canvas& canvas, const Floor& floor, double white) {
  for (std::size_t i = 0; i < floor.triangles.size(); i += 3) {
    std::array<glm::dvec2, 3> corners;
    std::array<double, 3> light{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      corners[corner] = floor.sites[floor.triangles[i + corner]];
      light[corner] = floor.irradiance[floor.triangles[i + corner]] / white;
    }
    canvas.triangle(corners, light);
  }
}

void shade_exactly(Canvas& canvas, const Experiment& experiment) {
  const double size = 1.0 / static_cast<double>(k_exact_grid);
  for (std::size_t row = 0; row < k_exact_grid; ++row) {
    for (std::size_t column = 0; column < k_exact_grid; ++column) {
      const glm::dvec2 low(size * static_cast<double>(column), size * static_cast<double>(row));
      const double light = experiment.irradiance(low + 0.5 * size) / brightest(experiment);
      const glm::dvec2 right = low + glm::dvec2(size, 0), up = low + glm::dvec2(0, size);
      canvas.triangle({low, right, low + size}, {light, light, light});
      canvas.triangle({low, low + size, up}, {light, light, light});
    }
  }
}

}  // namespace

void draw_voronoi_and_delaunay(const std::string& file) {
  std::mt19937_64 random(11);
  std::vector<glm::dvec2> sites;
  while (sites.size() < 40) {
    const double x = static_cast<double>(random() >> 11) * 0x1p-53;
    sites.emplace_back(x, static_cast<double>(random() >> 11) * 0x1p-53);
  }
  const Diagram diagram(sites);
  Canvas voronoi(k_pixels), delaunay(k_pixels);
  for (std::uint32_t site = 0; site < sites.size(); ++site) {
    voronoi.outline(diagram.cell(site), 1, 0);
  }
  draw_dots(voronoi, sites, 2);
  draw_triangles(delaunay, sites, diagram.triangles());
  draw_dots(delaunay, sites, 2);
  Canvas::save(file, {&voronoi, &delaunay});
}

void draw_patches_and_elements(const std::string& file) {
  constexpr double k_spacing = 0.25;
  const std::vector<glm::dvec2> patches = lattice_sites(RADVOR_LATTICE_HEXAGONAL, k_spacing, glm::dvec2(0.5));
  const std::vector<glm::dvec2> elements = lattice_sites(RADVOR_LATTICE_HEXAGONAL, k_spacing / 2, glm::dvec2(0.5));
  Canvas canvas(k_pixels);
  const Diagram fine(elements), coarse(patches);
  for (std::uint32_t site = 0; site < elements.size(); ++site) {
    canvas.outline(fine.cell(site), 1, 0.35, true);
  }
  for (std::uint32_t site = 0; site < patches.size(); ++site) {
    canvas.outline(coarse.cell(site), 1.6, 0);
  }
  draw_dots(canvas, elements, 1.2);
  draw_dots(canvas, patches, 3);
  Canvas::save(file, {&canvas});
}

void draw_adaptive_cells(const std::string& file, const Floor& floor) {
  const Diagram diagram(floor.sites);
  Canvas canvas(k_pixels);
  for (std::uint32_t site = 0; site < floor.sites.size(); ++site) {
    canvas.outline(diagram.cell(site), 1, 0);
  }
  draw_dots(canvas, floor.sites, 1.2);
  Canvas::save(file, {&canvas});
}

void draw_wireframes(const std::string& file, const Floor& plain, const Floor& aligned) {
  Canvas left(k_pixels), right(k_pixels);
  draw_triangles(left, plain.sites, plain.triangles);
  draw_triangles(right, aligned.sites, aligned.triangles);
  Canvas::save(file, {&left, &right});
}

void draw_shaded(const std::string& file, const Floor& plain, const Floor& aligned, const Experiment& experiment) {
  Canvas left(k_pixels), middle(k_pixels), right(k_pixels);
  shade(left, plain, brightest(experiment));
  shade(middle, aligned, brightest(experiment));
  shade_exactly(right, experiment);
  Canvas::save(file, {&left, &middle, &right});
}

}  // namespace paper
