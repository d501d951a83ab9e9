#include "scene/plane_traces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/box_tree.h"
#include "scene/shape.h"

namespace radvor {
namespace {

// Edges that rise more steeply above the plane leave what is near it too soon to be worth a trace.
constexpr double k_steepest = 0.5;
// A triangle whose projection is no thicker than this part of its edge is upright above the edge.
constexpr double k_upright = 1e-4;

}  // namespace

TracedPlane::TracedPlane(const WeldedScene& welded, const Facets& facets, std::uint32_t facet, bool two_sided,
                         double reach)
    : welded_(welded),
      facets_(facets),
      facet_(facet),
      frame_(facets.facets[facet].frame),
      two_sided_(two_sided),
      reach_(reach) {
  Box box;
  for (const std::uint32_t t : facets.triangles_of(facet)) {
    for (const std::uint32_t vertex : welded.triangles[t].vertices) {
      box.add(welded.positions[vertex]);
      precision_ = std::max(precision_, welded.precision[vertex]);
    }
  }
  size_ = length(box.high - box.low);
  tolerance_ = planar_tolerance(precision_, size_);
}

bool TracedPlane::lies_in_plane(std::uint32_t vertex) const {
  return std::abs(height(welded_.positions[vertex])) <=
         planar_tolerance(std::max(precision_, welded_.precision[vertex]), size_);
}

bool TracedPlane::lies_in_plane(const Triangle& triangle) const {
  return std::ranges::all_of(triangle.vertices, [&](std::uint32_t vertex) { return lies_in_plane(vertex); });
}

void TracedPlane::trace(std::uint32_t index, std::pmr::vector<Trace>& traces) const {
  if (facets_.facet_of_triangle[index] == facet_) {
    return;
  }
  const Triangle& triangle = welded_.triangles[index];
  std::array<Corner, 3> corners;
  int low = 1;
  int high = -1;
  int in_plane = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    Corner& corner = corners[k];
    corner.position = welded_.positions[triangle.vertices[k]];
    corner.height = height(corner.position);
    corner.side = lies_in_plane(triangle.vertices[k]) ? 0 : corner.height > 0 ? 1 : -1;
    low = std::min(low, corner.side);
    high = std::max(high, corner.side);
    in_plane += corner.side == 0 ? 1 : 0;
  }
  if (in_plane < 3 && high < 1 && !two_sided_) {
    return;
  }
  if (low < 0 && high > 0) {
    trace_cut(index, corners, traces);
  } else if (in_plane >= 2) {
    trace_edges(index, traces);
  }
  if (reach_ > 0 && in_plane < 3) {
    trace_near(index, traces);
  }
}

// From where one side of the triangle crosses the plane to where another does; a corner in the plane is such a place.
void TracedPlane::trace_cut(std::uint32_t triangle, const std::array<Corner, 3>& corners,
                            std::pmr::vector<Trace>& traces) const {
  std::array<Vec2, 2> ends;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3 && count < 2; ++k) {
    const Corner& from = corners[k];
    const Corner& to = corners[(k + 1) % 3];
    if (from.side == 0) {
      ends[count++] = project(from.position);
    } else if (from.side * to.side < 0) {
      // From below to above, so that both triangles at a side find the same point.
      const Corner& below = from.height < to.height ? from : to;
      const Corner& above = from.height < to.height ? to : from;
      const double part = below.height / (below.height - above.height);
      ends[count++] = project(below.position + part * (above.position - below.position));
    }
  }
  if (count == 2) {
    traces.push_back({ends[0], ends[1], 0.0, facets_.facet_of_triangle[triangle]});
  }
}

// The welded edges of a triangle that lie in the plane: one side of it, or all where the triangle does itself.
void TracedPlane::trace_edges(std::uint32_t triangle, std::pmr::vector<Trace>& traces) const {
  for (const EdgeUse& use : welded_.uses_of_triangle(triangle)) {
    const Edge& edge = welded_.edges[use.edge];
    if (lies_in_plane(edge.a) && lies_in_plane(edge.b) && is_end_of_contact(use.edge)) {
      traces.push_back({project(welded_.positions[edge.a]), project(welded_.positions[edge.b]), 0.0,
                        facets_.facet_of_triangle[triangle]});
    }
  }
}

// The parts of a triangle's edges that are above the plane and near it, where the surface they bound ends as seen along
// the normal: there the light on the plane changes within about the gap.
void TracedPlane::trace_near(std::uint32_t triangle, std::pmr::vector<Trace>& traces) const {
  for (const EdgeUse& use : welded_.uses_of_triangle(triangle)) {
    if (facets_.edge_kinds[use.edge] != EdgeKind::sharp) {
      continue;
    }
    const Vec3& a = welded_.positions[welded_.edges[use.edge].a];
    const Vec3& b = welded_.positions[welded_.edges[use.edge].b];
    const double height_a = height(a);
    const double height_b = height(b);
    if (two_sided_ ? height_a * height_b < 0 : std::min(height_a, height_b) < -tolerance_) {
      continue;
    }
    const double gap_a = std::abs(height_a);
    const double rise = std::abs(height_b) - gap_a;
    const Vec2 from = project(a);
    const Vec2 along = project(b) - from;
    if (std::min(gap_a, gap_a + rise) > reach_ || std::max(gap_a, gap_a + rise) <= tolerance_ ||
        std::abs(rise) > k_steepest * length(along) || !is_silhouette(use.edge)) {
      continue;
    }
    const double top = (reach_ - gap_a) / rise;  // where it leaves what is near
    const double begin = rise < 0 ? std::max(0.0, top) : 0.0;
    const double end = rise > 0 ? std::min(1.0, top) : 1.0;
    traces.push_back({from + begin * along, from + end * along, gap_a + 0.5 * (begin + end) * rise, k_none});
  }
}

// Whether the surface at a sharp edge is on one side of it alone, as seen along the normal.
bool TracedPlane::is_silhouette(std::uint32_t edge) const {
  const Vec2 a = project(welded_.positions[welded_.edges[edge].a]);
  const Vec2 along = project(welded_.positions[welded_.edges[edge].b]) - a;
  bool left = false;
  bool right = false;
  for (const std::uint32_t use : welded_.uses_at_edge(edge)) {
    const std::uint32_t triangle = welded_.uses_by_triangle[use].triangle;
    if (facets_.facet_of_triangle[triangle] == facet_) {
      return false;
    }
    double farthest = 0;
    for (const std::uint32_t vertex : welded_.triangles[triangle].vertices) {
      const double side = cross(along, project(welded_.positions[vertex]) - a);
      farthest = std::abs(side) > std::abs(farthest) ? side : farthest;
    }
    left = left || farthest > k_upright * dot(along, along);
    right = right || farthest < -k_upright * dot(along, along);
  }
  return !(left && right);
}

// No edge of the facet's own, and none across which a surface that lies in the plane goes on in it.
bool TracedPlane::is_end_of_contact(std::uint32_t edge) const {
  std::size_t flat = 0;
  const auto uses = welded_.uses_at_edge(edge);
  for (const std::uint32_t use : uses) {
    const std::uint32_t triangle = welded_.uses_by_triangle[use].triangle;
    if (facets_.facet_of_triangle[triangle] == facet_) {
      return false;
    }
    flat += lies_in_plane(welded_.triangles[triangle]) ? 1 : 0;
  }
  return uses.size() != 2 || flat < 2;
}

}  // namespace radvor
