// Facets: maximal connected sets of coplanar triangles of one mesh and material, each with its own frame. The paper's
// "surfaces".
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "base/vector.h"
#include "scene/welded.h"

namespace radvor {

/// Right-handed, orthonormal to rounding; normal on the front. Frame coordinates are snapped to multiples of `unit`, a
/// power of two far under the precision of the input, so that lattices and their ties are exact in double precision.
struct Frame {
  Vec3 origin{0.0};
  Vec3 u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};
  double unit = 0x1p-40;

  Vec2 to_plane(const Vec3& p) const;  ///< projected and snapped
  Vec3 to_world(const Vec2& p) const { return origin + p.x * u + p.y * v; }
};

struct Facet {
  std::uint32_t mesh;
  std::uint32_t material;
  std::uint32_t first_triangle, triangle_count;  ///< into Facets::triangles
  Frame frame;
  double area;  ///< of its triangles, in their plane
  bool flat;    ///< the shading normal is the frame's everywhere; else interpolate corner_normals
};

/// How light behaves across an edge.
enum class EdgeKind : std::uint8_t {
  interior,  ///< inside one facet: no trace of it in the light
  seam,      ///< inside one facet, but UVs or colours are not one affine map across it: a continuous constraint edge
  smooth,    ///< between facets; irradiance is shared across it
  sharp,     ///< between facets, or a boundary, or not manifold: positions are shared, light is not
};

struct Facets {
  explicit Facets(std::pmr::memory_resource* memory);

  std::pmr::vector<Facet> facets;
  std::pmr::vector<std::uint32_t> triangles;             ///< welded triangles grouped by facet
  std::pmr::vector<std::uint32_t> facet_of_triangle;     ///< per welded triangle
  std::pmr::vector<EdgeKind> edge_kinds;                 ///< per welded edge
  std::pmr::vector<std::array<Vec3, 3>> corner_normals;  ///< unit shading normals per welded triangle, front side

  std::span<const std::uint32_t> triangles_of(std::uint32_t facet) const;
};

/// Grows facets over shared edges while planar (to a distance relative to the facet's size, and an angle), with the
/// same mesh and material, equal vertex colours along the edge and, where the mesh has normals, the facet's normal at
/// all corners; otherwise every triangle is a facet. A facet whose outline overlaps itself in projection falls back to
/// its triangles. crease_angle (radians) decides smooth and sharp where a mesh has no normals, and then the corner
/// normals are angle-weighted means over the triangles round a vertex that smooth edges join.
Facets find_facets(const Scene& scene, const WeldedScene& welded, double crease_angle, Host& host);

}  // namespace radvor
