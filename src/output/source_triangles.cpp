#include "output/source_triangles.h"

#include <algorithm>
#include <limits>

#include "scene/disjoint_sets.h"

namespace radvor {
namespace {

double squared_distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double squared_length = dot(along, along);
  const double t = squared_length > 0 ? std::clamp(dot(point - a, along) / squared_length, 0.0, 1.0) : 0.0;
  const Vec2 apart = point - (a + t * along);
  return dot(apart, apart);
}

}  // namespace

std::array<double, 3> SourceTriangle::weights(const Vec2& point) const {
  const auto& [a, b, c] = corners;
  const double whole = cross(b - a, c - a);
  const double of_b = cross(point - a, c - a) / whole;
  const double of_c = cross(b - a, point - a) / whole;
  return {1.0 - of_b - of_c, of_b, of_c};
}

double SourceTriangle::squared_distance(const Vec2& point) const {
  const auto& [a, b, c] = corners;
  if (cross(b - a, point - a) >= 0 && cross(c - b, point - b) >= 0 && cross(a - c, point - c) >= 0) {
    return 0.0;
  }
  return std::min({squared_distance_to_segment(point, a, b), squared_distance_to_segment(point, b, c),
                   squared_distance_to_segment(point, c, a)});
}

SourceTriangles::SourceTriangles(const Surface& surface, std::uint32_t facet, std::pmr::memory_resource* memory)
    : triangles_(memory) {
  const WeldedScene& welded = surface.welded();
  const Frame& frame = surface.facets().facets[facet].frame;
  const std::span<const std::uint32_t> members = surface.facets().triangles_of(facet);
  triangles_.reserve(members.size());
  for (const std::uint32_t triangle : members) {
    const auto& [a, b, c] = welded.triangles[triangle].vertices;
    triangles_.push_back({{frame.to_plane(welded.positions[a]), frame.to_plane(welded.positions[b]),
                           frame.to_plane(welded.positions[c])},
                          triangle,
                          0});
  }
  if (triangles_.size() == 1) {
    return;
  }
  std::ranges::sort(triangles_, {}, &SourceTriangle::triangle);
  std::pmr::vector<Box> boxes(memory);
  boxes.reserve(triangles_.size());
  for (const SourceTriangle& source : triangles_) {
    boxes.push_back(plane_box(source.corners));
  }
  tree_.emplace(boxes, memory);
  find_regions(surface, facet, memory);
}

void SourceTriangles::find_regions(const Surface& surface, std::uint32_t facet, std::pmr::memory_resource* memory) {
  const WeldedScene& welded = surface.welded();
  const Facets& facets = surface.facets();
  DisjointSets regions(static_cast<std::uint32_t>(triangles_.size()), memory);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    for (const EdgeUse& use : welded.uses_of_triangle(triangles_[i].triangle)) {
      if (facets.edge_kinds[use.edge] != EdgeKind::interior) {
        continue;
      }
      for (const std::uint32_t other : welded.uses_at_edge(use.edge)) {
        const std::uint32_t neighbour = welded.uses_by_triangle[other].triangle;
        if (facets.facet_of_triangle[neighbour] == facet) {
          const auto found = std::ranges::lower_bound(triangles_, neighbour, {}, &SourceTriangle::triangle);
          regions.unite(i, static_cast<std::uint32_t>(found - triangles_.begin()));
        }
      }
    }
  }
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    triangles_[i].region = regions.find(i);
  }
}

const SourceTriangle* SourceTriangles::nearest(const Vec2& point, std::uint32_t region) const {
  if (!tree_) {
    return &triangles_.front();
  }
  const SourceTriangle* best = nullptr;
  double best_distance = std::numeric_limits<double>::infinity();
  tree_->walk_nearest(
      {point, 0.0}, [&] { return best_distance; },
      [&](std::uint32_t i) {
        const SourceTriangle& source = triangles_[i];
        if (region != k_none && source.region != region) {
          return;
        }
        const double distance = source.squared_distance(point);
        if (best == nullptr || distance < best_distance ||
            (distance == best_distance && source.triangle < best->triangle)) {
          best = &source;
          best_distance = distance;
        }
      });
  return best;
}

}  // namespace radvor
