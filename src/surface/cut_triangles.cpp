#include "surface/cut_triangles.h"

#include <algorithm>

#include "surface/receiver_point.h"
#include "surface/triangle_cells.h"

namespace radvor {

namespace {

// A site on the boundary of a source triangle. Sides are bits: a corner lies on two.
struct RimPoint {
  std::uint32_t site;
  std::uint32_t vertex;  // welded, or k_none
  Vec3 position;
  std::uint8_t side;  // of the piece of rim that begins here
  std::uint8_t sides;
};

class TriangleCutter {
 public:
  TriangleCutter(const FacetInput& input, std::pmr::vector<ShareTriangle>& triangles, FacetDraft& draft)
      : in_(input),
        triangles_(triangles),
        draft_(draft),
        rim_(input.memory),
        open_(input.memory),
        piece_of_rim_(input.memory),
        first_share_(input.memory),
        inner_pieces_(input.memory) {}

  void cut(std::uint32_t triangle) {
    collect_rim(triangle);
    first_share_.assign(rim_.size(), k_none);
    piece_of_rim_.assign(rim_.size(), {k_none, k_none});
    open_.resize(rim_.size());
    for (std::uint32_t k = 0; k < open_.size(); ++k) {
      open_[k] = k;
    }
    while (open_.size() > 3) {
      cut_ear(triangle);
    }
    add_triangle(triangle, {open_[0], open_[1], open_[2]});
    record_pieces(triangle);
  }

  // Shares on both sides of an edge inside the facet belong to one sample.
  void join_inside() {
    std::sort(inner_pieces_.begin(), inner_pieces_.end(), [](const BorderPiece& a, const BorderPiece& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.index != b.index ? a.index < b.index : a.low < b.low;
    });
    for (std::size_t k = 1; k < inner_pieces_.size(); ++k) {
      const BorderPiece& one = inner_pieces_[k - 1];
      const BorderPiece& other = inner_pieces_[k];
      if (one.edge == other.edge && one.index == other.index) {
        draft_.joined.push_back({one.low, other.low});
        draft_.joined.push_back({one.high, other.high});
      }
    }
  }

 private:
  void collect_rim(std::uint32_t triangle) {
    rim_.clear();
    for (const EdgeUse& use : in_.welded.uses_of_triangle(triangle)) {
      const Edge& edge = in_.welded.edges[use.edge];
      const std::uint32_t vertex = use.forward ? edge.a : edge.b;
      rim_.push_back({in_.borders.at_vertex(vertex), vertex, in_.welded.positions[vertex], use.side, bit(use.side)});
      const auto sites = in_.borders.on_edge(use.edge);
      const EdgeLine line = in_.borders.line(use.edge);
      for (std::size_t k = 0; k < sites.size(); ++k) {
        const EdgeSite& site = sites[use.forward ? k : sites.size() - 1 - k];
        rim_.push_back({site.site, k_none, line.position(in_.borders.from_middle(site.step)), use.side, bit(use.side)});
      }
    }
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      rim_[k].sides = static_cast<std::uint8_t>(rim_[k].sides | bit(rim_[(k + rim_.size() - 1) % rim_.size()].side));
    }
  }

  // Cuts off the corner with the shortest diagonal, among those that leave no triangle, and no rest, on one side of
  // the source triangle. The rim is convex, so there is one.
  void cut_ear(std::uint32_t triangle) {
    std::size_t best = open_.size();
    double shortest = 0;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const RimPoint& last = at(k + open_.size() - 1);
      const RimPoint& next = at(k + 1);
      const double length = glm::distance(last.position, next.position);
      if ((best == open_.size() || length < shortest) && (last.sides & at(k).sides & next.sides) == 0 &&
          rest_spreads(k)) {
        best = k;
        shortest = length;
      }
    }
    best = best == open_.size() ? 0 : best;
    add_triangle(triangle, {index(best + open_.size() - 1), index(best), index(best + 1)});
    open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(best));
  }

  bool rest_spreads(std::size_t without) const {
    std::uint8_t common = 7;
    for (std::size_t k = 0; k < open_.size(); ++k) {
      common = k == without ? common : static_cast<std::uint8_t>(common & at(k).sides);
    }
    return common == 0;
  }

  void add_triangle(std::uint32_t triangle, const std::array<std::uint32_t, 3>& corners) {
    const auto first = static_cast<std::uint32_t>(draft_.shares.size());
    std::array<Vec2, 3> points;
    for (std::uint32_t k = 0; k < 3; ++k) {
      points[k] = in_.facet().frame.to_plane(rim_[corners[k]].position);
    }
    const auto cells = triangle_cells(points);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const RimPoint& point = rim_[corners[k]];
      FacetShare& share = draft_.shares.emplace_back();
      share.vertex = first + k;
      share.site = point.site;
      share.inner_vertex = point.site == k_none ? point.vertex : k_none;
      share.source = {triangle, point.side};
      share.position = points[k];
      share.centroid = cells[k].centroid;
      share.receiver = points[k] + k_nudge * (cells[k].centroid - points[k]);
      share.area = cells[k].area;
      std::uint32_t& known = first_share_[corners[k]];
      if (known == k_none) {
        known = first + k;
      } else {
        draft_.joined.push_back({known, first + k});
      }
      if (corners[(k + 1) % 3] == (corners[k] + 1) % rim_.size()) {
        piece_of_rim_[corners[k]] = {first + k, first + (k + 1) % 3};
      }
    }
    triangles_.push_back({first, first + 1, first + 2});
  }

  void record_pieces(std::uint32_t triangle) {
    std::size_t at = 0;
    for (const EdgeUse& use : in_.welded.uses_of_triangle(triangle)) {
      const EdgeKind kind = in_.facets.edge_kinds[use.edge];
      const std::uint32_t count = in_.borders.count_on_edge(use.edge) + 1;
      for (std::uint32_t k = 0; k < count; ++k, ++at) {
        const auto& [from, to] = piece_of_rim_[at];
        const std::uint32_t index = use.forward ? k : count - 1 - k;
        const BorderPiece piece{use.edge, index, use.forward ? from : to, use.forward ? to : from};
        if (kind == EdgeKind::interior || kind == EdgeKind::seam) {
          inner_pieces_.push_back(piece);
        } else if (in_.borders.joins(use.edge)) {
          draft_.pieces.push_back(piece);
        }
      }
    }
  }

  static std::uint8_t bit(std::uint8_t side) { return static_cast<std::uint8_t>(1u << side); }
  std::uint32_t index(std::size_t k) const { return open_[k % open_.size()]; }
  const RimPoint& at(std::size_t k) const { return rim_[index(k)]; }

  const FacetInput& in_;
  std::pmr::vector<ShareTriangle>& triangles_;
  FacetDraft& draft_;
  std::pmr::vector<RimPoint> rim_;                               // counter-clockwise, a corner first
  std::pmr::vector<std::uint32_t> open_;                         // what is left of it
  std::pmr::vector<std::array<std::uint32_t, 2>> piece_of_rim_;  // shares at the ends of the piece after each point
  std::pmr::vector<std::uint32_t> first_share_;                  // per rim point
  std::pmr::vector<BorderPiece> inner_pieces_;
};

}  // namespace

void cut_triangles(const FacetInput& input, std::pmr::vector<ShareTriangle>& triangles, FacetDraft& draft) {
  TriangleCutter cutter(input, triangles, draft);
  for (const std::uint32_t triangle : input.facets.triangles_of(input.index)) {
    cutter.cut(triangle);
  }
  cutter.join_inside();
}

}  // namespace radvor
