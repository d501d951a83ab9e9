// Triangles and segments for the tests of visibility, made from a seed.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/hash.h"
#include "base/host.h"
#include "visibility/visibility.h"

namespace radvor {

inline Host make_host(std::uint32_t threads = 1) {
  return Host{HostMemory(nullptr, nullptr, nullptr), Log(nullptr, nullptr),
              Jobs(threads, nullptr, nullptr, std::pmr::get_default_resource())};
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed) {}

  double between(double low, double high) { return low + (high - low) * to_unit(hash(seed_, count_++)); }
  std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(between(0, bound)); }
  Vec3 in_cube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

  Vec3 direction() {
    const double z = between(-1, 1);
    const double angle = between(0, 6.283185307179586);
    const double radius = std::sqrt(1 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

struct TriangleSoup {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> corners;

  Occluders occluders() const { return {positions, corners}; }

  std::array<Vec3, 3> triangle(std::size_t index) const {
    return {positions[corners[3 * index]], positions[corners[3 * index + 1]], positions[corners[3 * index + 2]]};
  }

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& position : {a, b, c}) {
      corners.push_back(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(position);
    }
  }
};

/// Triangles about `size` across in the cube from -1 to 1.
inline TriangleSoup random_soup(std::uint64_t seed, std::size_t count, double size) {
  Random random(seed);
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 centre = random.in_cube();
    soup.add(centre + size * random.in_cube(), centre + size * random.in_cube(), centre + size * random.in_cube());
  }
  return soup;
}

/// A sphere about 0 of radius 1 in rows and columns; closed, all normals outwards.
inline TriangleSoup sphere(std::uint32_t rows, std::uint32_t columns) {
  TriangleSoup soup;
  soup.positions = {Vec3(0, 0, 1), Vec3(0, 0, -1)};
  for (std::uint32_t row = 1; row < rows; ++row) {
    const double polar = 3.141592653589793 * row / rows;
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double azimuth = 6.283185307179586 * column / columns;
      soup.positions.emplace_back(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                  std::cos(polar));
    }
  }
  const auto at = [&](std::uint32_t row, std::uint32_t column) { return 2 + (row - 1) * columns + column % columns; };
  for (std::uint32_t column = 0; column < columns; ++column) {
    const std::uint32_t next = column + 1;
    soup.corners.insert(soup.corners.end(), {0, at(1, column), at(1, next)});
    for (std::uint32_t row = 1; row + 1 < rows; ++row) {
      soup.corners.insert(soup.corners.end(), {at(row, column), at(row + 1, column), at(row + 1, next)});
      soup.corners.insert(soup.corners.end(), {at(row, column), at(row + 1, next), at(row, next)});
    }
    soup.corners.insert(soup.corners.end(), {1, at(rows - 1, next), at(rows - 1, column)});
  }
  return soup;
}

/// Whether the answer hangs on no rounding: the segment's line keeps `margin` from the lines of all edges, and both
/// ends from all planes.
inline bool is_clear(const TriangleSoup& soup, const Sightline& segment, double margin) {
  const Vec3 direction = segment.to - segment.from;
  for (std::size_t i = 0; i < soup.corners.size() / 3; ++i) {
    const std::array<Vec3, 3> triangle = soup.triangle(i);
    const Vec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double area = glm::length(normal);
    for (const Vec3& end : {segment.from, segment.to}) {
      if (std::abs(glm::dot(normal, end - triangle[0])) <= margin * area) {
        return false;
      }
    }
    for (int edge = 0; edge < 3; ++edge) {
      const Vec3& a = triangle[static_cast<std::size_t>(edge)];
      const Vec3 across = glm::cross(direction, triangle[static_cast<std::size_t>((edge + 1) % 3)] - a);
      if (std::abs(glm::dot(across, a - segment.from)) <= margin * glm::length(across)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace radvor
