#include "scene/plane_traces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/box_tree.h"
#include "scene/shape.h"

namespace radvor {

TracedPlane::TracedPlane(const WeldedScene& welded, const Facets& facets, std::uint32_t facet, bool two_sided)
    : welded_(welded), facets_(facets), facet_(facet), frame_(facets.facets[facet].frame), two_sided_(two_sided) {
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
    trace_cut(corners, traces);
  } else if (in_plane >= 2) {
    trace_edges(index, traces);
  }
}

// From where one side of the triangle crosses the plane to where another does; a corner in the plane is such a place.
void TracedPlane::trace_cut(const std::array<Corner, 3>& corners, std::pmr::vector<Trace>& traces) const {
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
    traces.push_back({ends[0], ends[1], 0.0});
  }
}

// The welded edges of a triangle that lie in the plane: one side of it, or all where the triangle does itself.
void TracedPlane::trace_edges(std::uint32_t triangle, std::pmr::vector<Trace>& traces) const {
  for (const EdgeUse& use : welded_.uses_of_triangle(triangle)) {
    const Edge& edge = welded_.edges[use.edge];
    if (lies_in_plane(edge.a) && lies_in_plane(edge.b) && is_end_of_contact(use.edge)) {
      traces.push_back({project(welded_.positions[edge.a]), project(welded_.positions[edge.b]), 0.0});
    }
  }
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
