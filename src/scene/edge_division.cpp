#include "scene/edge_division.h"

#include <algorithm>
#include <numeric>

#include "scene/position_welding.h"

namespace radvor {
namespace {

class Divider {
 public:
  Divider(std::span<const EdgeStop> stops, WeldedScene& welded, Facets& facets, std::pmr::memory_resource* memory)
      : stops_(stops),
        welded_(welded),
        facets_(facets),
        order_(stops.size(), memory),
        result_(memory),
        memory_(memory) {}

  EdgeDivision run() {
    std::iota(order_.begin(), order_.end(), 0u);
    std::ranges::sort(order_, [&](std::uint32_t i, std::uint32_t j) {
      const EdgeStop& x = stops_[i];
      const EdgeStop& y = stops_[j];
      return x.edge != y.edge ? x.edge < y.edge : x.part != y.part ? x.part < y.part : i < j;
    });
    make_pieces();
    replace_uses();
    group_uses(welded_);
    return std::move(result_);
  }

 private:
  void make_pieces() {
    std::pmr::vector<Edge> edges(memory_);
    std::pmr::vector<EdgeKind> kinds(memory_);
    result_.vertices.assign(stops_.size(), k_none);
    std::size_t next = 0;
    for (std::uint32_t e = 0; e < welded_.edges.size(); ++e) {
      const Edge whole = welded_.edges[e];
      result_.first_piece.push_back(static_cast<std::uint32_t>(edges.size()));
      std::uint32_t from = whole.a;
      double from_part = 0;
      const double length = glm::distance(welded_.positions[whole.a], welded_.positions[whole.b]);
      for (; next < order_.size() && stops_[order_[next]].edge == e; ++next) {
        const auto& [edge, part, tolerance] = stops_[order_[next]];
        if ((1 - part) * length <= tolerance) {
          result_.vertices[order_[next]] = whole.b;
          continue;
        }
        if ((part - from_part) * length > tolerance) {
          const std::uint32_t made = add_vertex(whole, part);
          add_piece(from, made, edges);
          from = made;
          from_part = part;
        }
        result_.vertices[order_[next]] = from;
      }
      add_piece(from, whole.b, edges);
      kinds.resize(edges.size(), facets_.edge_kinds[e]);
    }
    result_.first_piece.push_back(static_cast<std::uint32_t>(edges.size()));
    welded_.edges = std::move(edges);
    facets_.edge_kinds = std::move(kinds);
  }

  std::uint32_t add_vertex(const Edge& edge, double part) {
    const Vec3 a = welded_.positions[edge.a];
    const Vec3 b = welded_.positions[edge.b];
    welded_.positions.push_back(a + part * (b - a));
    welded_.precision.push_back(std::max(welded_.precision[edge.a], welded_.precision[edge.b]));
    return static_cast<std::uint32_t>(welded_.positions.size() - 1);
  }

  void add_piece(std::uint32_t from, std::uint32_t to, std::pmr::vector<Edge>& edges) const {
    const bool ordered = lies_before(welded_.positions[from], welded_.positions[to]);
    edges.push_back(ordered ? Edge{from, to} : Edge{to, from});
  }

  void replace_uses() {
    std::pmr::vector<EdgeUse> uses(memory_);
    std::pmr::vector<std::uint32_t> first(memory_);
    for (std::uint32_t t = 0; t < welded_.triangles.size(); ++t) {
      first.push_back(static_cast<std::uint32_t>(uses.size()));
      for (const EdgeUse& use : welded_.uses_of_triangle(t)) {
        const std::uint32_t begin = result_.first_piece[use.edge];
        const std::uint32_t count = result_.first_piece[use.edge + 1] - begin;
        std::uint32_t at = start_of(use, begin, count);
        for (std::uint32_t k = 0; k < count; ++k) {
          const std::uint32_t piece = begin + (use.forward ? k : count - 1 - k);
          const bool forward = welded_.edges[piece].a == at;
          uses.push_back({piece, t, use.side, forward});
          at = forward ? welded_.edges[piece].b : welded_.edges[piece].a;
        }
      }
    }
    first.push_back(static_cast<std::uint32_t>(uses.size()));
    welded_.uses_by_triangle = std::move(uses);
    welded_.first_use = std::move(first);
  }

  // Where the triangle comes to the edge: the end of its first piece that the second does not share.
  std::uint32_t start_of(const EdgeUse& use, std::uint32_t begin, std::uint32_t count) const {
    const Edge& piece = welded_.edges[use.forward ? begin : begin + count - 1];
    if (count == 1) {
      return use.forward ? piece.a : piece.b;
    }
    const Edge& second = welded_.edges[use.forward ? begin + 1 : begin + count - 2];
    return piece.a == second.a || piece.a == second.b ? piece.b : piece.a;
  }

  std::span<const EdgeStop> stops_;
  WeldedScene& welded_;
  Facets& facets_;
  std::pmr::vector<std::uint32_t> order_;  // of stops: by edge, along it
  EdgeDivision result_;
  std::pmr::memory_resource* memory_;
};

}  // namespace

EdgeDivision divide_edges(std::span<const EdgeStop> stops, WeldedScene& welded, Facets& facets,
                          std::pmr::memory_resource* memory) {
  return Divider(stops, welded, facets, memory).run();
}

}  // namespace radvor
