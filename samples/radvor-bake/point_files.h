// Points to measure light at, and what was measured there, as CSV.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bake {

struct Points {
  std::vector<double> positions;  ///< 3 a point
  std::vector<float> normals;     ///< 3 a point
  std::size_t count() const { return positions.size() / 3; }
};

/// A header line names the columns; x, y, z, nx, ny, nz must be among them, in any order, others are passed over.
/// Throws Failure (input) with file and line.
Points load_points(const std::string& file);

/// Header r,g,b,found; one line a point, in the points' order. rgb: 3 a point. Throws Failure (output).
void save_values(const std::string& file, const std::vector<float>& rgb, const std::vector<std::uint8_t>& found);

}  // namespace bake
