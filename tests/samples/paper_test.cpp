// The paper's experiment is judged by an exact answer; here that answer is judged by others.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "exact_shadow.h"
#include "lattice_cells.h"

namespace {

using paper::Experiment;

/// The emitter in many small pieces, those left out that the occluder hides, by its corners' signs alone.
double by_pieces(const Experiment& scene, const glm::dvec2& at, int pieces) {
  const glm::dvec2 low = scene.emitter[0];
  const glm::dvec2 size = scene.emitter[2] - low;
  const double piece_area = size.x * size.y / (pieces * pieces);
  double sum = 0;
  for (int row = 0; row < pieces; ++row) {
    for (int column = 0; column < pieces; ++column) {
      const glm::dvec2 light = low + (glm::dvec2(column, row) + 0.5) / static_cast<double>(pieces) * size;
      const glm::dvec2 crossing = at + (light - at) * (scene.occluder_height / scene.emitter_height);
      bool hidden = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 a = scene.occluder[i];
        const glm::dvec2 side = scene.occluder[(i + 1) % 3] - a;
        hidden = hidden && side.x * (crossing.y - a.y) - side.y * (crossing.x - a.x) > 0;
      }
      if (!hidden) {
        const glm::dvec3 way(light - at, scene.emitter_height);
        const double square = glm::dot(way, way);
        sum += scene.radiance * piece_area * way.z * way.z / (square * square);
      }
    }
  }
  return sum;
}

// J. Howell's catalogue, C-3: differential element to a parallel rectangle, its normal through a corner.
double corner_factor(double a, double b, double height) {
  const double x = a / height, y = b / height;
  const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
}

TEST(Paper, UnoccludedFloorIsTheCatalogues) {
  const Experiment scene = paper::experiment();
  EXPECT_NEAR(scene.unoccluded({0.5, 0.5}), std::numbers::pi * 4 * corner_factor(0.05, 0.05, 1), 1e-14);
  // Below a corner of the emitter: one quadrant.
  EXPECT_NEAR(scene.unoccluded({0.45, 0.45}), std::numbers::pi * corner_factor(0.1, 0.1, 1), 1e-14);
}

TEST(Paper, ShadowIsWhatIsLeftOfTheEmitter) {
  const Experiment scene = paper::experiment();
  int umbra = 0, penumbra = 0, lit = 0;
  for (int i = 0; i < 400; ++i) {
    const glm::dvec2 at(std::fmod(0.754877666 * i, 1.0), std::fmod(0.569840291 * i, 1.0));
    const double exact = scene.irradiance(at);
    const double full = scene.unoccluded(at);
    EXPECT_NEAR(exact, by_pieces(scene, at, 200), 2e-3 * full) << at.x << " " << at.y;
    (exact <= 0 ? umbra : exact < full * (1 - 1e-12) ? penumbra : lit)++;
  }
  EXPECT_GT(umbra, 20);
  EXPECT_GT(penumbra, 20);
  EXPECT_GT(lit, 100);
}

TEST(Paper, ShadowEdgeIsThatOfTheEmittersCentre) {
  const Experiment scene = paper::experiment();
  for (const glm::dvec2& corner : scene.occluder) {
    const glm::dvec2 shadow = glm::dvec2(0.5) + (corner - glm::dvec2(0.5)) / 0.7;
    EXPECT_NEAR(scene.distance_to_shadow_edge(shadow), 0, 1e-12);
    EXPECT_TRUE(shadow.x > 0.1 && shadow.x < 0.9 && shadow.y > 0.1 && shadow.y < 0.9);
  }
}

TEST(Paper, CellsOfALatticeTileTheFloor) {
  for (const std::uint32_t lattice : {RADVOR_LATTICE_HEXAGONAL, RADVOR_LATTICE_QUADRILATERAL}) {
    const double spacing = paper::spacing_for(lattice, 100);
    const paper::Diagram diagram(paper::lattice_sites(lattice, spacing, {0.31, 0.17}));
    EXPECT_NEAR(static_cast<double>(diagram.sites().size()), 100, 12);
    double area = 0;
    for (std::uint32_t site = 0; site < diagram.sites().size(); ++site) {
      const std::vector<glm::dvec2> cell = diagram.cell(site);
      for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
        const glm::dvec2 a = cell[i] - cell[0], b = cell[i + 1] - cell[0];
        area += 0.5 * (a.x * b.y - a.y * b.x);
      }
    }
    EXPECT_NEAR(area, 1, 1e-12);
  }
}

}  // namespace
