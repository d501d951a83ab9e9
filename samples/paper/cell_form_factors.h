// Hexagons or squares: how well a cell's light is told by the form factor of a disk of its area, and how well by that
// of its polygon, for cells of both lattices.
#pragma once

#include <cstdint>
#include <vector>

#include "exact_shadow.h"

namespace paper {

struct SingleCellRow {
  double distance;         ///< of the receiver from the cell's centre, over the square root of the cell's area
  double hexagon, square;  ///< rms relative error of the disk's form factor, directions uniform over the hemisphere
};
std::vector<SingleCellRow> single_cells();

struct TiledFloorRow {
  double cells;  ///< on the whole floor
  /// rms error over the mean, of the disk's form factor and of the polygon's; what is left of the latter is that
  /// radiosity is constant in a cell. Mean square over many placements of the lattice, or its luck would decide.
  struct Error {
    double disk, polygon;
  } hexagons, squares;
};
/// The light that the experiment's floor reflects (albedo 1) to points above it.
std::vector<TiledFloorRow> tiled_floors(const Experiment& experiment);

}  // namespace paper
