// Shading normals at the corners of triangles: the engine's, made usable, or means over smooth edges.
#pragma once

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

using CornerNormals = std::array<Vec3, 3>;

/// Unit vectors farther apart than this are different normals: in degrees 0.11, above the rounding of three decimals in
/// text files, and a tenth of a percent of the light.
inline constexpr double k_same_normal = 2e-3;

inline bool same_normal(const Vec3& a, const Vec3& b) {
  return dot(a - b, a - b) <= k_same_normal * k_same_normal;
}

/// The given normals in world space, unit, on the front side; the triangle's own where a mesh has none. Logs how many
/// triangles had normals pointing behind them.
std::pmr::vector<CornerNormals> given_normals(const Scene& scene, const WeldedScene& welded, Host& host);

/// For meshes without normals: means of the facets' normals, weighted by the angle at the vertex, over the triangles
/// round it that edges other than sharp ones join. Needs the facets with their frames and edge kinds.
void smooth_normals(const Scene& scene, const WeldedScene& welded, Facets& facets, std::pmr::memory_resource* memory);

}  // namespace radvor
