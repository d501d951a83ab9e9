// The scene as one body: positions welded across meshes, defects repaired and counted, triangles joined by edges.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "base/vector.h"
#include "scene/scene.h"

namespace radvor {

inline constexpr std::uint32_t k_none = std::numeric_limits<std::uint32_t>::max();

/// A triangle that was kept. Corners run counter-clockwise about the front in world space, whatever the mesh's winding
/// and its transform's handedness.
struct Triangle {
  std::array<std::uint32_t, 3> vertices;  ///< welded
  std::array<std::uint32_t, 3> corners;   ///< the mesh's own vertex indices, in the same order
  std::uint32_t mesh;
  std::uint32_t source;  ///< the mesh's triangle
  std::uint32_t material;
};

/// An undirected edge between two welded vertices with no vertex of a T-junction inside. a and b are ordered by
/// position (x, then y, then z), so that what is derived from an edge is the same from all of its sides.
struct Edge {
  std::uint32_t a, b;
};

/// Of the use of a contact edge, which lies inside the facet that its triangle is one of.
inline constexpr std::uint8_t k_no_side = 3;

/// One side of a triangle, or the part of it that one edge makes up where T-junctions divide the side.
struct EdgeUse {
  std::uint32_t edge;
  std::uint32_t triangle;
  std::uint8_t side;  ///< from corner `side` to corner (side + 1) % 3; k_no_side
  bool forward;       ///< the triangle runs the edge from a to b
};

struct WeldedScene {
  explicit WeldedScene(std::pmr::memory_resource* memory);

  std::pmr::vector<Vec3> positions;    ///< of welded vertices, world space
  std::pmr::vector<double> precision;  ///< per welded vertex: how far rounding to float may have moved it, world units
  std::pmr::vector<std::pmr::vector<std::uint32_t>> vertex_of;  ///< per mesh: welded vertex of each mesh vertex
  std::pmr::vector<Triangle> triangles;
  std::pmr::vector<Edge> edges;
  std::pmr::vector<EdgeUse> uses_by_triangle;     ///< in order round each triangle; then those of contact edges
  std::pmr::vector<std::uint32_t> first_use;      ///< per triangle (and one past the last) into uses_by_triangle
  std::pmr::vector<std::uint32_t> uses_of_edge;   ///< indices into uses_by_triangle, grouped by edge
  std::pmr::vector<std::uint32_t> first_of_edge;  ///< per edge (and one past the last) into uses_of_edge

  Vec3 low{0.0}, high{0.0};  ///< bounds of the kept triangles
  double weld_distance = 0;  ///< it was made with

  // What was found wrong and mended.
  std::uint32_t degenerate_triangles = 0;  ///< repeated vertices or too low to have a plane: dropped
  std::uint32_t duplicate_triangles = 0;   ///< same vertices, same side: all but the first dropped
  std::uint32_t t_junctions = 0;           ///< vertices that lie inside edges of other triangles

  std::span<const EdgeUse> uses_of_triangle(std::uint32_t triangle) const;
  std::span<const std::uint32_t> uses_at_edge(std::uint32_t edge) const;
};

/// Fills uses_of_edge and first_of_edge from uses_by_triangle: a counting sort.
void group_uses(WeldedScene& welded);

/// Makes one body of all meshes. Logs one line for each kind of repair.
///
/// Welds positions no farther apart than weld_distance (0: equal to the bit). Touching means no farther apart than
/// weld_distance or than rounding the input to float explains (edge_chains.h). Then:
/// - Triangles with a repeated vertex, or whose height over the longest side is within touching, are dropped; what lies
///   on their two sides stays joined, as the apex becomes a T-junction of the longest side.
/// - Of triangles with the same vertices and the same front all but the first (by mesh, then triangle) are dropped,
///   whatever their material, provided their meshes cast and receive alike. Opposite ones stay, each with its front.
/// - Every vertex that touches a segment between two corners, anywhere in the scene, away from the ends, divides it:
/// also
///   segments that two triangles share already, so that no vertex lies inside any edge afterwards. All sides along a
///   segment get the same edges, so the body has no boundary that the welded triangles did not have.
/// Throws Error (limit) beyond 2^32 - 2 vertices or triangles.
WeldedScene weld(const Scene& scene, double weld_distance, Host& host);

}  // namespace radvor
