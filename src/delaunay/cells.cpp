// Cells by clipping convex polygons. All sites that a point sees at its nearest distance are among the neighbours of
// its site, so a cell is an intersection of half-planes: those of the bisectors, and those of the constraint edges that
// cut what the bisectors leave; such an edge is a full chord of it, since its visible ends are sites and outside. The
// edges are found by a flood from the star through all triangles that the polygon meets. Continuous constraints do not
// count: a view without them stands for the triangulation.
#include "delaunay/cells.h"

#include <algorithm>
#include <utility>

namespace radvor::delaunay {

class CellBuilder {
 public:
  CellBuilder(const Triangulation& triangulation, VertexId site, std::span<const Vec2> window, CellBuffer& buffer)
      : d_(triangulation),
        site_(site),
        at_(triangulation.position(site)),
        out_(buffer),
        polygon_(buffer.polygon_),
        view_(buffer.view_) {
    polygon_.look(triangulation, site, window);
    out_.sectors_.clear();
    out_.points_.clear();
  }

  void bounded() {
    const HalfEdge any = d_.out(site_);
    if (any == k_none) {
      return;
    }
    view_.look(d_, site_);
    // The sectors' first edges; begin with the one that leads to the lowest id.
    HalfEdge start = k_none;
    bool all_inside = true;
    HalfEdge h = any;
    do {
      all_inside = all_inside && d_.is_inside(triangle_of(h));
      if (begins_sector(h) && (start == k_none || d_.target(h) < d_.target(start))) {
        start = h;
      }
      h = d_.rotate_ccw(h);
    } while (h != any);
    if (start == k_none) {
      if (all_inside) {
        add_sector(any, true);
      }
      return;
    }
    h = start;
    do {
      if (begins_sector(h)) {
        add_sector(h, false);
      }
      h = d_.rotate_ccw(h);
    } while (h != start);
  }

  void in_window(std::span<const Vec2> window) {
    const auto size = static_cast<std::uint32_t>(window.size());
    for (std::uint32_t i = 0; i < size; ++i) {
      polygon_.add({Kind::window, i, (i + 1) % size, window[(i + 1) % size]});
    }
    d_.for_each_neighbour(site_, [&](VertexId neighbour) { polygon_.clip({Kind::bisector, neighbour, k_none, {}}); });
    if (d_.may_have_constraints()) {
      clip_by_hidden_sites();
    }
    if (polygon_.sides().size() < 3) {
      return;
    }
    Sector sector{d_.out(site_), 0, true, 0, 0, 0, {}};
    for (const Side& side : polygon_.sides()) {
      add_point(side.end, sector);
    }
    finish(sector);
  }

 private:
  using Side = CellSide;
  using Kind = CellSide::Kind;

  // A sector in the view: the triangles left of the half-edges from first on, out of the site, up to last.
  struct Wedge {
    HalfEdge first, last;
    std::uint32_t triangle_count;
    bool closed;
  };

  Vec2 position(VertexId v) const { return d_.position(v); }

  bool blocks(HalfEdge h) const {
    return (d_.constraint_flags(h) & constraint::k_blocking) != 0 || !d_.is_inside(triangle_of(h)) ||
           !d_.is_inside(triangle_of(d_.twin(h)));
  }
  bool begins_sector(HalfEdge out) const { return d_.is_inside(triangle_of(out)) && blocks(out); }

  // ---- One sector

  // first: in the triangulation; what follows is about the same wedge in the view.
  void add_sector(HalfEdge first, bool closed) {
    Sector sector{first, 0, closed, 0, 0, 0, {}};
    sector.begin = sector.end = static_cast<std::uint32_t>(out_.points_.size());
    HalfEdge last = first;
    do {
      ++sector.triangle_count;
      last = d_.rotate_ccw(last);
    } while (closed ? last != first : !blocks(last));
    Wedge wedge{closed ? view_.out() : view_.find_out(d_.target(first)), k_none, 0, closed};
    wedge.last = wedge.first;
    do {
      ++wedge.triangle_count;
      wedge.last = view_.rotate_ccw(wedge.last);
    } while (closed ? wedge.last != wedge.first : !view_.blocks(wedge.last));
    const Vec2 from = position(d_.target(first)) - at_;
    const Vec2 to = position(d_.target(last)) - at_;
    const bool reflex = !closed && wedge.triangle_count > 1 && (from == to || cross(from, to) < 0);
    if (!reflex) {
      start_with_chain(wedge);
      flood(wedge.first, wedge.triangle_count);
      add_corners(sector);
    } else {
      add_point(at_, sector);
      HalfEdge h = wedge.first;
      for (std::uint32_t i = 0; i < wedge.triangle_count; ++i, h = view_.rotate_ccw(h)) {
        start_with_kite(h);
        clip_by_neighbours(h, wedge, i);
        flood(h, 1);
        add_arc(sector);
      }
    }
    finish(sector);
  }

  // The circumcentres of the star are the corners; an end of the chain beyond an edge of the wedge is cut off.
  void start_with_chain(const Wedge& wedge) {
    polygon_.clear();
    HalfEdge h = wedge.first;
    for (std::uint32_t i = 0; i < wedge.triangle_count; ++i, h = view_.rotate_ccw(h)) {
      polygon_.add({Kind::bisector, view_.target(h), k_none, polygon_.corner(view_.target(h), view_.apex(h))});
    }
    if (wedge.closed) {
      return;
    }
    polygon_.add({Kind::bisector, view_.target(wedge.last), k_none, {}});
    polygon_.close_wedge({Kind::line, site_, view_.target(wedge.first), {}},
                         {Kind::line, view_.target(wedge.last), site_, at_});
  }

  // What one triangle's cone holds of its corner's cell, as far as the triangle knows.
  void start_with_kite(HalfEdge h) {
    const VertexId a = view_.target(h);
    const VertexId b = view_.apex(h);
    polygon_.clear();
    polygon_.add({Kind::bisector, a, k_none, polygon_.corner(a, b)});
    polygon_.add({Kind::bisector, b, k_none, {}});
    polygon_.close_wedge({Kind::line, site_, a, {}}, {Kind::line, b, site_, at_});
  }

  // Neighbours within a right angle of the cone of h, on its own side of the blocking edges.
  void clip_by_neighbours(HalfEdge h, const Wedge& wedge, std::uint32_t index) {
    const Vec2 low = position(view_.target(h)) - at_;
    const Vec2 high = position(view_.apex(h)) - at_;
    HalfEdge spoke = view_.rotate_ccw(view_.rotate_ccw(h));
    std::uint32_t most = wedge.closed ? wedge.triangle_count - 2 : wedge.triangle_count - index - 1;
    for (std::uint32_t i = 0; i < most && glm::dot(position(view_.target(spoke)) - at_, high) > 0; ++i) {
      polygon_.clip({Kind::bisector, view_.target(spoke), k_none, {}});
      spoke = view_.rotate_ccw(spoke);
    }
    spoke = view_.rotate_cw(h);
    most = wedge.closed ? wedge.triangle_count - 2 : index;
    for (std::uint32_t i = 0; i < most && glm::dot(position(view_.target(spoke)) - at_, low) > 0; ++i) {
      polygon_.clip({Kind::bisector, view_.target(spoke), k_none, {}});
      spoke = view_.rotate_cw(spoke);
    }
  }

  // ---- Beyond the star

  void flood(HalfEdge first, std::uint32_t triangle_count) {
    auto& stack = out_.stack_;
    stack.clear();
    out_.visited_.clear();
    HalfEdge spoke = first;
    for (std::uint32_t i = 0; i < triangle_count; ++i, spoke = view_.rotate_ccw(spoke)) {
      stack.push_back(view_.twin(next(spoke)));
    }
    while (!stack.empty()) {
      const HalfEdge h = stack.back();
      stack.pop_back();
      if (!polygon_.cuts(position(view_.origin(h)), position(view_.target(h)))) {
        continue;
      }
      if (view_.blocks(h)) {
        // Seen from the site the edge runs the other way.
        const Side side{Kind::line, view_.target(h), view_.origin(h), {}};
        if (polygon_.value(side, at_) > 0) {
          polygon_.clip(side);
        }
        continue;
      }
      const TriangleId t = triangle_of(h);
      if (!out_.visited_.add(t)) {
        continue;
      }
      stack.push_back(view_.twin(next(h)));
      stack.push_back(view_.twin(previous(h)));
    }
  }

  // Without regard to constraints: any site inside of a circle around a corner through the site is nearer to it. They
  // are found through the triangles that such a circle meets.
  void clip_by_hidden_sites() {
    auto& stack = out_.stack_;
    stack.clear();
    out_.visited_.clear();
    HalfEdge spoke = d_.out(site_);
    const HalfEdge first = spoke;
    if (spoke == k_none) {
      return;
    }
    do {
      if (!d_.is_ghost(triangle_of(spoke))) {
        stack.push_back(d_.twin(next(spoke)));
      }
      spoke = d_.rotate_ccw(spoke);
    } while (spoke != first);
    while (!stack.empty()) {
      const HalfEdge h = stack.back();
      stack.pop_back();
      const TriangleId t = triangle_of(h);
      if (d_.is_ghost(t) || !polygon_.meets_a_circle(position(d_.origin(h)), position(d_.target(h))) ||
          !out_.visited_.add(t)) {
        continue;
      }
      if (d_.apex(h) != site_) {
        polygon_.clip({Kind::bisector, d_.apex(h), k_none, {}});
      }
      stack.push_back(d_.twin(next(h)));
      stack.push_back(d_.twin(previous(h)));
    }
  }

  // ---- Results

  void add_point(Vec2 point, Sector& sector) {
    if (sector.begin == out_.points_.size() || out_.points_.back() != point) {
      out_.points_.push_back(point);
    }
    sector.end = static_cast<std::uint32_t>(out_.points_.size());
  }

  void add_corners(Sector& sector) {
    if (!sector.closed) {
      add_point(at_, sector);
      for (std::size_t i = 0; i + 1 < polygon_.sides().size(); ++i) {
        add_point(polygon_.sides()[i].end, sector);
      }
    } else {
      for (const Side& side : polygon_.sides()) {
        add_point(side.end, sector);
      }
    }
  }

  // The corners of one cone's part but the site, which is the end of its last side.
  void add_arc(Sector& sector) {
    for (std::size_t i = 0; i + 1 < polygon_.sides().size(); ++i) {
      add_point(polygon_.sides()[i].end, sector);
    }
  }

  void finish(Sector& sector) {
    auto& points = out_.points_;
    while (sector.end - sector.begin > 1 && points.back() == points[sector.begin]) {
      points.pop_back();
      --sector.end;
    }
    double area = 0;
    Vec2 moment(0.0);
    for (std::uint32_t i = sector.begin; i < sector.end; ++i) {
      const Vec2 p = points[i] - at_;
      const Vec2 q = points[i + 1 == sector.end ? sector.begin : i + 1] - at_;
      const double twice = cross(p, q);
      area += twice / 2;
      moment += twice / 6 * (p + q);
    }
    sector.area = area;
    sector.centroid = area > 0 ? at_ + moment / area : at_;
    out_.sectors_.push_back(sector);
  }

  const Triangulation& d_;
  VertexId site_;
  Vec2 at_;
  CellBuffer& out_;
  CellPolygon& polygon_;
  SeamlessView& view_;
};

CellBuffer::CellBuffer(std::pmr::memory_resource* memory)
    : sectors_(memory), points_(memory), polygon_(memory), stack_(memory), visited_(memory), view_(memory) {}

double CellBuffer::area() const {
  double sum = 0;
  for (const Sector& sector : sectors_) {
    sum += sector.area;
  }
  return sum;
}

void bounded_cell(const Triangulation& triangulation, VertexId site, CellBuffer& buffer) {
  CellBuilder(triangulation, site, {}, buffer).bounded();
}

void window_cell(const Triangulation& triangulation, VertexId site, std::span<const Vec2> window, CellBuffer& buffer) {
  CellBuilder(triangulation, site, window, buffer).in_window(window);
}

}  // namespace radvor::delaunay
