#include "surface/facet_mesh.h"

#include <algorithm>
#include <cmath>

#include "delaunay/tie_polygon.h"
#include "surface/cut_triangles.h"
#include "surface/facet_triangulator.h"

namespace radvor {

FacetMesh::FacetMesh(const FacetInput& input, FacetDraft& draft)
    : quick_(input.memory),
      triangles_(input.memory),
      plain_triangles_(input.memory),
      next_in_polygon_(input.memory),
      index_of_triangle_(input.memory),
      first_share_(input.memory),
      sites_(input.memory) {
  if (!FacetTriangulator(input, *this, draft).run()) {
    cut_triangles(input, triangles_, draft);
  }
}

bool FacetMesh::needed(const FacetInput& input) {
  if (!input.given.empty() || (input.inner && !input.inner->empty())) {
    return true;
  }
  const auto triangles = input.facets.triangles_of(input.index);
  const auto uses = input.welded.uses_of_triangle(triangles.front());
  return triangles.size() != 1 || uses.size() != 3 || !input.facets.contacts.of_facet(input.index).empty() ||
         std::any_of(uses.begin(), uses.end(),
                     [&](const EdgeUse& use) { return input.borders.count_on_edge(use.edge) != 0; });
}

void FacetMesh::number_shares(std::uint32_t first) {
  if (first == 0) {
    return;
  }
  for (auto* triangles : {&triangles_, &plain_triangles_}) {
    for (ShareTriangle& triangle : *triangles) {
      for (std::uint32_t& share : triangle) {
        share += first;
      }
    }
  }
  for (std::uint32_t& share : first_share_) {
    share += first;
  }
}

std::span<const Vec2> FacetMesh::cell(std::uint32_t vertex, std::uint32_t share, delaunay::CellBuffer& buffer) const {
  bounded_cell(*delaunay_, vertex, buffer);
  return buffer.polygon(buffer.sectors()[share - first_share_[vertex]]);
}

std::uint32_t FacetMesh::locate(const Vec2& point) const {
  const delaunay::Location location = delaunay_->locate(point);
  if (location.edge != delaunay::k_none) {
    // The triangle itself; where it lies outside of the domain, one round its corners that the point is in but for
    // rounding.
    const std::uint32_t found = index_of_triangle_[delaunay::triangle_of(location.edge)];
    if (found != k_none) {
      return found;
    }
    for (const delaunay::VertexId vertex : delaunay_->triangle(delaunay::triangle_of(location.edge))) {
      std::uint32_t beside = k_none;
      if (vertex != delaunay::k_infinite) {
        delaunay_->for_each_inside_triangle(vertex, [&](delaunay::TriangleId t) {
          const auto weights = delaunay_->barycentric(t, point);
          constexpr double k_rounding = 1e-9;
          if (std::min({weights[0], weights[1], weights[2]}) >= -k_rounding) {
            beside = index_of_triangle_[t];
          }
        });
      }
      if (beside != k_none) {
        return beside;
      }
    }
  }
  return nearest_triangle(point);
}

Ties FacetMesh::align_ties(std::span<const double> value_of, double tolerance, std::pmr::memory_resource* memory) {
  Ties ties;
  if (plain_triangles_.empty()) {
    plain_triangles_ = triangles_;
    next_in_polygon_.resize(triangles_.size());
    quick_.clear();
  } else {
    triangles_ = plain_triangles_;
  }
  for (std::uint32_t k = 0; k < next_in_polygon_.size(); ++k) {
    next_in_polygon_[k] = k;
  }
  delaunay::TiePolygon polygon(memory);
  std::pmr::vector<std::uint8_t> seen(index_of_triangle_.size(), std::uint8_t{0}, memory);
  std::pmr::vector<std::uint32_t> shares(memory);
  std::pmr::vector<double> values(memory);
  for (delaunay::TriangleId t = 0; t < index_of_triangle_.size(); ++t) {
    if (index_of_triangle_[t] == k_none || seen[t] != 0 || polygon.collect_near(*delaunay_, t, tolerance, seen) == 3) {
      continue;
    }
    ++ties.count;
    for (const delaunay::TriangleId part : polygon.triangles()) {
      seen[part] = 1;
    }
    shares.clear();
    values.clear();
    for (std::size_t k = 0; k < polygon.corners().size(); ++k) {
      const delaunay::HalfEdge h = polygon.side(*delaunay_, k);
      shares.push_back(plain_triangles_[index_of_triangle_[delaunay::triangle_of(h)]][delaunay::corner_of(h)]);
      values.push_back(value_of[shares.back()]);
    }
    if (polygon.resolve(*delaunay_, values)) {
      ++ties.realigned;
      const auto parts = polygon.triangles();
      std::size_t part = 0;
      polygon.for_each_decided([&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const std::uint32_t slot = index_of_triangle_[parts[part]];
        part = (part + 1) % parts.size();
        triangles_[slot] = {shares[a], shares[b], shares[c]};
        next_in_polygon_[slot] = index_of_triangle_[parts[part]];
      });
    }
  }
  return ties;
}

std::uint32_t FacetMesh::nearest_triangle(const Vec2& point) const {
  std::uint32_t nearest = 0;
  double least = HUGE_VAL;
  for (delaunay::TriangleId t = 0; t < index_of_triangle_.size(); ++t) {
    if (index_of_triangle_[t] == k_none) {
      continue;
    }
    const auto corners = delaunay_->triangle(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = delaunay_->position(corners[k]);
      const Vec2 along = delaunay_->position(corners[(k + 1) % 3]) - a;
      const double part = std::clamp(glm::dot(point - a, along) / glm::dot(along, along), 0.0, 1.0);
      const double distance = glm::distance(point, a + part * along);
      if (distance < least) {
        least = distance;
        nearest = index_of_triangle_[t];
      }
    }
  }
  return nearest;
}

}  // namespace radvor
