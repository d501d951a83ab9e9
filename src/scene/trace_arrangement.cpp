#include "scene/trace_arrangement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "scene/box_tree.h"
#include "scene/disjoint_sets.h"
#include "scene/welded.h"

namespace radvor {
namespace {

// Clusters may move points by a little more than the tolerance that they were found with.
constexpr double k_on_trace = 1.25;
// Pieces on the outline are gone when the rest is asked whether it is inside.
constexpr double k_beside_outline = 0.25;

// An edge that rises no more above a plane, in tolerances, may lie in it.
constexpr double k_parallel = 4;

// Of a trace beside the outline, in tolerances: down to angles of two degrees.
constexpr double k_graze = 32;

Box box_around(const Vec2& a, const Vec2& b, double margin) {
  Box box;
  box.add(Vec3(glm::min(a, b) - margin, 0.0));
  box.add(Vec3(glm::max(a, b) + margin, 0.0));
  return box;
}

// What is known best about where a point is comes first: it stands for those that are near.
enum class Rank : std::uint8_t {
  corner,      // of the outline
  cut,         // of the outline by a plane, the same for all facets there
  on_outline,  // where something ends near it
  inside,
};

struct Candidate {
  GraphPoint point;
  Rank rank;
};

struct Nearest {
  double part, distance;
};

Nearest nearest_on(const Vec2& a, const Vec2& b, const Vec2& point) {
  const Vec2 along = b - a;
  const double square = dot(along, along);
  const double part = square > 0 ? std::clamp(dot(point - a, along) / square, 0.0, 1.0) : 0.0;
  return {part, glm::distance(point, a + part * along)};
}

class Arranger {
 public:
  Arranger(const FacetPlan& plan, std::span<const Trace> traces, const ArrangementLimits& limits,
           std::pmr::memory_resource* memory)
      : plan_(plan), traces_(traces), limits_(limits), memory_(memory), candidates_(memory), graph_(memory) {}

  TraceGraph run() {
    find_candidates();
    cluster();
    cut_traces();
    leave_outline();
    join_collinear();
    drop_small();
    drop_grazes();
    drop_unused();
    return std::move(graph_);
  }

 private:
  void find_candidates() {
    std::pmr::vector<Box> boxes(memory_);
    for (const Trace& trace : traces_) {
      boxes.push_back(box_around(trace.a, trace.b, limits_.tolerance));
    }
    const BoxTree tree(boxes, memory_);
    for (std::uint32_t i = 0; i < traces_.size(); ++i) {
      const Trace& trace = traces_[i];
      add_candidate(trace.a);
      add_candidate(trace.b);
      tree.walk([&](const Box& box) { return box.overlaps(boxes[i]); },
                [&](std::uint32_t j) {
                  if (j > i) {
                    add_crossing(trace, traces_[j].a, traces_[j].b);
                  }
                });
      plan_.for_each_edge_near(trace.a, trace.b, limits_.tolerance, [&](std::uint32_t e) {
        const PlanEdge& edge = plan_.outline()[e];
        if (!add_cut(trace, e)) {
          add_crossing(trace, edge.from, edge.to);
        }
        for (const Vec2& corner : {edge.from, edge.to}) {
          if (nearest_on(trace.a, trace.b, corner).distance <= limits_.tolerance) {
            add_candidate(corner);
          }
        }
      });
    }
  }

  void add_crossing(const Trace& trace, const Vec2& a, const Vec2& b) {
    const Vec2 along = trace.b - trace.a;
    const Vec2 other = b - a;
    const double across = cross(along, other);
    const double part = cross(a - trace.a, other) / across;
    const double other_part = cross(a - trace.a, along) / across;
    if (part > 0 && part < 1 && other_part > 0 && other_part < 1) {  // false where they are parallel
      add_candidate(trace.a + part * along);
    }
  }

  // Where the plane that left a trace cuts an edge of the outline; false where that is not on the trace.
  bool add_cut(const Trace& trace, std::uint32_t e) {
    if (trace.facet == k_none) {
      return false;
    }
    const std::optional<double> part = plan_.cut_by(e, trace.facet, k_parallel * limits_.tolerance);
    const PlanEdge& edge = plan_.outline()[e];
    if (!part) {
      return false;
    }
    const Vec2 point = edge.from + *part * (edge.to - edge.from);
    if (nearest_on(trace.a, trace.b, point).distance > limits_.tolerance) {
      return false;
    }
    add(point, {{point, k_none, e, *part}, Rank::cut});
    return true;
  }

  void add_candidate(const Vec2& point) { add(point, {{point, k_none, k_none, 0}, Rank::inside}); }

  // As a corner of the outline where it is near one, else as a point of an edge of it, else by itself.
  void add(const Vec2& point, Candidate found) {
    double nearest_corner = limits_.tolerance;
    double nearest_edge = limits_.tolerance;
    plan_.for_each_edge_near(point, point, limits_.tolerance, [&](std::uint32_t e) {
      const PlanEdge& edge = plan_.outline()[e];
      for (const auto& [corner, vertex] : {std::pair(edge.from, edge.a), std::pair(edge.to, edge.b)}) {
        const double distance = glm::distance(point, corner);
        if (distance <= nearest_corner) {
          nearest_corner = distance;
          found = {{corner, vertex, k_none, 0}, Rank::corner};
        }
      }
      const Nearest on = nearest_on(edge.from, edge.to, point);
      if (found.rank >= Rank::on_outline && on.distance <= nearest_edge) {
        nearest_edge = on.distance;
        found = {{edge.from + on.part * (edge.to - edge.from), k_none, e, on.part}, Rank::on_outline};
      }
    });
    candidates_.push_back(found);
  }

  // Points that chains of short distances connect become the best of them. Swept in a direction that few things in a
  // scene are at right angles to.
  void cluster() {
    const Vec2 direction(0.8480480961564261, 0.5299192642332049);
    std::pmr::vector<std::pair<double, std::uint32_t>> order(memory_);
    for (std::uint32_t i = 0; i < candidates_.size(); ++i) {
      order.emplace_back(dot(candidates_[i].point.position, direction), i);
    }
    std::ranges::sort(order);
    DisjointSets sets(static_cast<std::uint32_t>(candidates_.size()), memory_);
    for (std::size_t i = 0, first = 0; i < order.size(); ++i) {
      while (order[i].first - order[first].first > limits_.tolerance) {
        ++first;
      }
      for (std::size_t j = first; j < i; ++j) {
        if (glm::distance(candidates_[order[i].second].point.position, candidates_[order[j].second].point.position) <=
            limits_.tolerance) {
          sets.unite(order[i].second, order[j].second);
        }
      }
    }
    std::pmr::vector<std::uint32_t> best(candidates_.size(), k_none, memory_);
    for (std::uint32_t i = 0; i < candidates_.size(); ++i) {
      std::uint32_t& leader = best[sets.find(i)];
      leader = leader == k_none || candidates_[i].rank < candidates_[leader].rank ? i : leader;
    }
    for (const std::uint32_t leader : best) {
      if (leader != k_none) {
        graph_.points.push_back(candidates_[leader].point);
      }
    }
  }

  void cut_traces() {
    std::pmr::vector<Box> boxes(memory_);
    for (const GraphPoint& point : graph_.points) {
      boxes.push_back(box_around(point.position, point.position, 0.0));
    }
    const BoxTree tree(boxes, memory_);
    const double reach = k_on_trace * limits_.tolerance;
    std::pmr::vector<std::pair<double, std::uint32_t>> stops(memory_);
    for (const Trace& trace : traces_) {
      stops.clear();
      const Box near = box_around(trace.a, trace.b, reach);
      tree.walk([&](const Box& box) { return box.overlaps(near); },
                [&](std::uint32_t i) {
                  const Nearest on = nearest_on(trace.a, trace.b, graph_.points[i].position);
                  if (on.distance <= reach) {
                    stops.emplace_back(on.part, i);
                  }
                });
      std::ranges::sort(stops);
      for (std::size_t k = 1; k < stops.size(); ++k) {
        const auto [low, high] = std::minmax(stops[k - 1].second, stops[k].second);
        graph_.segments.push_back({low, high, trace.gap});
      }
    }
    keep_each_once();
  }

  // With the smallest gap.
  void keep_each_once() {
    auto& segments = graph_.segments;
    std::ranges::sort(segments, [](const GraphSegment& x, const GraphSegment& y) {
      return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.gap < y.gap;
    });
    const auto same = [](const GraphSegment& x, const GraphSegment& y) { return x.a == y.a && x.b == y.b; };
    segments.erase(std::unique(segments.begin(), segments.end(), same), segments.end());
  }

  void leave_outline() {
    const auto is_inside = [](const GraphPoint& point) { return point.vertex == k_none && point.edge == k_none; };
    std::erase_if(graph_.segments, [&](const GraphSegment& segment) {
      const GraphPoint& a = graph_.points[segment.a];
      const GraphPoint& b = graph_.points[segment.b];
      const std::uint32_t edge = outline_edge_along(a.position, b.position);
      if (edge != k_none) {
        if (!is_inside(a) && !is_inside(b)) {
          graph_.covered.push_back({edge, segment.a, segment.b});
        }
        return true;
      }
      return !plan_.contains(0.5 * (a.position + b.position), k_beside_outline * limits_.tolerance);
    });
  }

  // By distance alone: corners of the outline may be nearer to each other than the tolerance, and then stand for each
  // other.
  std::uint32_t outline_edge_along(const Vec2& a, const Vec2& b) const {
    const double near = k_on_trace * limits_.tolerance;
    std::uint32_t found = k_none;
    plan_.for_each_edge_near(0.5 * (a + b), 0.5 * (a + b), near, [&](std::uint32_t e) {
      const PlanEdge& edge = plan_.outline()[e];
      if (distance_to_segment(a, edge.from, edge.to) <= near && distance_to_segment(b, edge.from, edge.to) <= near) {
        found = std::min(found, e);
      }
    });
    return found;
  }

  // Takes out points inside the facet where exactly two pieces of about the same line meet.
  void join_collinear() {
    auto& segments = graph_.segments;
    struct Ends {
      std::array<std::uint32_t, 2> segments{k_none, k_none};
      std::uint32_t count = 0;
    };
    std::pmr::vector<Ends> at(graph_.points.size(), Ends{}, memory_);
    const auto attach = [&](std::uint32_t point, std::uint32_t segment) {
      if (at[point].count < 2) {
        at[point].segments[at[point].count] = segment;
      }
      ++at[point].count;
    };
    for (std::uint32_t s = 0; s < segments.size(); ++s) {
      attach(segments[s].a, s);
      attach(segments[s].b, s);
    }
    std::pmr::vector<bool> gone(segments.size(), false, memory_);
    for (std::uint32_t p = 0; p < graph_.points.size(); ++p) {
      const GraphPoint& point = graph_.points[p];
      if (point.vertex != k_none || point.edge != k_none || at[p].count != 2) {
        continue;
      }
      GraphSegment& kept = segments[at[p].segments[0]];
      const GraphSegment& other = segments[at[p].segments[1]];
      const std::uint32_t from = kept.a == p ? kept.b : kept.a;
      const std::uint32_t to = other.a == p ? other.b : other.a;
      const Nearest on = nearest_on(graph_.points[from].position, graph_.points[to].position, point.position);
      if (from == to || kept.gap != other.gap || on.distance > limits_.tolerance || on.part <= 0 || on.part >= 1) {
        continue;
      }
      gone[at[p].segments[1]] = true;
      for (std::uint32_t& segment : at[to].segments) {
        segment = segment == at[p].segments[1] ? at[p].segments[0] : segment;
      }
      kept = {from, to, kept.gap};
    }
    std::uint32_t index = 0;
    std::erase_if(segments, [&](const GraphSegment&) { return bool(gone[index++]); });
  }

  void drop_small() {
    DisjointSets sets(static_cast<std::uint32_t>(graph_.points.size()), memory_);
    for (const GraphSegment& segment : graph_.segments) {
      sets.unite(segment.a, segment.b);
    }
    std::pmr::vector<Box> boxes(graph_.points.size(), memory_);
    for (const GraphSegment& segment : graph_.segments) {
      for (const std::uint32_t point : {segment.a, segment.b}) {
        boxes[sets.find(point)].add(Vec3(graph_.points[point].position, 0.0));
      }
    }
    std::erase_if(graph_.segments, [&](const GraphSegment& segment) {
      const Box& box = boxes[sets.find(segment.a)];
      return length(box.high - box.low) < std::max(limits_.least, limits_.tolerance);
    });
  }

  // A trace that only leaves the facet at a sharp angle runs beside its outline for a while: too short to be meant.
  void drop_grazes() {
    std::pmr::vector<double> covered(plan_.outline().size(), 0.0, memory_);
    for (const CoveredStretch& stretch : graph_.covered) {
      covered[stretch.edge] += glm::distance(graph_.points[stretch.a].position, graph_.points[stretch.b].position);
    }
    std::erase_if(graph_.covered, [&](const CoveredStretch& stretch) {
      return covered[stretch.edge] < std::max(limits_.least, k_graze * limits_.tolerance);
    });
  }

  void drop_unused() {
    std::pmr::vector<std::uint32_t> number(graph_.points.size(), k_none, memory_);
    std::pmr::vector<GraphPoint> used(memory_);
    const auto renumber = [&](std::uint32_t& point) {
      if (number[point] == k_none) {
        number[point] = static_cast<std::uint32_t>(used.size());
        used.push_back(graph_.points[point]);
      }
      point = number[point];
    };
    for (GraphSegment& segment : graph_.segments) {
      renumber(segment.a);
      renumber(segment.b);
    }
    for (CoveredStretch& stretch : graph_.covered) {
      renumber(stretch.a);
      renumber(stretch.b);
    }
    graph_.points = std::move(used);
  }

  const FacetPlan& plan_;
  std::span<const Trace> traces_;
  ArrangementLimits limits_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<Candidate> candidates_;
  TraceGraph graph_;
};

}  // namespace

TraceGraph arrange_traces(const FacetPlan& plan, std::span<const Trace> traces, const ArrangementLimits& limits,
                          std::pmr::memory_resource* memory) {
  return Arranger(plan, traces, limits, memory).run();
}

}  // namespace radvor
