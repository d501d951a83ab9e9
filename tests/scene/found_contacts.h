// What is found where surfaces touch and cut each other, put so that tests can ask for it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "scene/audit.h"
#include "scene/shape.h"
#include "scene/shapes.h"
#include "support/made_facets.h"

namespace radvor::test {

/// The contacts of a scene.
struct Found : MadeFacets {
  explicit Found(const Scene& given, double spacing = 0.01, double least = 0, std::uint32_t threads = 2,
                 double reach = 0)
      : MadeFacets(given, threads), vertices_before(welded.positions.size()) {
    add_contacts({spacing, least, reach});
    EXPECT_EQ(audit(welded), "");
    EXPECT_EQ(audit(welded, facets), "");
  }

  // The facet whose plane has this normal and that holds the point.
  std::uint32_t facet_at(const Vec3& point, const Vec3& normal) const {
    for (std::uint32_t t = 0; t < welded.triangles.size(); ++t) {
      const Vec3 weights = barycentric(positions_of(welded, welded.triangles[t]), point);
      const Frame& frame = facets.facets[facets.facet_of_triangle[t]].frame;
      if (dot(frame.normal, normal) > 0.99 && std::abs(dot(point - frame.origin, frame.normal)) < 1e-6 &&
          std::min({weights.x, weights.y, weights.z}) > -1e-9) {
        return facets.facet_of_triangle[t];
      }
    }
    ADD_FAILURE() << "no facet there";
    return 0;
  }

  // Ends in space, rounded to thousandths, the lower first: sorted.
  using Line = std::array<int, 6>;
  std::vector<Line> lines_on(std::uint32_t facet) const {
    std::vector<Line> lines;
    for (const ContactEdge& contact : facets.contacts.of_facet(facet)) {
      const Edge& edge = welded.edges[contact.edge];
      std::array<std::array<int, 3>, 2> ends;
      for (std::size_t k = 0; k < 2; ++k) {
        const Vec3 p = welded.positions[k == 0 ? edge.a : edge.b];
        ends[k] = {int(std::lround(p.x * 1000)), int(std::lround(p.y * 1000)), int(std::lround(p.z * 1000))};
      }
      if (ends[1] < ends[0]) {
        std::swap(ends[0], ends[1]);
      }
      lines.push_back({ends[0][0], ends[0][1], ends[0][2], ends[1][0], ends[1][1], ends[1][2]});
    }
    std::ranges::sort(lines);
    return lines;
  }
  // Vertices of a facet's contacts that lie on its outline.
  std::set<std::uint32_t> ends_on_outline(std::uint32_t facet) const {
    std::set<std::uint32_t> outline;
    for (const std::uint32_t t : facets.triangles_of(facet)) {
      for (const EdgeUse& use : welded.uses_of_triangle(t)) {
        outline.insert({welded.edges[use.edge].a, welded.edges[use.edge].b});
      }
    }
    std::set<std::uint32_t> found;
    for (const ContactEdge& contact : facets.contacts.of_facet(facet)) {
      for (const std::uint32_t v : {welded.edges[contact.edge].a, welded.edges[contact.edge].b}) {
        if (outline.contains(v)) {
          found.insert(v);
        }
      }
    }
    return found;
  }
  // Vertices that divide edges of triangles.
  std::size_t divisions() const {
    std::set<std::uint32_t> dividing;
    for (std::uint32_t use = 0; use < welded.first_use.back(); ++use) {
      const Edge& edge = welded.edges[welded.uses_by_triangle[use].edge];
      for (const std::uint32_t v : {edge.a, edge.b}) {
        if (v >= vertices_before) {
          dividing.insert(v);
        }
      }
    }
    return dividing.size();
  }

  std::size_t vertices_before;
};

inline std::pmr::memory_resource* heap() {
  return std::pmr::get_default_resource();
}

inline SceneBuilder& floor_of(SceneBuilder& builder, float size) {
  return builder.polygon({{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}});
}

}  // namespace radvor::test
