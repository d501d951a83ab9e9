// An independent eye on meshes: by position alone, is every edge met by two triangles, does any vertex lie inside an
// edge, does the border lie on the input's border? It shares no code with what makes the meshes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mesh_checks {

using Position = std::array<float, 3>;

inline Position key(const glm::vec3& p) {
  return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // -0 is 0
}

inline glm::dvec3 wide(const Position& p) {
  return {p[0], p[1], p[2]};
}

struct Triangles {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;

  void append(std::span<const glm::vec3> more_positions, std::span<const std::uint32_t> more_indices) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), more_positions.begin(), more_positions.end());
    for (const std::uint32_t index : more_indices) {
      indices.push_back(first + index);
    }
  }
};

/// How often triangles run an edge each way; the edge's ends ascend.
struct EdgeRuns {
  int up = 0, down = 0;
};
using Edges = std::map<std::pair<Position, Position>, EdgeRuns>;

inline Edges edges_of(const Triangles& mesh) {
  Edges edges;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Position a = key(mesh.positions[mesh.indices[i + k]]);
      const Position b = key(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
      if (a < b) {
        ++edges[{a, b}].up;
      } else {
        ++edges[{b, a}].down;
      }
    }
  }
  return edges;
}

inline std::string print(const std::pair<Position, Position>& edge) {
  return ::testing::PrintToString(edge.first) + " to " + ::testing::PrintToString(edge.second);
}

/// Every edge has exactly two triangles, which run it in opposite directions.
inline ::testing::AssertionResult is_closed(const Triangles& mesh) {
  if (mesh.indices.empty()) {
    return ::testing::AssertionFailure() << "no triangles";
  }
  for (const auto& [edge, runs] : edges_of(mesh)) {
    if (edge.first == edge.second) {
      return ::testing::AssertionFailure() << "an edge without length at " << ::testing::PrintToString(edge.first);
    }
    if (runs.up != 1 || runs.down != 1) {
      return ::testing::AssertionFailure()
             << "edge " << print(edge) << " is run " << runs.up << " times up and " << runs.down << " times down";
    }
  }
  return ::testing::AssertionSuccess();
}

/// Whether p lies on the segment within `tolerance` of its length, ends left out by as much.
inline bool lies_inside(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  const glm::dvec3 along = b - a;
  const double squared = dot(along, along);
  const double t = dot(p - a, along) / squared;
  const glm::dvec3 apart = p - (a + t * along);
  return t > tolerance && t < 1 - tolerance && dot(apart, apart) < tolerance * tolerance * squared;
}

/// No vertex lies inside an edge. `tolerance` is relative to the edge's length and above single precision.
inline ::testing::AssertionResult has_no_t_vertices(const Triangles& mesh, double tolerance = 1e-5) {
  std::vector<Position> vertices;
  for (const std::uint32_t index : mesh.indices) {
    vertices.push_back(key(mesh.positions[index]));
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const auto& [edge, runs] : edges_of(mesh)) {
    const glm::dvec3 a = wide(edge.first);
    const glm::dvec3 b = wide(edge.second);
    const auto slack = static_cast<float>(tolerance * length(b - a));
    const auto first = std::ranges::lower_bound(vertices, Position{edge.first[0] - slack, -INFINITY, -INFINITY});
    for (auto vertex = first; vertex != vertices.end() && (*vertex)[0] <= edge.second[0] + slack; ++vertex) {
      if (lies_inside(wide(*vertex), a, b, tolerance)) {
        return ::testing::AssertionFailure()
               << "vertex " << ::testing::PrintToString(*vertex) << " lies inside edge " << print(edge);
      }
    }
  }
  return ::testing::AssertionSuccess();
}

/// Edges of one triangle lie on edges of one triangle of the input; none has more than two.
inline ::testing::AssertionResult has_border_of(const Triangles& mesh, const Triangles& input,
                                                double tolerance = 1e-5) {
  std::vector<std::pair<Position, Position>> border;
  for (const auto& [edge, runs] : edges_of(input)) {
    if (runs.up + runs.down == 1) {
      border.push_back(edge);
    }
  }
  for (const auto& [edge, runs] : edges_of(mesh)) {
    const int uses = runs.up + runs.down;
    if (uses == 2) {
      continue;
    }
    const auto covers = [&edge = edge, tolerance](const std::pair<Position, Position>& candidate) {
      const glm::dvec3 a = wide(candidate.first);
      const glm::dvec3 b = wide(candidate.second);
      const auto on = [&](const Position& p) {
        return p == candidate.first || p == candidate.second || lies_inside(wide(p), a, b, tolerance);
      };
      return on(edge.first) && on(edge.second);
    };
    if (uses != 1 || std::ranges::none_of(border, covers)) {
      return ::testing::AssertionFailure() << "edge " << print(edge) << " has " << uses << " triangles";
    }
  }
  return ::testing::AssertionSuccess();
}

/// Enclosed volume, positive where triangles run counter-clockwise seen from outside.
inline double volume(const Triangles& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
    const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
    const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
    sum += dot(a, cross(b, c));
  }
  return sum / 6;
}

inline double area(const Triangles& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
    const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
    const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
    sum += 0.5 * length(cross(b - a, c - a));
  }
  return sum;
}

}  // namespace mesh_checks
