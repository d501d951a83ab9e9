#include "surface/facet_ground.h"

#include <algorithm>

#include "delaunay/triangulation.h"
#include "surface/facet_outline.h"

namespace radvor {

FacetGround::FacetGround(const FacetInput& input)
    : frame_(input.facet().frame),
      memory_(input.memory),
      segments_(input.memory),
      edges_(input.memory),
      sites_(input.memory),
      lattice_(find_segments(input)),
      grid_(segments_, lattice_.column(0), input.memory),
      latest_(input.memory) {}

// The lattice lies as the facet's triangulation has it: about the middle of its corners.
FacetLattice FacetGround::find_segments(const FacetInput& input) {
  const FacetOutline outline(input.welded, input.facets, input.index, input.memory);
  for (const bool border : {true, false}) {
    for (const OutlineEdge& edge : outline.edges) {
      if ((edge.flags == delaunay::constraint::k_border) == border) {
        const Edge& ends = input.welded.edges[edge.edge];
        const Segment segment{frame_.to_plane(input.welded.positions[ends.a]),
                              frame_.to_plane(input.welded.positions[ends.b])};
        const Vec2 least = glm::min(segment.a, segment.b);
        const Vec2 most = glm::max(segment.a, segment.b);
        low_ = segments_.empty() ? least : glm::min(low_, least);
        high_ = segments_.empty() ? most : glm::max(high_, most);
        segments_.push_back(segment);
        edges_.push_back(edge.edge);
        sites_.push_back(k_none);
      }
    }
    border_count_ = border ? static_cast<std::uint32_t>(segments_.size()) : border_count_;
  }
  for (const InnerSite& given : input.given) {
    segments_.push_back({given.position, given.position});
    edges_.push_back(k_none);
    sites_.push_back(given.site);
  }
  return {input.options.lattice, input.options.patch_spacing, 0.5 * (low_ + high_)};
}

double FacetGround::clearance(const Vec2& point, double limit) const {
  double least = grid_.distance(point, limit);
  for (const InnerSite& site : latest_) {
    least = std::min(least, glm::distance(site.position, point));
  }
  return least;
}

void FacetGround::add(const InnerSite& added) {
  latest_.push_back(added);
  if (latest_.size() * 8 < segments_.size() + 64) {
    return;
  }
  for (const InnerSite& site : latest_) {
    segments_.push_back({site.position, site.position});
    edges_.push_back(k_none);
    sites_.push_back(site.site);
  }
  latest_.clear();
  grid_ = SegmentGrid(segments_, lattice_.column(0), memory_);
}

}  // namespace radvor
