// Traces on a facet as a planar graph: pieces that meet in their ends alone. What lies closer than a tolerance is one.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "scene/facet_plan.h"
#include "scene/plane_traces.h"

namespace radvor {

/// A point of the graph: a corner of the facet's outline, a point inside one of its edges, or a point inside the facet.
struct GraphPoint {
  Vec2 position;
  std::uint32_t vertex;  ///< welded, or k_none
  std::uint32_t edge;    ///< index into the plan's outline, or k_none
  double part;           ///< along that edge, 0 at its a
};

/// A piece of trace inside the facet.
struct GraphSegment {
  std::uint32_t a, b;  ///< points
  double gap;          ///< the smallest of the traces that it is part of
};

/// A stretch of outline that a trace lies on.
struct CoveredStretch {
  std::uint32_t edge;  ///< index into the plan's outline
  std::uint32_t a, b;  ///< points
};

struct TraceGraph {
  explicit TraceGraph(std::pmr::memory_resource* memory) : points(memory), segments(memory), covered(memory) {}

  std::pmr::vector<GraphPoint> points;
  std::pmr::vector<GraphSegment> segments;
  std::pmr::vector<CoveredStretch> covered;
};

struct ArrangementLimits {
  double tolerance;  ///< points no farther apart are one, a point no farther from a trace lies on it; > 0
  double least;      ///< connected pieces whose box is smaller than this are dropped
};

/// traces: clipped to the facet. Collinear pieces are joined; pieces on the outline become covered stretches; points
/// that nothing uses are dropped.
TraceGraph arrange_traces(const FacetPlan& plan, std::span<const Trace> traces, const ArrangementLimits& limits,
                          std::pmr::memory_resource* memory);

}  // namespace radvor
