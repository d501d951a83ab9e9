#include "scene/find_contacts.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "base/floating_point.h"
#include "scene/box_tree.h"
#include "scene/edge_division.h"
#include "scene/facet_plan.h"
#include "scene/plane_traces.h"
#include "scene/position_welding.h"
#include "scene/shape.h"
#include "scene/trace_arrangement.h"

namespace radvor {
namespace {

// A facet with more traces keeps the longest: their graph takes time and memory that grow faster than their number.
constexpr std::size_t k_most_traces = 1 << 14;

// What a facet's graph is made of, in the whole scene's terms.
struct FacetGraph {
  std::uint32_t facet;
  double precision;
  TraceGraph graph;
  std::pmr::vector<PlanEdge> outline;
};

class ContactFinder {
 public:
  ContactFinder(const Scene& scene, WeldedScene& welded, Facets& facets, const ContactLimits& limits, Host& host)
      : scene_(scene),
        welded_(welded),
        facets_(facets),
        limits_(limits),
        host_(host),
        memory_(&host.memory),
        casters_(memory_),
        tolerances_(facets.facets.size(), 0.0, memory_),
        chunks_(memory_) {}

  void run() {
    plant_tree();
    find_graphs();
    divide();
    sharpen();
    add_edges();
    report();
  }

 private:
  struct Chunk {
    explicit Chunk(std::pmr::memory_resource* memory) : graphs(memory) {}
    std::pmr::deque<FacetGraph> graphs;
    std::uint32_t overfull = 0;  // facets with more than k_most_traces
  };

  static constexpr std::uint32_t k_chunk = 64;  // facets a task

  void plant_tree() {
    std::pmr::vector<Box> boxes(memory_);
    for (std::uint32_t t = 0; t < welded_.triangles.size(); ++t) {
      if (scene_.meshes[welded_.triangles[t].mesh].casts) {
        casters_.push_back(t);
        Box& box = boxes.emplace_back();
        for (const std::uint32_t vertex : welded_.triangles[t].vertices) {
          box.add(welded_.positions[vertex]);
        }
      }
    }
    tree_.emplace(boxes, memory_);
  }

  void find_graphs() {
    const auto count = static_cast<std::uint32_t>(facets_.facets.size());
    const std::uint32_t chunks = count / k_chunk + (count % k_chunk > 0 ? 1 : 0);
    for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
      chunks_.emplace_back(memory_);
    }
    host_.jobs.for_each(chunks, [&](std::uint32_t chunk) {
      std::pmr::vector<Trace> traces(memory_);
      for (std::uint32_t f = chunk * k_chunk; f < std::min(count, (chunk + 1) * k_chunk); ++f) {
        if (scene_.meshes[facets_.facets[f].mesh].receives) {
          find_graph(f, traces, chunks_[chunk]);
        }
      }
    });
  }

  void find_graph(std::uint32_t facet, std::pmr::vector<Trace>& traces, Chunk& chunk) {
    Box box;
    for (const std::uint32_t t : facets_.triangles_of(facet)) {
      for (const std::uint32_t vertex : welded_.triangles[t].vertices) {
        box.add(welded_.positions[vertex]);
      }
    }
    if (!(length(box.high - box.low) >= limits_.size)) {
      return;
    }
    const bool two_sided = scene_.materials[facets_.facets[facet].material].two_sided;
    const TracedPlane plane(welded_, facets_, facet, two_sided, limits_.reach);
    tolerances_[facet] = plane.tolerance();
    collect_traces(plane, box, traces);
    if (traces.empty()) {
      return;
    }
    const FacetPlan plan(welded_, facets_, facet, memory_);
    const ArrangementLimits limits{plane.tolerance(), limits_.least};
    clip(plan, limits.tolerance, traces);
    drop_doubles(plan, traces);
    if (traces.size() > k_most_traces) {
      ++chunk.overfull;
      std::ranges::nth_element(traces, traces.begin() + k_most_traces, std::greater<>(),
                               [](const Trace& trace) { return glm::distance(trace.a, trace.b); });
      traces.resize(k_most_traces);
    }
    TraceGraph graph = arrange_traces(plan, traces, limits, memory_);
    if (!graph.points.empty()) {
      std::pmr::vector<PlanEdge> outline(plan.outline().begin(), plan.outline().end(), memory_);
      chunk.graphs.push_back({facet, plane.precision(), std::move(graph), std::move(outline)});
    }
  }

  void collect_traces(const TracedPlane& plane, const Box& facet_box, std::pmr::vector<Trace>& traces) const {
    traces.clear();
    const double near = limits_.reach + 2 * plane.tolerance();
    const Vec3 margin(near);
    const Box box{facet_box.low - margin, facet_box.high + margin};
    const Vec3 normal = plane.frame().normal;
    const auto meets_plane = [&](const Box& node) {
      const Vec3 half = 0.5 * (node.high - node.low);
      const double reach = std::abs(normal.x) * half.x + std::abs(normal.y) * half.y + std::abs(normal.z) * half.z;
      return std::abs(plane.height(node.low + half)) <= reach + near;
    };
    tree_->walk([&](const Box& node) { return node.overlaps(box) && meets_plane(node); },
                [&](std::uint32_t i) { plane.trace(casters_[i], traces); });
  }

  void clip(const FacetPlan& plan, double tolerance, std::pmr::vector<Trace>& traces) const {
    std::pmr::vector<Stretch> inside(memory_);
    std::pmr::vector<Trace> clipped(memory_);
    for (const Trace& trace : traces) {
      plan.clip(trace.a, trace.b, 0.5 * tolerance, inside);
      const Vec2 along = trace.b - trace.a;
      for (const Stretch& stretch : inside) {
        if ((stretch.to - stretch.from) * length(along) > 2 * tolerance) {
          clipped.push_back({trace.a + stretch.from * along, trace.a + stretch.to * along, trace.gap, trace.facet});
        }
      }
    }
    traces = std::move(clipped);
  }

  // A near surface whose outline runs beside a contact, or beside the facet's own, adds nothing to it: a bevel above
  // the foot of a box. Nor does one that is smaller than its gap.
  void drop_doubles(const FacetPlan& plan, std::pmr::vector<Trace>& traces) const {
    std::pmr::vector<Trace> touching(memory_);
    std::ranges::copy_if(traces, std::back_inserter(touching), [](const Trace& trace) { return trace.gap == 0; });
    const auto is_beside = [&](const Trace& trace, const Vec2& a, const Vec2& b) {
      return distance_to_segment(trace.a, a, b) < limits_.least && distance_to_segment(trace.b, a, b) < limits_.least;
    };
    std::erase_if(traces, [&](const Trace& trace) {
      if (trace.gap == 0) {
        return false;
      }
      bool beside = glm::distance(trace.a, trace.b) < trace.gap;
      plan.for_each_edge_near(trace.a, trace.b, limits_.least, [&](std::uint32_t e) {
        beside = beside || is_beside(trace, plan.outline()[e].from, plan.outline()[e].to);
      });
      return beside ||
             std::ranges::any_of(touching, [&](const Trace& other) { return is_beside(trace, other.a, other.b); });
    });
  }

  template <class Function>
  void for_each_graph(Function&& function) {
    for (Chunk& chunk : chunks_) {
      for (FacetGraph& graph : chunk.graphs) {
        function(graph);
      }
    }
  }

  // The largest of its facets: what one of them takes for the end of an edge must be so for the others.
  double tolerance_at(std::uint32_t edge) const {
    double tolerance = 0;
    for (const std::uint32_t use : welded_.uses_at_edge(edge)) {
      const std::uint32_t triangle = welded_.uses_by_triangle[use].triangle;
      tolerance = std::max(tolerance, tolerances_[facets_.facet_of_triangle[triangle]]);
    }
    return tolerance;
  }

  bool changes_edge(const FacetGraph& found, const CoveredStretch& stretch) const {
    return facets_.edge_kinds[found.outline[stretch.edge].edge] != EdgeKind::sharp;
  }

  // Points on the outline become welded vertices, but not those that only end a stretch of what is sharp already.
  void divide() {
    std::pmr::vector<EdgeStop> stops(memory_);
    std::pmr::vector<std::uint32_t*> places(memory_);
    for_each_graph([&](FacetGraph& found) {
      std::erase_if(found.graph.covered, [&](const CoveredStretch& stretch) { return !changes_edge(found, stretch); });
      std::pmr::vector<bool> wanted(found.graph.points.size(), false, memory_);
      for (const GraphSegment& segment : found.graph.segments) {
        wanted[segment.a] = wanted[segment.b] = true;
      }
      for (const CoveredStretch& stretch : found.graph.covered) {
        wanted[stretch.a] = wanted[stretch.b] = true;
      }
      for (std::uint32_t p = 0; p < wanted.size(); ++p) {
        GraphPoint& point = found.graph.points[p];
        if (wanted[p] && point.edge != k_none) {
          const std::uint32_t edge = found.outline[point.edge].edge;
          stops.push_back({edge, point.part, tolerance_at(edge)});
          places.push_back(&point.vertex);
        }
      }
    });
    if (!stops.empty()) {
      division_.emplace(divide_edges(stops, welded_, facets_, memory_));
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
      *places[k] = division_->vertices[k];
    }
  }

  void sharpen() {
    for_each_graph([&](const FacetGraph& found) {
      for (const CoveredStretch& stretch : found.graph.covered) {
        const PlanEdge& edge = found.outline[stretch.edge];
        const auto [low, high] = std::minmax({part_along(edge, found.graph.points[stretch.a].vertex),
                                              part_along(edge, found.graph.points[stretch.b].vertex)});
        const std::uint32_t first = division_ ? division_->first_piece[edge.edge] : edge.edge;
        const std::uint32_t end = division_ ? division_->first_piece[edge.edge + 1] : edge.edge + 1;
        for (std::uint32_t piece = first; piece < end; ++piece) {
          const double middle =
              0.5 * (part_along(edge, welded_.edges[piece].a) + part_along(edge, welded_.edges[piece].b));
          if (low < middle && middle < high) {
            facets_.edge_kinds[piece] = EdgeKind::sharp;
          }
        }
      }
    });
  }

  double part_along(const PlanEdge& edge, std::uint32_t vertex) const {
    const Vec3& a = welded_.positions[edge.a];
    const Vec3 along = welded_.positions[edge.b] - a;
    return dot(welded_.positions[vertex] - a, along) / dot(along, along);
  }

  void add_edges() {
    Contacts& contacts = facets_.contacts;
    contacts = Contacts(memory_);
    const auto begin_facets = [&](std::uint32_t end) {
      contacts.first_edge.resize(end, static_cast<std::uint32_t>(contacts.edges.size()));
    };
    for_each_graph([&](const FacetGraph& found) {
      begin_facets(found.facet + 1);
      add_edges(found);
    });
    begin_facets(static_cast<std::uint32_t>(facets_.facets.size()) + 1);
    group_uses(welded_);
  }

  void add_edges(const FacetGraph& found) {
    const Frame& frame = facets_.facets[found.facet].frame;
    const std::uint32_t triangle = facets_.triangles_of(found.facet).front();
    std::pmr::vector<std::uint32_t> vertices(memory_);
    for (const GraphPoint& point : found.graph.points) {
      vertices.push_back(point.vertex);
    }
    const auto vertex_of = [&](std::uint32_t index) {
      if (vertices[index] == k_none) {
        vertices[index] = static_cast<std::uint32_t>(welded_.positions.size());
        welded_.positions.push_back(frame.to_world(frame.snapped(found.graph.points[index].position)));
        welded_.precision.push_back(found.precision);
      }
      return vertices[index];
    };
    // Points that two facets have on an edge may have fallen together, and what ends there.
    const std::size_t first = welded_.edges.size();
    for (const GraphSegment& segment : found.graph.segments) {
      Edge edge{vertex_of(segment.a), vertex_of(segment.b)};
      if (lies_before(welded_.positions[edge.b], welded_.positions[edge.a])) {
        std::swap(edge.a, edge.b);
      }
      if (edge.a == edge.b ||
          std::any_of(welded_.edges.begin() + static_cast<std::ptrdiff_t>(first), welded_.edges.end(),
                      [&](const Edge& e) { return e.a == edge.a && e.b == edge.b; })) {
        continue;
      }
      const auto index = static_cast<std::uint32_t>(welded_.edges.size());
      welded_.edges.push_back(edge);
      welded_.uses_by_triangle.push_back({index, triangle, k_no_side, true});
      facets_.edge_kinds.push_back(EdgeKind::sharp);
      facets_.contacts.edges.push_back({index, segment.gap});
    }
  }

  void report() {
    std::uint32_t overfull = 0;
    std::size_t facets = 0;
    for (const Chunk& chunk : chunks_) {
      overfull += chunk.overfull;
      facets += chunk.graphs.size();
    }
    if (overfull > 0) {
      host_.log(LogLevel::warning, "%u facets are cut by more than %zu triangles: the longest cuts were kept", overfull,
                k_most_traces);
    }
    if (!facets_.contacts.edges.empty()) {
      host_.log(LogLevel::info, "surfaces touch or cut each other along %zu segments, on %zu facets",
                facets_.contacts.edges.size(), facets);
    }
  }

  const Scene& scene_;
  WeldedScene& welded_;
  Facets& facets_;
  ContactLimits limits_;
  Host& host_;
  std::pmr::memory_resource* memory_;
  std::pmr::vector<std::uint32_t> casters_;  // triangles
  std::optional<BoxTree> tree_;              // of casters_
  std::pmr::vector<double> tolerances_;      // of facets that may be traced on
  std::pmr::deque<Chunk> chunks_;
  std::optional<EdgeDivision> division_;
};

}  // namespace

void find_contacts(const Scene& scene, WeldedScene& welded, Facets& facets, const ContactLimits& limits, Host& host) {
  const FloatingPointGuard guard(Denormals::keep);
  ContactFinder(scene, welded, facets, limits, host).run();
}

}  // namespace radvor
