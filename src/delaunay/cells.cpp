// Cells by clipping convex polygons. All sites that a point sees at its nearest distance are among the neighbours of
// its site, so a cell is an intersection of half-planes: those of the bisectors, and those of the constraint edges that
// cut what the bisectors leave; such an edge is a full chord of it, since its visible ends are sites and outside. The
// edges are found by a flood from the star through all triangles that the polygon meets. Continuous constraints do not
// count: a view without them stands for the triangulation. Corners are computed from the
// vertices that define them, in an order of their own, so that neighbouring cells agree to the bit.
#include "delaunay/cells.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "delaunay/circumcentre.h"

namespace radvor::delaunay {

class CellBuilder {
 public:
  CellBuilder(const Triangulation& triangulation, VertexId site, CellBuffer& buffer)
      : d_(triangulation), site_(site), at_(triangulation.position(site)), out_(buffer), view_(buffer.view_) {
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
    auto& sides = out_.sides_;
    sides.clear();
    const auto size = static_cast<std::uint32_t>(window.size());
    for (std::uint32_t i = 0; i < size; ++i) {
      sides.push_back({Kind::window, i, (i + 1) % size, window[(i + 1) % size]});
    }
    window_ = window;
    d_.for_each_neighbour(site_, [&](VertexId neighbour) { clip({Kind::bisector, neighbour, k_none, {}}); });
    if (d_.may_have_constraints()) {
      clip_by_hidden_sites();
    }
    if (sides.size() < 3) {
      return;
    }
    Sector sector{d_.out(site_), 0, true, 0, 0, 0, {}};
    for (const Side& side : sides) {
      add_point(side.end, sector);
    }
    finish(sector);
  }

 private:
  using Side = CellBuffer::Side;
  using Kind = Side::Kind;

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
    auto& sides = out_.sides_;
    sides.clear();
    HalfEdge h = wedge.first;
    for (std::uint32_t i = 0; i < wedge.triangle_count; ++i, h = view_.rotate_ccw(h)) {
      sides.push_back({Kind::bisector, view_.target(h), k_none, corner(view_.target(h), view_.apex(h))});
    }
    if (wedge.closed) {
      return;
    }
    sides.push_back({Kind::bisector, view_.target(wedge.last), k_none, {}});
    close_wedge({Kind::line, site_, view_.target(wedge.first), {}}, {Kind::line, view_.target(wedge.last), site_, at_});
  }

  // What one triangle's cone holds of its corner's cell, as far as the triangle knows.
  void start_with_kite(HalfEdge h) {
    const VertexId a = view_.target(h);
    const VertexId b = view_.apex(h);
    out_.sides_.clear();
    out_.sides_.push_back({Kind::bisector, a, k_none, corner(a, b)});
    out_.sides_.push_back({Kind::bisector, b, k_none, {}});
    close_wedge({Kind::line, site_, a, {}}, {Kind::line, b, site_, at_});
  }

  // sides_ is a chain of bisectors; drops its ends beyond the lines, and puts the lines around it.
  void close_wedge(Side low, Side high) {
    auto& sides = out_.sides_;
    std::size_t begin = 0;
    std::size_t end = sides.size();  // the last corner of the chain is that of end - 2
    while (begin + 1 < end && value(low, sides[begin].end) <= 0) {
      ++begin;
    }
    while (begin + 1 < end && value(high, sides[end - 2].end) <= 0) {
      --end;
    }
    low.end = meet(low, sides[begin]);
    sides[end - 1].end = meet(sides[end - 1], high);
    auto& clipped = out_.clipped_;
    clipped.clear();
    clipped.push_back(low);
    clipped.insert(clipped.end(), sides.begin() + static_cast<std::ptrdiff_t>(begin),
                   sides.begin() + static_cast<std::ptrdiff_t>(end));
    clipped.push_back(high);
    sides.swap(clipped);
  }

  // Neighbours within a right angle of the cone of h, on its own side of the blocking edges.
  void clip_by_neighbours(HalfEdge h, const Wedge& wedge, std::uint32_t index) {
    const Vec2 low = position(view_.target(h)) - at_;
    const Vec2 high = position(view_.apex(h)) - at_;
    HalfEdge spoke = view_.rotate_ccw(view_.rotate_ccw(h));
    std::uint32_t most = wedge.closed ? wedge.triangle_count - 2 : wedge.triangle_count - index - 1;
    for (std::uint32_t i = 0; i < most && glm::dot(position(view_.target(spoke)) - at_, high) > 0; ++i) {
      clip({Kind::bisector, view_.target(spoke), k_none, {}});
      spoke = view_.rotate_ccw(spoke);
    }
    spoke = view_.rotate_cw(h);
    most = wedge.closed ? wedge.triangle_count - 2 : index;
    for (std::uint32_t i = 0; i < most && glm::dot(position(view_.target(spoke)) - at_, low) > 0; ++i) {
      clip({Kind::bisector, view_.target(spoke), k_none, {}});
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
      if (!cuts(position(view_.origin(h)), position(view_.target(h)))) {
        continue;
      }
      if (view_.blocks(h)) {
        // Seen from the site the edge runs the other way.
        const Side side{Kind::line, view_.target(h), view_.origin(h), {}};
        if (value(side, at_) > 0) {
          clip(side);
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

  bool is_side(VertexId site) const {
    return std::any_of(out_.sides_.begin(), out_.sides_.end(),
                       [&](const Side& side) { return side.kind == Kind::bisector && side.a == site; });
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
      if (d_.is_ghost(t) || !meets_a_circle(position(d_.origin(h)), position(d_.target(h))) || !out_.visited_.add(t)) {
        continue;
      }
      if (d_.apex(h) != site_) {
        clip({Kind::bisector, d_.apex(h), k_none, {}});
      }
      stack.push_back(d_.twin(next(h)));
      stack.push_back(d_.twin(previous(h)));
    }
  }

  bool meets_a_circle(Vec2 a, Vec2 b) const {
    const Vec2 along = b - a;
    for (const Side& side : out_.sides_) {
      const double share = std::clamp(glm::dot(side.end - a, along) / glm::dot(along, along), 0.0, 1.0);
      const Vec2 nearest = a + share * along - side.end;
      const Vec2 radius = at_ - side.end;
      if (glm::dot(nearest, nearest) <= glm::dot(radius, radius)) {
        return true;
      }
    }
    return false;
  }

  // ---- Half-planes

  // > 0 on the polygon's side.
  double value(const Side& side, Vec2 point) const {
    switch (side.kind) {
      case Kind::bisector: {
        const Vec2 to = position(side.a) - at_;
        return glm::dot(at_ + 0.5 * to - point, to);
      }
      case Kind::line:
        return cross(position(side.b) - position(side.a), point - position(side.a));
      case Kind::window:
        return cross(window_[side.b] - window_[side.a], point - window_[side.a]);
    }
    return 0;
  }

  // Does the segment meet the inside of the polygon?
  bool cuts(Vec2 a, Vec2 b) const {
    bool left = false, right = false;
    for (const Side& side : out_.sides_) {
      const double at = cross(b - a, side.end - a);
      left |= at > 0;
      right |= at < 0;
    }
    if (!left || !right) {
      return false;
    }
    double from = 0, to = 1;
    for (const Side& side : out_.sides_) {
      const double at_a = value(side, a);
      const double at_b = value(side, b);
      if (at_a <= 0 && at_b <= 0) {
        return false;
      }
      if (at_a < 0) {
        from = std::max(from, at_a / (at_a - at_b));
      } else if (at_b < 0) {
        to = std::min(to, at_a / (at_a - at_b));
      }
    }
    return from < to;
  }

  // Sutherland and Hodgman, for one half-plane and a convex polygon.
  void clip(Side by) {
    auto& sides = out_.sides_;
    auto& clipped = out_.clipped_;
    if (sides.empty() || (by.kind == Kind::bisector && is_side(by.a))) {
      return;
    }
    clipped.clear();
    double before = value(by, sides.back().end);
    bool cut = false;
    for (const Side& side : sides) {
      const double after = value(by, side.end);
      if (before < 0 && after >= 0) {
        by.end = meet(by, side);
        clipped.push_back(by);
      }
      if (before >= 0 || after >= 0) {
        clipped.push_back(side);
        if (after < 0) {
          clipped.back().end = meet(side, by);
        }
      }
      cut |= after < 0;
      before = after;
    }
    if (cut) {
      sides.swap(clipped);
    }
  }

  // ---- Corners

  // Of the cells of the site, a and b.
  Vec2 corner(VertexId a, VertexId b) const {
    VertexId v[3] = {site_, a, b};
    std::sort(v, v + 3);
    return circumcentre(position(v[0]), position(v[1]), position(v[2]));
  }

  Vec2 meet(const Side& one, const Side& other) const {
    if (one.kind == Kind::bisector && other.kind == Kind::bisector) {
      return corner(one.a, other.a);
    }
    const Side& bisector = one.kind == Kind::bisector ? one : other;
    const Side& line = one.kind == Kind::bisector ? other : one;
    if (bisector.kind != Kind::bisector) {
      return meet_lines(one, other);
    }
    const Vec2 s = position(std::min(site_, bisector.a));
    const Vec2 n = position(std::max(site_, bisector.a));
    const Vec2 u = line.kind == Kind::window ? window_[line.a] : position(std::min(line.a, line.b));
    const Vec2 v = line.kind == Kind::window ? window_[line.b] : position(std::max(line.a, line.b));
    const double share = glm::dot(0.5 * ((s - u) + (n - u)), n - s) / glm::dot(v - u, n - s);
    return u + share * (v - u);
  }

  // Two lines: constraint edges that meet only within rounding.
  Vec2 meet_lines(const Side& one, const Side& other) const {
    const Vec2 u = position(one.a), along = position(one.b) - u;
    const Vec2 w = position(other.a), across = position(other.b) - w;
    return u + cross(w - u, across) / cross(along, across) * along;
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
      for (std::size_t i = 0; i + 1 < out_.sides_.size(); ++i) {
        add_point(out_.sides_[i].end, sector);
      }
    } else {
      for (const Side& side : out_.sides_) {
        add_point(side.end, sector);
      }
    }
  }

  // The corners of one cone's part but the site, which is the end of its last side.
  void add_arc(Sector& sector) {
    for (std::size_t i = 0; i + 1 < out_.sides_.size(); ++i) {
      add_point(out_.sides_[i].end, sector);
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
  std::span<const Vec2> window_;
  CellBuffer& out_;
  SeamlessView& view_;
};

CellBuffer::CellBuffer(std::pmr::memory_resource* memory)
    : sectors_(memory),
      points_(memory),
      sides_(memory),
      clipped_(memory),
      stack_(memory),
      visited_(memory),
      view_(memory) {}

double CellBuffer::area() const {
  double sum = 0;
  for (const Sector& sector : sectors_) {
    sum += sector.area;
  }
  return sum;
}

void bounded_cell(const Triangulation& triangulation, VertexId site, CellBuffer& buffer) {
  CellBuilder(triangulation, site, buffer).bounded();
}

void window_cell(const Triangulation& triangulation, VertexId site, std::span<const Vec2> window, CellBuffer& buffer) {
  CellBuilder(triangulation, site, buffer).in_window(window);
}

}  // namespace radvor::delaunay
