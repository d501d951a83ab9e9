// The paper's experiment: a unit floor, a 0.1 x 0.1 emitter at height 1 above its centre, a triangle at height 0.3
// between them. Prints the tables of docs/paper.md and, where a folder is named, draws its pictures there.
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "cell_form_factors.h"
#include "figures.h"
#include "floor_bake.h"
#include "floor_error.h"

namespace paper {
namespace {

constexpr double k_coarse_cell = 1.0 / 8;
constexpr std::size_t k_points = 200'000;
// The library's default. Far below it every cell of the first meshes asks for more, and the sites are spent before the
// shadow has its share.
constexpr float k_tolerance = 0.02f;
constexpr float k_min_spacing = 1.0f / 128;
constexpr std::uint32_t k_paper_sites = 341;

/// 9 x 9 elements (5 x 5 patches), refined where the light asks for it.
radvor_bake_options adaptive(std::uint32_t sites, std::uint32_t lattice) {
  radvor_bake_options options{};
  options.lattice = lattice;
  options.tolerance = k_tolerance;
  options.patch_spacing = static_cast<float>(2 * k_coarse_cell);
  options.element_levels = 1;
  options.min_spacing = k_min_spacing;
  options.max_sites = sites;
  options.disable = RADVOR_DISABLE_INTERSECTIONS;
  return options;
}

/// About so many sites, the border's among them: the lattice lies about the floor's centre, so rows come in pairs.
radvor_bake_options uniform(double sites, std::uint32_t lattice) {
  radvor_bake_options options{};
  options.lattice = lattice;
  options.tolerance = k_tolerance;
  const double rows = 2 * std::round((std::sqrt(sites) - 1) / 2);
  const double shape = lattice == RADVOR_LATTICE_HEXAGONAL ? 1.0745699318235418 : 1;  // sqrt(2 / sqrt(3))
  options.patch_spacing = static_cast<float>(2 * shape / rows);
  options.element_levels = 1;
  options.min_spacing = options.patch_spacing / 2;
  // Nothing touches here; but where cells are larger than the occluder's height its outline would be taken in.
  options.disable = RADVOR_DISABLE_REFINEMENT | RADVOR_DISABLE_TIE_ALIGNMENT | RADVOR_DISABLE_INTERSECTIONS;
  return options;
}

radvor_bake_options without_ties(radvor_bake_options options) {
  options.disable |= RADVOR_DISABLE_TIE_ALIGNMENT;
  return options;
}

void print_row(const char* what, const FloorBake& bake, const FloorPoints& points) {
  const FloorError error = points.error_of(bake);
  const radvor_stats stats = bake.stats();
  std::printf("| %s | %zu | %.2f %% | %.2f %% | %.1f %% | %u of %u |\n", what, error.sites, 100 * error.floor,
              100 * error.near_edge, 100 * error.largest, stats.realigned_ties, stats.ties);
}

void print_sites_table(const Experiment& scene, const FloorPoints& points) {
  std::printf("| mesh | sites | floor | near the edge | largest | ties turned |\n|---|---|---|---|---|---|\n");
  constexpr std::uint32_t k_quad = RADVOR_LATTICE_QUADRILATERAL;
  print_row("uniform", FloorBake(scene, uniform(81, k_quad)), points);
  for (const std::uint32_t sites : {160u, k_paper_sites, 500u, 700u, 1400u}) {
    print_row("uniform", FloorBake(scene, uniform(sites, k_quad)), points);
    print_row("adaptive", FloorBake(scene, without_ties(adaptive(sites, k_quad))), points);
    print_row("adaptive, ties aligned", FloorBake(scene, adaptive(sites, k_quad)), points);
  }
  print_row("uniform", FloorBake(scene, uniform(2000, k_quad)), points);
}

void print_lattices_table(const Experiment& scene, const FloorPoints& points) {
  std::printf("\n| mesh | sites | floor | near the edge | largest | ties turned |\n|---|---|---|---|---|---|\n");
  for (const std::uint32_t sites : {81u, k_paper_sites, 1400u}) {
    print_row("uniform, squares", FloorBake(scene, uniform(sites, RADVOR_LATTICE_QUADRILATERAL)), points);
    print_row("uniform, hexagons", FloorBake(scene, uniform(sites, RADVOR_LATTICE_HEXAGONAL)), points);
  }
  for (const std::uint32_t sites : {k_paper_sites, 1400u}) {
    print_row("adaptive, squares", FloorBake(scene, adaptive(sites, RADVOR_LATTICE_QUADRILATERAL)), points);
    print_row("adaptive, hexagons", FloorBake(scene, adaptive(sites, RADVOR_LATTICE_HEXAGONAL)), points);
  }
}

void print_form_factor_tables(const Experiment& scene) {
  std::printf("\n| distance | hexagon | square |\n|---|---|---|\n");
  for (const SingleCellRow& row : single_cells()) {
    std::printf("| %g | %.3f %% | %.3f %% |\n", row.distance, 100 * row.hexagon, 100 * row.square);
  }
  std::printf(
      "\n| cells | disk, hexagons | disk, squares | polygon, hexagons | polygon, squares |\n|---|---|---|---|---|\n");
  for (const TiledFloorRow& row : tiled_floors(scene)) {
    std::printf("| %.0f | %.3f %% | %.3f %% | %.3f %% | %.3f %% |\n", row.cells, 100 * row.hexagons.disk,
                100 * row.squares.disk, 100 * row.hexagons.polygon, 100 * row.squares.polygon);
  }
}

void draw(const Experiment& scene, const std::string& folder) {
  constexpr std::uint32_t k_quad = RADVOR_LATTICE_QUADRILATERAL;
  const FloorBake plain(scene, without_ties(adaptive(k_paper_sites, k_quad)));
  const FloorBake aligned(scene, adaptive(k_paper_sites, k_quad));
  draw_voronoi_and_delaunay(folder + "/paper-1-1.png");
  draw_patches_and_elements(folder + "/paper-1-2.png");
  draw_adaptive_cells(folder + "/paper-1-3.png", aligned.floor());
  draw_wireframes(folder + "/paper-1-4-6.png", plain.floor(), aligned.floor());
  draw_shaded(folder + "/paper-1-5.png", plain.floor(), aligned.floor(), scene);
}

}  // namespace
}  // namespace paper

int main(int argc, char** argv) {
  try {
    const paper::Experiment scene = paper::experiment();
    const paper::FloorPoints points(scene, paper::k_points, paper::k_coarse_cell);
    paper::print_sites_table(scene, points);
    paper::print_lattices_table(scene, points);
    paper::print_form_factor_tables(scene);
    if (argc > 1) {
      paper::draw(scene, argv[1]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "radvor-paper: %s\n", error.what());
    return 1;
  }
  return 0;
}
