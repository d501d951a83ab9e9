#include "scene/facet_plan.h"

#include <algorithm>
#include <cmath>

#include "scene/shape.h"

namespace radvor {
namespace {

Box box_around(const Vec2& a, const Vec2& b, double margin) {
  Box box;
  box.add(Vec3(glm::min(a, b) - margin, 0.0));
  box.add(Vec3(glm::max(a, b) + margin, 0.0));
  return box;
}

}  // namespace

double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double part = square > 0 ? std::clamp(dot(point - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::distance(point, a + part * along);
}

FacetPlan::FacetPlan(const WeldedScene& welded, const Facets& facets, std::uint32_t facet,
                     std::pmr::memory_resource* memory)
    : welded_(welded), facets_(facets), triangles_(memory), outline_(memory) {
  const Frame& frame = facets.facets[facet].frame;
  std::pmr::vector<Box> boxes(memory);
  for (const std::uint32_t t : facets.triangles_of(facet)) {
    const auto p = positions_of(welded, welded.triangles[t]);
    const Corners& corners =
        triangles_.emplace_back(Corners{frame.to_plane(p[0]), frame.to_plane(p[1]), frame.to_plane(p[2])});
    Box& box = boxes.emplace_back();
    for (const Vec2& corner : corners) {
      box.add(Vec3(corner, 0.0));
    }
    for (const EdgeUse& use : welded.uses_of_triangle(t)) {
      if (facets.edge_kinds[use.edge] != EdgeKind::interior) {
        const Edge& edge = welded.edges[use.edge];
        outline_.push_back({use.edge, edge.a, edge.b, frame.to_plane(welded.positions[edge.a]),
                            frame.to_plane(welded.positions[edge.b])});
      }
    }
  }
  triangle_tree_.emplace(boxes, memory);
  std::ranges::sort(outline_, {}, &PlanEdge::edge);
  const auto same_edge = [](const PlanEdge& a, const PlanEdge& b) { return a.edge == b.edge; };
  outline_.erase(std::unique(outline_.begin(), outline_.end(), same_edge), outline_.end());  // slits are there twice
  boxes.clear();
  for (const PlanEdge& edge : outline_) {
    boxes.push_back(box_around(edge.from, edge.to, 0.0));
  }
  edge_tree_.emplace(boxes, memory);
}

void FacetPlan::clip(const Vec2& a, const Vec2& b, double slack, std::pmr::vector<Stretch>& inside) const {
  inside.clear();
  const double length = glm::distance(a, b);
  if (!(length > 0)) {
    return;
  }
  for_each_triangle_near(box_around(a, b, slack), [&](const Corners& triangle) {
    double from = 0;
    double to = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 side = triangle[(k + 1) % 3] - triangle[k];
      const double depth = slack * glm::length(side);
      const double at_a = cross(side, a - triangle[k]) + depth;
      const double at_b = cross(side, b - triangle[k]) + depth;
      if (at_a < 0 && at_b < 0) {
        return;
      }
      if (at_a < 0) {
        from = std::max(from, at_a / (at_a - at_b));
      } else if (at_b < 0) {
        to = std::min(to, at_a / (at_a - at_b));
      }
    }
    if (from < to) {
      inside.push_back({from, to});
    }
  });
  std::ranges::sort(inside, {}, &Stretch::from);
  std::size_t count = 0;
  for (const Stretch& stretch : inside) {
    if (count > 0 && (stretch.from - inside[count - 1].to) * length <= slack) {
      inside[count - 1].to = std::max(inside[count - 1].to, stretch.to);
    } else {
      inside[count++] = stretch;
    }
  }
  inside.resize(count);
}

std::optional<double> FacetPlan::cut_by(std::uint32_t outline_edge, std::uint32_t facet, double least) const {
  const Frame& frame = facets_.facets[facet].frame;
  const auto height = [&](std::uint32_t vertex) { return dot(welded_.positions[vertex] - frame.origin, frame.normal); };
  const double at_a = height(outline_[outline_edge].a);
  const double at_b = height(outline_[outline_edge].b);
  if ((at_a < 0) == (at_b < 0) || std::abs(at_a - at_b) <= least) {
    return std::nullopt;
  }
  return at_a / (at_a - at_b);
}

bool FacetPlan::contains(const Vec2& point, double slack) const {
  bool found = false;
  for_each_triangle_near(box_around(point, point, slack), [&](const Corners& triangle) {
    bool within = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 side = triangle[(k + 1) % 3] - triangle[k];
      within = within && cross(side, point - triangle[k]) >= -slack * glm::length(side);
    }
    found = found || within;
  });
  return found;
}

}  // namespace radvor
