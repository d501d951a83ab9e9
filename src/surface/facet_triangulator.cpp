#include "surface/facet_triangulator.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "surface/border.h"
#include "surface/facet_outline.h"
#include "surface/interior_sites.h"
#include "surface/receiver_point.h"
#include "surface/triangle_cells.h"

namespace radvor {

namespace {

// The triangles' area must be the facet's up to what rounding and slight bends explain; if it is not, the outline
// folded when it was rounded into the plane.
constexpr double k_area_tolerance = 0.01;

// Border sites are rounded to a grid finer than the frame's, as fine as leaves differences of coordinates exact: their
// place along the edge is what counts, and a facet's area is that of its corners' polygon to 1e-14.
constexpr double k_border_grid = 0x1p-10;

// How well a border edge names the source of a share's normal and colour.
enum class Claim : std::uint8_t { none, crossing, arriving, leaving };

}  // namespace

FacetTriangulator::FacetTriangulator(const FacetInput& input, FacetMesh& mesh, FacetDraft& draft)
    : in_(input),
      mesh_(mesh),
      draft_(draft),
      scratch_(room_.data(), room_.size(), input.memory),
      outline_(input.welded, input.facets, input.index, &scratch_),
      chains_(&scratch_),
      first_of_chain_(&scratch_),
      borders_(&scratch_),
      inner_(&scratch_),
      share_at_(&scratch_) {}

bool FacetTriangulator::run() {
  if (!outline_.sound) {
    return false;
  }
  try {
    delaunay::Triangulation& triangulation = mesh_.delaunay_.emplace(in_.memory);
    triangulation.reserve(known_vertices());
    if (insert_corners(triangulation) && insert_borders(triangulation)) {
      triangulation.mark_domain();
      if (insert_inner(triangulation) && find_shares(triangulation) && find_triangles(triangulation) &&
          find_sources(triangulation)) {
        triangulation.trim();
        return true;
      }
    }
  } catch (const Error&) {
    // Borders that cross, do not close, or would fold: what degenerate input does once it is rounded into a plane.
  }
  mesh_.delaunay_.reset();
  mesh_.lattice_.reset();
  mesh_.triangles_.clear();
  mesh_.index_of_triangle_.clear();
  mesh_.first_share_.clear();
  mesh_.sites_.clear();
  mesh_.border_count_ = 0;
  draft_.shares.clear();
  draft_.lattice.clear();
  draft_.pieces.clear();
  return false;
}

// All but those of a lattice that are still to be found.
std::uint32_t FacetTriangulator::known_vertices() const {
  std::size_t count = outline_.vertices.size() + (in_.inner ? *in_.inner : in_.given).size();
  for (const OutlineEdge& edge : outline_.edges) {
    count += in_.borders.count_on_edge(edge.edge);
  }
  return static_cast<std::uint32_t>(count);
}

bool FacetTriangulator::insert_corners(delaunay::Triangulation& triangulation) {
  const Frame& frame = in_.facet().frame;
  std::pmr::vector<Vec2> points(&scratch_);
  for (const std::uint32_t vertex : outline_.vertices) {
    points.push_back(frame.to_plane(in_.welded.positions[vertex]));
    mesh_.sites_.push_back(in_.borders.at_vertex(vertex));
    low_ = points.size() == 1 ? points.back() : glm::min(low_, points.back());
    high_ = points.size() == 1 ? points.back() : glm::max(high_, points.back());
  }
  triangulation.insert_many(points, nullptr);  // numbered in the order given, unless two fall together
  return triangulation.vertex_count() == points.size();
}

delaunay::VertexId FacetTriangulator::corner(std::uint32_t welded_vertex) const {
  const auto at = std::lower_bound(outline_.vertices.begin(), outline_.vertices.end(), welded_vertex);
  return static_cast<delaunay::VertexId>(at - outline_.vertices.begin());
}

// Sites first, then each piece of border between neighbours: rounded sites make the border bend by a unit here and
// there, and no piece is in the way of a site that is still to come.
bool FacetTriangulator::insert_borders(delaunay::Triangulation& triangulation) {
  const double unit = k_border_grid * in_.facet().frame.unit;
  std::pmr::vector<Vec2> points(&scratch_);
  for (const OutlineEdge& edge : outline_.edges) {
    const Edge& ends = in_.welded.edges[edge.edge];
    const Segment segment{triangulation.position(corner(ends.a)), triangulation.position(corner(ends.b))};
    (edge.flags == delaunay::constraint::k_border ? borders_ : inner_).push_back(segment);
    const EdgeLine line = in_.borders.line(edge.edge);
    first_of_chain_.push_back(static_cast<std::uint32_t>(chains_.size()));
    chains_.push_back(corner(ends.a));
    for (const EdgeSite& site : in_.borders.on_edge(edge.edge)) {
      const Vec2 point = segment.a + line.part(in_.borders.from_middle(site.step)) * (segment.b - segment.a);
      points.push_back({std::nearbyint(point.x / unit) * unit, std::nearbyint(point.y / unit) * unit});
      chains_.push_back(static_cast<delaunay::VertexId>(mesh_.sites_.size()));
      mesh_.sites_.push_back(site.site);
    }
    chains_.push_back(corner(ends.b));
  }
  first_of_chain_.push_back(static_cast<std::uint32_t>(chains_.size()));
  triangulation.insert_many(points, nullptr);  // numbered in the order given, unless two fall together
  mesh_.border_count_ = static_cast<std::uint32_t>(mesh_.sites_.size());
  if (triangulation.vertex_count() != mesh_.border_count_) {
    return false;
  }
  for (std::size_t k = 0; k < outline_.edges.size(); ++k) {
    for (std::uint32_t at = first_of_chain_[k]; at + 1 < first_of_chain_[k + 1]; ++at) {
      if (outline_.edges[k].use_count == 0) {
        constrain_contact(triangulation, chains_[at], chains_[at + 1]);
        continue;
      }
      triangulation.constrain(chains_[at], chains_[at + 1], outline_.edges[k].flags);
      if (triangulation.constraint_flags(chains_[at], chains_[at + 1]) == 0) {
        return false;  // another site lies on it, though not in space
      }
    }
  }
  return true;
}

// Contacts come after the borders. Rounding may let two pieces cross at a sharp angle: then light leaks through one of
// them, and nothing worse.
void FacetTriangulator::constrain_contact(delaunay::Triangulation& triangulation, delaunay::VertexId a,
                                          delaunay::VertexId b) {
  try {
    triangulation.constrain(a, b, delaunay::constraint::k_discontinuous);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::constraint) {
      throw;
    }
  }
}

bool FacetTriangulator::insert_inner(delaunay::Triangulation& triangulation) {
  const FacetLattice& lattice =
      mesh_.lattice_.emplace(in_.options.lattice, in_.options.patch_spacing, 0.5 * (low_ + high_));
  std::pmr::vector<Vec2> points(&scratch_);
  const std::span<const InnerSite> known = in_.inner ? *in_.inner : in_.given;
  points.reserve(known.size());
  for (const InnerSite& inner : known) {
    points.push_back(inner.position);
    mesh_.sites_.push_back(inner.site);
  }
  if (!in_.inner) {
    find_lattice_sites(lattice, points);
  }
  triangulation.insert_many(points, nullptr);  // numbered in the order given, unless two fall together
  return triangulation.vertex_count() == mesh_.sites_.size();
}

// Those of the first elements' level; they get their numbers later.
void FacetTriangulator::find_lattice_sites(const FacetLattice& lattice, std::pmr::vector<Vec2>& points) {
  const std::uint32_t level = in_.options.element_levels;
  std::pmr::vector<Segment> obstacles(inner_, &scratch_);
  for (const InnerSite& given : in_.given) {
    obstacles.push_back({given.position, given.position});
  }
  find_interior_sites(lattice, level, borders_, obstacles, k_half_spacing * lattice.column(level), draft_.lattice,
                      in_.memory);
  points.reserve(points.size() + draft_.lattice.size());
  for (const LatticeIndex& index : draft_.lattice) {
    points.push_back(lattice.point(level, index));
  }
  mesh_.sites_.resize(mesh_.sites_.size() + draft_.lattice.size(), k_none);
}

bool FacetTriangulator::find_shares(const delaunay::Triangulation& triangulation) {
  const std::uint32_t vertices = triangulation.vertex_bound();
  mesh_.first_share_.reserve(vertices);
  draft_.shares.reserve(vertices);
  share_at_.assign(std::size_t{4} * triangulation.triangle_bound(), k_none);
  delaunay::CellBuffer buffer(&scratch_);
  double area = 0;
  for (delaunay::VertexId vertex = 0; vertex < vertices; ++vertex) {
    bounded_cell(triangulation, vertex, buffer);
    mesh_.first_share_.push_back(static_cast<std::uint32_t>(draft_.shares.size()));
    for (const delaunay::Sector& sector : buffer.sectors()) {
      delaunay::HalfEdge h = sector.first;
      for (std::uint32_t k = 0; k < sector.triangle_count; ++k, h = triangulation.rotate_ccw(h)) {
        share_at_[h] = static_cast<std::uint32_t>(draft_.shares.size());
      }
      FacetShare& share = draft_.shares.emplace_back();
      share.vertex = vertex;
      share.site = mesh_.sites_[vertex];
      share.position = triangulation.position(vertex);
      share.centroid = sector.centroid;
      share.receiver = receiver_point(share.position, buffer.polygon(sector), sector.centroid);
      share.area = sector.area;
      area += sector.area;
    }
  }
  mesh_.first_share_.push_back(static_cast<std::uint32_t>(draft_.shares.size()));
  return std::abs(area - in_.facet().area) <= k_area_tolerance * in_.facet().area;
}

bool FacetTriangulator::find_triangles(const delaunay::Triangulation& triangulation) {
  mesh_.index_of_triangle_.assign(triangulation.triangle_bound(), k_none);
  for (delaunay::TriangleId t = 0; t < triangulation.triangle_bound(); ++t) {
    if (triangulation.is_triangle(t) && triangulation.is_inside(t)) {
      mesh_.index_of_triangle_[t] = static_cast<std::uint32_t>(mesh_.triangles_.size());
      ShareTriangle& shares = mesh_.triangles_.emplace_back();
      for (std::uint32_t k = 0; k < 3; ++k) {
        shares[k] = share_at_[delaunay::half_edge(t, k)];
        if (shares[k] == k_none) {
          return false;
        }
      }
    }
  }
  return !mesh_.triangles_.empty();
}

bool FacetTriangulator::find_sources(const delaunay::Triangulation& triangulation) {
  std::pmr::vector<Claim> claims(draft_.shares.size(), Claim::none, &scratch_);
  const auto claim = [&](std::uint32_t share, Claim strength, const EdgeUse& use) {
    if (strength > claims[share]) {
      claims[share] = strength;
      draft_.shares[share].source = {use.triangle, use.side};
    }
  };
  for (std::size_t k = 0; k < outline_.edges.size(); ++k) {
    const OutlineEdge& edge = outline_.edges[k];
    const bool blocking = (edge.flags & delaunay::constraint::k_blocking) != 0;
    for (const EdgeUse& use : outline_.uses_of(edge)) {
      for (std::uint32_t at = first_of_chain_[k]; at + 1 < first_of_chain_[k + 1]; ++at) {
        const delaunay::HalfEdge h = use.forward ? triangulation.find_edge(chains_[at], chains_[at + 1])
                                                 : triangulation.find_edge(chains_[at + 1], chains_[at]);
        if (h == delaunay::k_none || share_at_[h] == k_none) {
          return false;  // the facet is not where its triangles say it is
        }
        const std::uint32_t from = share_at_[h];
        const std::uint32_t to = share_at_[delaunay::next(h)];
        claim(from, blocking ? Claim::leaving : Claim::crossing, use);
        claim(to, blocking ? Claim::arriving : Claim::crossing, use);
        if (in_.borders.joins(edge.edge)) {
          draft_.pieces.push_back(
              {edge.edge, at - first_of_chain_[k], use.forward ? from : to, use.forward ? to : from});
        }
      }
    }
  }
  return true;
}

}  // namespace radvor
