#include "scene/corner_normals.h"

#include <cmath>
#include <numbers>

#include "scene/disjoint_sets.h"
#include "scene/shape.h"

namespace radvor {
namespace {

// The cofactors of the linear part, with the sign of the determinant: the inverse transpose up to a positive factor,
// and what is left of it for a flattened mesh.
class NormalMap {
 public:
  explicit NormalMap(const Transform& t) {
    const Vec3 rows[3] = {{t[0], t[1], t[2]}, {t[4], t[5], t[6]}, {t[8], t[9], t[10]}};
    const double sign = mirrors(t) ? -1 : 1;
    for (int i = 0; i < 3; ++i) {
      rows_[i] = sign * cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
    }
  }
  Vec3 operator()(const Vec3& normal) const {
    return {dot(rows_[0], normal), dot(rows_[1], normal), dot(rows_[2], normal)};
  }

 private:
  Vec3 rows_[3];
};

// Unit, or zero where there is no direction. Scaled first: squares of very long and very short ones leave the range.
Vec3 direction_of(const Vec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0 && largest < std::numeric_limits<double>::infinity())) {
    return Vec3(0.0);
  }
  const Vec3 scaled = v / largest;
  const Vec3 unit = scaled / length(scaled);
  return std::isfinite(dot(unit, unit)) ? unit : Vec3(0.0);
}

// Makes the normals of one triangle usable; whether they had to be turned over.
bool put_in_front(CornerNormals& normals, const Vec3& front) {
  double facing = 0;
  for (const Vec3& normal : normals) {
    facing += dot(normal, front);
  }
  for (Vec3& normal : normals) {
    if (facing < 0) {
      normal = -normal;
    }
    const double along = dot(normal, front);
    if (along < 0) {
      normal = direction_of(normal - along * front);
    }
    if (normal == Vec3(0.0)) {
      normal = front;
    }
  }
  return facing < 0;
}

double angle_at(const std::array<Vec3, 3>& p, std::size_t corner) {
  const Vec3 to_next = p[(corner + 1) % 3] - p[corner];
  const Vec3 to_last = p[(corner + 2) % 3] - p[corner];
  return std::atan2(length(cross(to_next, to_last)), dot(to_next, to_last));
}

std::size_t corner_at(const Triangle& triangle, std::uint32_t vertex) {
  std::size_t corner = 0;
  while (corner < 3 && triangle.vertices[corner] != vertex) {
    ++corner;
  }
  return corner;
}

}  // namespace

std::pmr::vector<CornerNormals> given_normals(const Scene& scene, const WeldedScene& welded, Host& host) {
  std::pmr::vector<NormalMap> maps(&host.memory);
  for (const Mesh& mesh : scene.meshes) {
    maps.emplace_back(mesh.transform);
  }
  std::pmr::vector<CornerNormals> result(welded.triangles.size(), &host.memory);
  std::uint32_t turned = 0;
  for (std::size_t t = 0; t < welded.triangles.size(); ++t) {
    const Triangle& triangle = welded.triangles[t];
    const Mesh& mesh = scene.meshes[triangle.mesh];
    const Vec3 front = direction_of(area_normal(welded, triangle));
    result[t] = {front, front, front};
    if (!mesh.normals.empty()) {
      for (std::size_t i = 0; i < 3; ++i) {
        result[t][i] = direction_of(maps[triangle.mesh](Vec3(mesh.normals[triangle.corners[i]])));
      }
      turned += put_in_front(result[t], front);
    }
  }
  if (turned > 0) {
    host.log(LogLevel::warning, "turned over the normals of %u triangles that pointed behind them", turned);
  }
  return result;
}

void smooth_normals(const Scene& scene, const WeldedScene& welded, Facets& facets, std::pmr::memory_resource* memory) {
  const auto normal_of = [&](std::uint32_t triangle) {
    return facets.facets[facets.facet_of_triangle[triangle]].frame.normal;
  };
  // Corners are joined over edges; where the end of an edge is a T-junction of one triangle's side, that triangle
  // lends its normal to the other's corner with half of its straight angle, the edge on the other side with the rest.
  const auto corners = static_cast<std::uint32_t>(3 * welded.triangles.size());
  DisjointSets sets(corners, memory);
  std::pmr::vector<Vec3> sums(corners, Vec3(0.0), memory);
  for (std::uint32_t e = 0; e < welded.edges.size(); ++e) {
    const auto uses = welded.uses_at_edge(e);
    if (facets.edge_kinds[e] == EdgeKind::sharp || uses.size() != 2) {
      continue;
    }
    const std::uint32_t t[2] = {welded.uses_by_triangle[uses[0]].triangle, welded.uses_by_triangle[uses[1]].triangle};
    const std::size_t first[2] = {std::size_t{3} * t[0], std::size_t{3} * t[1]};
    for (const std::uint32_t vertex : {welded.edges[e].a, welded.edges[e].b}) {
      const std::size_t corner[2] = {corner_at(welded.triangles[t[0]], vertex),
                                     corner_at(welded.triangles[t[1]], vertex)};
      if (corner[0] < 3 && corner[1] < 3) {
        sets.unite(static_cast<std::uint32_t>(first[0] + corner[0]), static_cast<std::uint32_t>(first[1] + corner[1]));
      }
      for (int i = 0; i < 2; ++i) {
        if (corner[i] < 3 && corner[1 - i] == 3) {
          sums[first[i] + corner[i]] += 0.5 * std::numbers::pi * normal_of(t[1 - i]);
        }
      }
    }
  }
  for (std::uint32_t t = 0; t < welded.triangles.size(); ++t) {
    const auto p = positions_of(welded, welded.triangles[t]);
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Vec3 lent = sums[3 * t + i];
      const std::uint32_t root = sets.find(3 * t + i);
      const Vec3 own = angle_at(p, i) * normal_of(t);
      sums[root] += root == 3 * t + i ? own : own + lent;
    }
  }
  for (std::uint32_t t = 0; t < welded.triangles.size(); ++t) {
    if (scene.meshes[welded.triangles[t].mesh].normals.empty()) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        facets.corner_normals[t][i] = direction_of(sums[sets.find(3 * t + i)]);
      }
      put_in_front(facets.corner_normals[t], normal_of(t));
    }
  }
}

}  // namespace radvor
