#include "scene/facets.h"

#include <algorithm>
#include <cmath>

#include "base/floating_point.h"
#include "scene/box_tree.h"
#include "scene/corner_normals.h"
#include "scene/edge_kinds.h"
#include "scene/overlap.h"
#include "scene/planar_parts.h"
#include "scene/position_welding.h"
#include "scene/shape.h"

namespace radvor {
namespace {

// Edges that facets may grow over.
std::pmr::vector<bool> find_joins(const Scene& scene, const WeldedScene& welded,
                                  std::span<const CornerNormals> corner_normals, std::pmr::memory_resource* memory) {
  std::pmr::vector<bool> flat(welded.triangles.size(), false, memory);  // without the value, memory would be it
  for (std::size_t t = 0; t < flat.size(); ++t) {
    const Vec3 normal = normalize(area_normal(welded, welded.triangles[t]));
    flat[t] = std::ranges::all_of(corner_normals[t], [&](const Vec3& n) { return same_normal(n, normal); });
  }
  std::pmr::vector<bool> joins(welded.edges.size(), false, memory);
  for (std::uint32_t e = 0; e < joins.size(); ++e) {
    if (!is_manifold(welded, e)) {
      continue;
    }
    const auto uses = welded.uses_at_edge(e);
    const std::uint32_t a = welded.uses_by_triangle[uses[0]].triangle;
    const std::uint32_t b = welded.uses_by_triangle[uses[1]].triangle;
    const Triangle& first = welded.triangles[a];
    const Triangle& second = welded.triangles[b];
    joins[e] = first.mesh == second.mesh && first.material == second.material && flat[a] && flat[b] &&
               coplanar(welded, first, second) && same_colors_along(scene, welded, e);
  }
  return joins;
}

// Makes the facet of a set of triangles that lie in one plane, if they can share one frame.
class FacetMaker {
 public:
  FacetMaker(const WeldedScene& welded, const std::pmr::vector<bool>& joins, Facets& facets,
             std::pmr::memory_resource* memory)
      : welded_(welded), joins_(joins), facets_(facets), memory_(memory), projected_(memory) {}

  void make(std::span<const std::uint32_t> triangles) {
    const Facet facet = facet_of(triangles);
    if (triangles.size() == 1 || has_proper_plan(triangles, facet.frame)) {
      append(facet, triangles);
      return;
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto one = triangles.subspan(i, 1);
      append(facet_of(one), one);
    }
  }

 private:
  void append(const Facet& facet, std::span<const std::uint32_t> triangles) {
    const auto index = static_cast<std::uint32_t>(facets_.facets.size());
    facets_.facets.push_back(facet);
    for (const std::uint32_t t : triangles) {
      facets_.facet_of_triangle[t] = index;
      facets_.triangles.push_back(t);
    }
  }

  Facet facet_of(std::span<const std::uint32_t> triangles) const {
    const Triangle& first = welded_.triangles[triangles.front()];
    Facet facet{};
    facet.mesh = first.mesh;
    facet.material = first.material;
    facet.first_triangle = static_cast<std::uint32_t>(facets_.triangles.size());
    facet.triangle_count = static_cast<std::uint32_t>(triangles.size());
    Vec3 normal{0.0};
    for (const std::uint32_t t : triangles) {
      normal += area_normal(welded_, welded_.triangles[t]);
    }
    facet.frame = frame_of(triangles, normalize(normal));
    facet.area = 0.5 * length(normal);  // the triangles' projections into the plane, all turned the same way
    return facet;
  }

  // u along the longest boundary edge, from its first end, moved into the middle of the vertices across the plane.
  Frame frame_of(std::span<const std::uint32_t> triangles, const Vec3& normal) const {
    Edge longest = longest_boundary_edge(triangles);
    Frame frame;
    frame.normal = normal;
    const Vec3 along = welded_.positions[longest.b] - welded_.positions[longest.a];
    frame.u = normalize(along - dot(along, normal) * normal);
    frame.v = cross(normal, frame.u);
    const Vec3& start = welded_.positions[longest.a];
    double low = 0;
    double high = 0;
    for_each_position(triangles, [&](const Vec3& p) {
      const double height = dot(p - start, normal);
      low = std::min(low, height);
      high = std::max(high, height);
    });
    frame.origin = start + 0.5 * (low + high) * normal;
    double extent = 0;
    for_each_position(triangles, [&](const Vec3& p) {
      extent = std::max({extent, std::abs(dot(p - frame.origin, frame.u)), std::abs(dot(p - frame.origin, frame.v))});
    });
    int exponent;
    std::frexp(extent, &exponent);  // extent < 2^exponent
    frame.unit = std::ldexp(1.0, exponent - 40);
    return frame;
  }

  // Of the edges that have the set on one side only; ties go to the edge that lies first.
  Edge longest_boundary_edge(std::span<const std::uint32_t> triangles) const {
    Edge longest{k_none, k_none};
    double longest_squared = -1;
    for (const std::uint32_t t : triangles) {
      for (const EdgeUse& use : welded_.uses_of_triangle(t)) {
        if (triangles.size() > 1 && joins_[use.edge] && both_sides_in(triangles, use.edge)) {
          continue;
        }
        const Edge& edge = welded_.edges[use.edge];
        const Vec3 along = welded_.positions[edge.b] - welded_.positions[edge.a];
        const double squared = dot(along, along);
        if (squared > longest_squared || (squared == longest_squared && comes_before(edge, longest))) {
          longest_squared = squared;
          longest = edge;
        }
      }
    }
    return longest;
  }

  bool both_sides_in(std::span<const std::uint32_t> triangles, std::uint32_t edge) const {
    return std::ranges::all_of(welded_.uses_at_edge(edge), [&](std::uint32_t use) {
      return std::ranges::binary_search(triangles, welded_.uses_by_triangle[use].triangle);
    });
  }

  bool comes_before(const Edge& a, const Edge& b) const {
    const auto& p = welded_.positions;
    return a.a != b.a ? lies_before(p[a.a], p[b.a]) : a.b != b.b && lies_before(p[a.b], p[b.b]);
  }

  // All triangles turn the same way on the snapped plane and none lies on another.
  bool has_proper_plan(std::span<const std::uint32_t> triangles, const Frame& frame) {
    projected_.clear();
    double precision = 0;
    for (const std::uint32_t t : triangles) {
      const auto p = positions_of(welded_, welded_.triangles[t]);
      const auto& projected =
          projected_.emplace_back(std::array{frame.to_plane(p[0]), frame.to_plane(p[1]), frame.to_plane(p[2])});
      if (!(cross(projected[1] - projected[0], projected[2] - projected[0]) > 0)) {
        return false;
      }
      for (const std::uint32_t vertex : welded_.triangles[t].vertices) {
        precision = std::max(precision, welded_.precision[vertex]);
      }
    }
    const double extent = frame.unit * 0x1p40;
    const double tolerance = std::max(planar_tolerance(precision, extent), welded_.weld_distance);
    return triangles.size() == 2 || !triangles_overlap(projected_, tolerance, memory_);
  }

  template <class Function>
  void for_each_position(std::span<const std::uint32_t> triangles, Function&& function) const {
    for (const std::uint32_t t : triangles) {
      for (const EdgeUse& use : welded_.uses_of_triangle(t)) {  // T-junctions too
        function(welded_.positions[welded_.edges[use.edge].a]);
        function(welded_.positions[welded_.edges[use.edge].b]);
      }
    }
  }

  const WeldedScene& welded_;
  const std::pmr::vector<bool>& joins_;
  Facets& facets_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<std::array<Vec2, 3>> projected_;
};

void mark_flat(Facets& facets) {
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f) {
    Facet& facet = facets.facets[f];
    facet.flat = std::ranges::all_of(facets.triangles_of(f), [&](std::uint32_t t) {
      return std::ranges::all_of(facets.corner_normals[t],
                                 [&](const Vec3& normal) { return same_normal(normal, facet.frame.normal); });
    });
  }
}

}  // namespace

Facets::Facets(std::pmr::memory_resource* memory)
    : facets(memory),
      triangles(memory),
      facet_of_triangle(memory),
      edge_kinds(memory),
      corner_normals(memory),
      contacts(memory) {}

std::span<const std::uint32_t> Facets::triangles_of(std::uint32_t facet) const {
  return std::span(triangles).subspan(facets[facet].first_triangle, facets[facet].triangle_count);
}

Facets find_facets(const Scene& scene, const WeldedScene& welded, double crease_angle, Host& host) {
  const FloatingPointGuard guard(Denormals::keep);
  std::pmr::memory_resource* memory = &host.memory;
  Facets facets(memory);
  facets.corner_normals = given_normals(scene, welded, host);
  const auto joins = find_joins(scene, welded, facets.corner_normals, memory);
  const TriangleGroups parts = planar_parts(welded, joins, memory);
  facets.facet_of_triangle.resize(welded.triangles.size());
  facets.triangles.reserve(welded.triangles.size());
  facets.facets.reserve(parts.size());
  FacetMaker maker(welded, joins, facets, memory);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    maker.make(parts[i]);
  }
  classify_edges(scene, welded, joins, crease_angle, facets);
  smooth_normals(scene, welded, facets, memory);
  mark_flat(facets);
  return facets;
}

Vec3 shading_normal(const Facets& facets, const WeldedScene& welded, std::uint32_t facet, const Vec3& point) {
  if (facets.facets[facet].flat) {
    return facets.facets[facet].frame.normal;
  }
  double deepest = -std::numeric_limits<double>::infinity();
  Vec3 weights{0.0};
  std::uint32_t nearest = 0;
  for (const std::uint32_t t : facets.triangles_of(facet)) {
    const Vec3 w = barycentric(positions_of(welded, welded.triangles[t]), point);
    const double inside = std::min({w.x, w.y, w.z});
    if (inside > deepest) {
      deepest = inside;
      weights = w;
      nearest = t;
    }
  }
  weights = {std::max(weights.x, 0.0), std::max(weights.y, 0.0), std::max(weights.z, 0.0)};
  const CornerNormals& n = facets.corner_normals[nearest];
  const Vec3 normal = weights.x * n[0] + weights.y * n[1] + weights.z * n[2];
  return dot(normal, normal) > 0 ? normalize(normal) : facets.facets[facet].frame.normal;
}

}  // namespace radvor
