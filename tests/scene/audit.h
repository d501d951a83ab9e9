// What must hold for every welded scene and its facets, checked by brute force where that is affordable.
#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/edge_chains.h"
#include "scene/facets.h"
#include "scene/position_welding.h"
#include "scene/welded.h"

namespace radvor::test {

/// The first defect of the topology in words, or nothing.
inline std::string audit(const WeldedScene& w) {
  std::size_t uses = 0;
  for (std::uint32_t t = 0; t < w.triangles.size(); ++t) {
    const auto outline = w.uses_of_triangle(t);
    std::uint32_t at = w.triangles[t].vertices[0];
    std::vector<std::uint32_t> seen;
    std::uint8_t side = 0;
    for (const EdgeUse& use : outline) {
      const Edge& edge = w.edges[use.edge];
      if (use.triangle != t || (use.forward ? edge.a : edge.b) != at) {
        return "the outline of triangle " + std::to_string(t) + " is not a loop";
      }
      if (use.side != side && at != w.triangles[t].vertices[++side]) {
        return "a side of triangle " + std::to_string(t) + " does not begin at its corner";
      }
      if (use.side != side) {
        return "a use of triangle " + std::to_string(t) + " names the wrong side";
      }
      if (std::ranges::find(seen, at) != seen.end()) {
        return "the outline of triangle " + std::to_string(t) + " touches itself";
      }
      seen.push_back(at);
      at = use.forward ? edge.b : edge.a;
    }
    if (at != w.triangles[t].vertices[0] || side != 2) {
      return "the outline of triangle " + std::to_string(t) + " does not close";
    }
    uses += outline.size();
  }
  for (std::size_t use = uses; use < w.uses_by_triangle.size(); ++use, ++uses) {
    if (w.uses_by_triangle[use].side != k_no_side) {
      return "a use that is no triangle's is no contact's either";
    }
  }
  if (uses != w.uses_of_edge.size()) {
    return "uses are lost";
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (std::uint32_t e = 0; e < w.edges.size(); ++e) {
    const Edge& edge = w.edges[e];
    if (!lies_before(w.positions[edge.a], w.positions[edge.b])) {
      return "edge " + std::to_string(e) + " is not ordered by position";
    }
    if (w.uses_at_edge(e).empty()) {
      return "edge " + std::to_string(e) + " has no use";
    }
    for (const std::uint32_t use : w.uses_at_edge(e)) {
      if (w.uses_by_triangle[use].edge != e) {
        return "edge " + std::to_string(e) + " lists a use of another";
      }
    }
    if (w.uses_by_triangle[w.uses_at_edge(e).front()].side != k_no_side) {
      ends.emplace_back(edge.a, edge.b);  // facets that lie on each other may have the same contacts
    }
  }
  std::ranges::sort(ends);
  if (std::ranges::adjacent_find(ends) != ends.end()) {
    return "an edge exists twice";
  }
  return {};
}

/// Vertices of kept triangles inside edges, by brute force.
inline std::string find_vertex_inside_edge(const WeldedScene& w) {
  const Tolerance tolerance{w.positions, w.precision, w.weld_distance};
  std::set<std::uint32_t> used;
  for (const Triangle& triangle : w.triangles) {
    used.insert(triangle.vertices.begin(), triangle.vertices.end());
  }
  for (std::uint32_t e = 0; e < w.edges.size(); ++e) {
    const Vec3 a = w.positions[w.edges[e].a];
    const Vec3 b = w.positions[w.edges[e].b];
    for (const std::uint32_t v : used) {
      const Vec3 p = w.positions[v];
      const double touching = tolerance.touching(w.edges[e].a, w.edges[e].b, v);
      if (length(cross(p - a, b - a)) < 0.999 * touching * length(b - a) && dot(p - a, b - a) > 0 &&
          dot(p - b, a - b) > 0 && length(p - a) > 3 * touching && length(p - b) > 3 * touching) {
        return "vertex " + std::to_string(v) + " lies inside edge " + std::to_string(e);
      }
    }
  }
  return {};
}

/// Edges run more often one way than the other: where the surface is not closed.
inline std::size_t open_edges(const WeldedScene& w) {
  std::size_t open = 0;
  for (std::uint32_t e = 0; e < w.edges.size(); ++e) {
    int sum = 0;
    for (const std::uint32_t use : w.uses_at_edge(e)) {
      sum += w.uses_by_triangle[use].forward ? 1 : -1;
    }
    open += sum != 0;
  }
  return open;
}

inline std::string audit(const WeldedScene& w, const Facets& f) {
  std::vector<int> owners(w.triangles.size(), 0);
  for (std::uint32_t i = 0; i < f.facets.size(); ++i) {
    const Facet& facet = f.facets[i];
    const auto name = [&] { return "facet " + std::to_string(i); };
    const Frame& frame = facet.frame;
    if (std::abs(length(frame.u) - 1) > 1e-14 || std::abs(length(frame.normal) - 1) > 1e-14 ||
        length(cross(frame.u, frame.v) - frame.normal) > 1e-14 || std::abs(dot(frame.u, frame.normal)) > 1e-14) {
      return name() + " has no orthonormal frame";
    }
    double area = 0;
    double extent = 0;
    for (const std::uint32_t t : f.triangles_of(i)) {
      ++owners[t];
      if (f.facet_of_triangle[t] != i || w.triangles[t].mesh != facet.mesh ||
          w.triangles[t].material != facet.material) {
        return name() + " has a triangle that is not its own";
      }
      Vec2 p[3];
      for (int k = 0; k < 3; ++k) {
        const Vec3& corner = w.positions[w.triangles[t].vertices[static_cast<std::size_t>(k)]];
        p[k] = frame.to_plane(corner);
        extent = std::max({extent, std::abs(p[k].x), std::abs(p[k].y)});
        if (std::fmod(p[k].x, frame.unit) != 0 || std::fmod(p[k].y, frame.unit) != 0) {
          return name() + " is not on its grid";
        }
      }
      const double twice = cross(p[1] - p[0], p[2] - p[0]);
      if (!(twice > 0)) {
        return name() + " has a triangle that does not face its front";
      }
      area += 0.5 * twice;
      for (const Vec3& normal : f.corner_normals[t]) {
        const Vec3 front = cross(w.positions[w.triangles[t].vertices[1]] - w.positions[w.triangles[t].vertices[0]],
                                 w.positions[w.triangles[t].vertices[2]] - w.positions[w.triangles[t].vertices[0]]);
        if (!(std::abs(length(normal) - 1) < 1e-12) || dot(normal, front) < -1e-9 * length(front)) {
          return name() + " has a bad shading normal";
        }
      }
    }
    if (extent > frame.unit * 0x1p40 || extent < frame.unit * 0x1p38) {
      return name() + " has the wrong unit";
    }
    if (std::abs(area - facet.area) > 1e-6 * facet.area + 1e-10 * extent * extent) {
      return name() + " has the wrong area";
    }
  }
  for (std::size_t t = 0; t < owners.size(); ++t) {
    if (owners[t] != 1) {
      return "triangle " + std::to_string(t) + " is in " + std::to_string(owners[t]) + " facets";
    }
  }
  for (std::uint32_t e = 0; e < w.edges.size(); ++e) {
    const auto uses = w.uses_at_edge(e);
    if (w.uses_by_triangle[uses.front()].side == k_no_side &&
        (uses.size() != 1 || f.edge_kinds[e] != EdgeKind::sharp)) {
      return "contact " + std::to_string(e) + " is not one facet's alone";
    }
    const auto facet = [&](std::size_t use) { return f.facet_of_triangle[w.uses_by_triangle[uses[use]].triangle]; };
    const bool inside = f.edge_kinds[e] == EdgeKind::interior || f.edge_kinds[e] == EdgeKind::seam;
    const bool manifold =
        uses.size() == 2 && w.uses_by_triangle[uses[0]].forward != w.uses_by_triangle[uses[1]].forward;
    if (f.edge_kinds[e] != EdgeKind::sharp && !manifold) {
      return "edge " + std::to_string(e) + " is not manifold and not sharp";
    }
    if (manifold && inside && facet(0) != facet(1)) {
      return "edge " + std::to_string(e) + " is interior to two facets";
    }
    if (f.edge_kinds[e] == EdgeKind::smooth && facet(0) == facet(1)) {
      return "edge " + std::to_string(e) + " is smooth inside a facet";
    }
  }
  return {};
}

}  // namespace radvor::test
