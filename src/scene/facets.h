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
#include "scene/contacts.h"
#include "scene/welded.h"

namespace radvor {

/// Right-handed, orthonormal to rounding; normal on the front. Frame coordinates are snapped to multiples of `unit`, a
/// power of two far under the precision of the input, so that lattices and their ties are exact in double precision.
struct Frame {
  Vec3 origin{0.0};
  Vec3 u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};
  double unit = 0x1p-40;

  Vec2 to_plane(const Vec3& p) const;  ///< projected and snapped
  Vec2 snapped(const Vec2& p) const;
  Vec3 to_world(const Vec2& p) const { return origin + p.x * u + p.y * v; }
};

struct Facet {
  std::uint32_t mesh;
  std::uint32_t material;
  std::uint32_t first_triangle, triangle_count;  ///< into Facets::triangles
  Frame frame;
  double area;  ///< of its triangles, in their plane
  bool flat;    ///< the shading normal is the frame's everywhere; else interpolate: shading_normal()
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
  Contacts contacts;                                     ///< none before find_contacts

  std::span<const std::uint32_t> triangles_of(std::uint32_t facet) const;
};

/// Grows facets over edges that two triangles of the same mesh and material run in opposite directions while they are
/// planar, the vertex colours along the edge are equal and, where the mesh has normals, all corner normals are the
/// facet's; a triangle with other normals is a facet of its own.
/// - Planar means: no vertex is farther from the facet's plane than rounding explains, plus a millionth of the facet's
///   size: rays must not meet the triangles before they meet the plane. Neighbours bend by less than ten degrees.
/// - A facet whose triangles overlap in projection falls back to its triangles.
/// - Facets are connected over edges, may have holes, and may touch themselves in a vertex or along an edge that is not
///   manifold (a wall standing on a floor): such an edge is used twice by the same facet and is sharp.
/// - Frames: u runs along the longest boundary edge. Which triangles make up a facet does not depend on their order.
///
/// An edge between facets is smooth where exactly two triangles run it in opposite directions, both or none of them
/// receive and are two-sided, and their normals agree: the given ones at both ends where both meshes have normals (of
/// any two meshes), else the facets' within crease_angle (radians).
///
/// Corner normals are the given ones, on the front side: turned over where those of a triangle point behind it on the
/// whole, bent up to its plane where just one does, the facet's where they are no directions. In meshes without normals
/// they are angle-weighted means over the triangles round a vertex that edges other than sharp ones join.
Facets find_facets(const Scene& scene, const WeldedScene& welded, double crease_angle, Host& host);

/// Of a point on a facet: the frame's normal where it is flat, else interpolated in the triangle that the point is in
/// or nearest to. Takes time in proportion to the facet's triangles.
Vec3 shading_normal(const Facets& facets, const WeldedScene& welded, std::uint32_t facet, const Vec3& point);

}  // namespace radvor
