#include "scene/edge_kinds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/shape.h"

namespace radvor {
namespace {

std::array<const EdgeUse*, 2> uses_of(const WeldedScene& welded, std::uint32_t edge) {
  const auto uses = welded.uses_at_edge(edge);
  return {&welded.uses_by_triangle[uses[0]], &welded.uses_by_triangle[uses[1]]};
}

template <class Source>
auto corners_of(const Triangle& triangle, const std::pmr::vector<Source>& attribute) {
  using Wide = std::conditional_t<Source::length() == 2, Vec2, Vec3>;
  return std::array<Wide, 3>{Wide(attribute[triangle.corners[0]]), Wide(attribute[triangle.corners[1]]),
                             Wide(attribute[triangle.corners[2]])};
}

template <class Value>
double largest(const Value& v) {
  double result = 0;
  for (int i = 0; i < Value::length(); ++i) {
    result = std::max(result, std::abs(v[i]));
  }
  return result;
}

// Does the map of the triangle with the better known plane give the other's values at the other's corners?
template <class Source>
bool one_affine_map(const WeldedScene& welded, const Triangle& a, const Triangle& b,
                    const std::pmr::vector<Source>& attribute) {
  if (attribute.empty()) {
    return true;
  }
  const auto height = [&](const Triangle& triangle) {
    const auto p = positions_of(welded, triangle);
    const double side = std::max({length(p[1] - p[0]), length(p[2] - p[1]), length(p[0] - p[2])});
    return length(area_normal(welded, triangle)) / side;
  };
  const bool a_first = height(a) >= height(b);
  const Triangle& base = a_first ? a : b;
  const Triangle& other = a_first ? b : a;
  const auto p = positions_of(welded, base);
  const auto q = positions_of(welded, other);
  const auto value = corners_of(base, attribute);
  const auto expected = corners_of(other, attribute);
  double range = 0;
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    range = std::max({range, largest(value[i] - value[0]), largest(expected[i] - value[0])});
    size = std::max({size, largest(value[i]), largest(expected[i])});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 weights = barycentric(p, q[i]);
    const auto found = weights.x * value[0] + weights.y * value[1] + weights.z * value[2];
    const double reach = 1 + std::abs(weights.x) + std::abs(weights.y) + std::abs(weights.z);
    constexpr double k_float = 0x1p-22;     // two ulp of each value
    constexpr double k_invisible = 1.0e-4;  // a tenth of a texel where a thousand cross the two triangles
    if (!(largest(found - expected[i]) <= k_float * size * reach + k_invisible * range)) {
      return false;
    }
  }
  return true;
}

class Classifier {
 public:
  Classifier(const Scene& scene, const WeldedScene& welded, const Facets& facets, double crease_angle)
      : scene_(scene),
        welded_(welded),
        facets_(facets),
        cos_crease_(std::cos(std::clamp(crease_angle, 0.0, std::numbers::pi)) - 1e-12) {}  // equal angles are within

  EdgeKind classify(std::uint32_t edge, bool joined) const {
    if (!is_manifold(welded_, edge)) {
      return EdgeKind::sharp;
    }
    const auto [use_a, use_b] = uses_of(welded_, edge);
    const Triangle& a = welded_.triangles[use_a->triangle];
    const Triangle& b = welded_.triangles[use_b->triangle];
    const bool same_facet = facets_.facet_of_triangle[use_a->triangle] == facets_.facet_of_triangle[use_b->triangle];
    if (joined && same_facet) {
      const Mesh& mesh = scene_.meshes[a.mesh];
      return one_affine_map(welded_, a, b, mesh.uvs) && one_affine_map(welded_, a, b, mesh.colors) ? EdgeKind::interior
                                                                                                   : EdgeKind::seam;
    }
    const Mesh& mesh_a = scene_.meshes[a.mesh];
    const Mesh& mesh_b = scene_.meshes[b.mesh];
    // Light of one side can't continue on the other where the other has none, or where just one has a back.
    if (same_facet || mesh_a.receives != mesh_b.receives ||
        scene_.materials[a.material].two_sided != scene_.materials[b.material].two_sided) {
      return EdgeKind::sharp;
    }
    const bool smooth = mesh_a.normals.empty() || mesh_b.normals.empty() ? within_crease(*use_a, *use_b)
                                                                         : same_normals_along(edge, *use_a, *use_b);
    return smooth ? EdgeKind::smooth : EdgeKind::sharp;
  }

 private:
  bool within_crease(const EdgeUse& a, const EdgeUse& b) const {
    return dot(frame_normal(a.triangle), frame_normal(b.triangle)) >= cos_crease_;
  }
  const Vec3& frame_normal(std::uint32_t triangle) const {
    return facets_.facets[facets_.facet_of_triangle[triangle]].frame.normal;
  }
  bool same_normals_along(std::uint32_t edge, const EdgeUse& a, const EdgeUse& b) const {
    const auto at = [&](const EdgeUse& use, std::uint32_t vertex) {
      return normalize(along_side(welded_, use, vertex, facets_.corner_normals[use.triangle]));
    };
    return std::ranges::all_of(std::array{welded_.edges[edge].a, welded_.edges[edge].b},
                               [&](std::uint32_t vertex) { return same_normal(at(a, vertex), at(b, vertex)); });
  }

  const Scene& scene_;
  const WeldedScene& welded_;
  const Facets& facets_;
  double cos_crease_;
};

}  // namespace

bool is_manifold(const WeldedScene& welded, std::uint32_t edge) {
  if (welded.uses_at_edge(edge).size() != 2) {
    return false;
  }
  const auto [a, b] = uses_of(welded, edge);
  return a->forward != b->forward;
}

bool same_colors_along(const Scene& scene, const WeldedScene& welded, std::uint32_t edge) {
  const auto color = [&](const EdgeUse& use, std::uint32_t vertex) {
    const Triangle& triangle = welded.triangles[use.triangle];
    const auto& colors = scene.meshes[triangle.mesh].colors;
    return colors.empty() ? Vec3(1.0) : along_side(welded, use, vertex, corners_of(triangle, colors));
  };
  constexpr double k_same = 1e-6;  // of the larger: rounding of what is interpolated along a side
  const auto [a, b] = uses_of(welded, edge);
  for (const std::uint32_t vertex : {welded.edges[edge].a, welded.edges[edge].b}) {
    const Vec3 color_a = color(*a, vertex);
    const Vec3 color_b = color(*b, vertex);
    if (largest(color_a - color_b) > k_same * std::max(largest(color_a), largest(color_b))) {
      return false;
    }
  }
  return true;
}

void classify_edges(const Scene& scene, const WeldedScene& welded, const std::pmr::vector<bool>& joins,
                    double crease_angle, Facets& facets) {
  const Classifier classifier(scene, welded, facets, crease_angle);
  facets.edge_kinds.resize(welded.edges.size());
  for (std::uint32_t e = 0; e < welded.edges.size(); ++e) {
    facets.edge_kinds[e] = classifier.classify(e, joins[e]);
  }
}

}  // namespace radvor
