// Constraint edges. A segment is followed from vertex to vertex; the edges that cross a piece of it are flipped until
// none does (S. W. Sloan, "A fast algorithm for generating constrained Delaunay triangulations", 1993), then the new
// edges are made locally Delaunay.
#include "base/error.h"
#include "delaunay/transaction.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

/// A piece of a segment on its way, with the edges that cross it up to its next stop.
struct Triangulation::Segment {
  explicit Segment(std::pmr::memory_resource* memory) : crossed(memory), made(memory) {}

  VertexId from = k_none;
  VertexId to = k_none;
  VertexId stop = k_none;              // the next vertex on it, or k_none: a constraint edge comes first
  Pair constraint = {k_none, k_none};  // that edge
  std::pmr::vector<Pair> crossed;      // origins right of the segment
  std::pmr::vector<Pair> made;
};

void Triangulation::constrain(VertexId a, VertexId b, std::uint8_t flags, Crossing crossing) {
  require_vertex(a);
  require_vertex(b);
  if (a == b) {
    throw Error(ErrorCode::invalid_argument, "a constraint from vertex %u to itself", a);
  }
  if (flags == 0) {
    throw Error(ErrorCode::invalid_argument, "a constraint from vertex %u to %u without flags", a, b);
  }
  transact([&] { constrain_along(a, b, flags, crossing); });
}

void Triangulation::constrain_along(VertexId a, VertexId b, std::uint8_t flags, Crossing crossing) {
  constrained_ = true;
  seamed_ = seamed_ || (flags & constraint::k_blocking) == 0;
  Segment segment(memory_);
  std::pmr::vector<VertexId> goals(memory_);
  goals.push_back(b);
  segment.from = a;
  // Rounded crossings may need more crossings; an honest segment has no more of them than there are edges.
  std::uint64_t crossings_left = mesh_.live_count();
  while (!goals.empty()) {
    segment.to = goals.back();
    const VertexId stop = next_stop(segment);
    if (stop != k_none) {
      force_edge(segment);
      const HalfEdge h = find_edge(segment.from, stop);
      mesh_.set_constraint(h, static_cast<std::uint8_t>(mesh_.constraint(h) | flags));
      report(segment.from);
      report(stop);
      segment.from = stop;
      if (stop == segment.to) {
        goals.pop_back();
      }
      continue;
    }
    const auto [c, d] = segment.constraint;
    if (crossing == Crossing::refuse || crossings_left-- == 0) {
      throw Error(ErrorCode::constraint, "the constraint from vertex %u to %u would cross that from %u to %u", a, b, c,
                  d);
    }
    const VertexId at = split_crossing(segment.from, segment.to, segment.constraint);
    if (at == segment.from || at == segment.to) {
      throw Error(ErrorCode::constraint,
                  "the constraint from vertex %u to %u crosses that from %u to %u too near to %u", a, b, c, d, at);
    }
    goals.push_back(at);
  }
}

// Follows the segment to the first vertex on it, or to a constraint edge across it.
VertexId Triangulation::next_stop(Segment& segment) const {
  segment.crossed.clear();
  segment.stop = k_none;
  const Vec2 from = positions_[segment.from];
  const Vec2 to = positions_[segment.to];
  const bool rising = lexicographically_less(from, to);
  HalfEdge h = mesh_.out(segment.from);
  for (;;) {
    const VertexId a = target(h);
    if (a != k_infinite) {
      const int side = a == segment.to ? 0 : orientation(from, to, positions_[a], lattice_);
      if (side == 0 && lexicographically_less(from, positions_[a]) == rising) {
        return segment.stop = a;
      }
      const VertexId b = apex(h);
      if (side < 0 && b != k_infinite && orientation(from, to, positions_[b], lattice_) > 0) {
        break;  // a right, b left and counter-clockwise from it: the segment goes between them
      }
    }
    h = rotate_ccw(h);
  }
  h = next(h);
  for (;;) {
    if (mesh_.constraint(h) != 0) {
      segment.constraint = {origin(h), target(h)};
      return k_none;
    }
    segment.crossed.push_back({origin(h), target(h)});
    h = twin(h);
    const VertexId c = apex(h);
    const int side = c == segment.to ? 0 : orientation(from, to, positions_[c], lattice_);
    if (side == 0) {
      return segment.stop = c;
    }
    h = side < 0 ? previous(h) : next(h);
  }
}

void Triangulation::force_edge(Segment& segment) {
  const Vec2 from = positions_[segment.from];
  const Vec2 to = positions_[segment.stop];
  segment.made.clear();
  // A queue: those that cannot be flipped yet wait until others were.
  std::size_t head = 0;
  std::size_t waiting = 0;
  while (head < segment.crossed.size()) {
    const auto [u, v] = segment.crossed[head++];
    const HalfEdge h = find_edge(u, v);
    const VertexId c = apex(h);
    const VertexId d = apex(twin(h));
    const Vec2 at_c = positions_[c], at_d = positions_[d];
    if (orientation(at_d, at_c, positions_[u], lattice_) <= 0 ||
        orientation(at_d, at_c, positions_[v], lattice_) >= 0) {
      segment.crossed.push_back({u, v});
      if (++waiting > segment.crossed.size()) {
        throw Error(ErrorCode::internal, "no edge across the constraint from vertex %u to %u can be flipped",
                    segment.from, segment.stop);
      }
    } else {
      waiting = 0;
      mesh_.flip(h);
      for (const VertexId vertex : {u, v, c, d}) {
        report(vertex);
      }
      const bool ends_here = c == segment.from || c == segment.stop || d == segment.from || d == segment.stop;
      if (!ends_here && orientation(from, to, at_c, lattice_) != orientation(from, to, at_d, lattice_)) {
        segment.crossed.push_back({c, d});
      } else {
        segment.made.push_back({c, d});
      }
    }
    if (head > 64 && head * 2 > segment.crossed.size()) {
      segment.crossed.erase(segment.crossed.begin(), segment.crossed.begin() + static_cast<std::ptrdiff_t>(head));
      head = 0;
    }
  }
  // The edge itself must stay while the others are made Delaunay.
  const HalfEdge edge = find_edge(segment.from, segment.stop);
  const std::uint8_t flags = mesh_.constraint(edge);
  if (flags == 0) {
    mesh_.set_constraint(edge, constraint::k_continuous);
  }
  stack_.clear();
  for (const auto& [c, d] : segment.made) {
    stack_.push_back(find_edge(c, d));
  }
  legalize();
  if (flags == 0) {
    mesh_.set_constraint(find_edge(segment.from, segment.stop), 0);
  }
}

void Triangulation::free_edge(HalfEdge h) {
  if (mesh_.state(triangle_of(h)) != mesh_.state(triangle_of(twin(h)))) {
    unmark_domain();
  }
  mesh_.set_constraint(h, 0);
}

void Triangulation::unconstrain(VertexId a, VertexId b) {
  require_vertex(a);
  require_vertex(b);
  if (a == b) {
    throw Error(ErrorCode::invalid_argument, "a constraint from vertex %u to itself", a);
  }
  transact([&] {
    stack_.clear();
    const Vec2 end = positions_[b];
    const bool rising = lexicographically_less(positions_[a], end);
    VertexId at = a;
    while (at != b) {
      HalfEdge h = mesh_.out(at);
      const HalfEdge first = h;
      const auto leads_on = [&] {
        const VertexId ahead = target(h);
        return mesh_.constraint(h) != 0 &&
               (ahead == b || (lexicographically_less(positions_[at], positions_[ahead]) == rising &&
                               lexicographically_less(positions_[ahead], end) == rising &&
                               orientation(positions_[at], end, positions_[ahead], lattice_) == 0));
      };
      while (!leads_on()) {
        h = rotate_ccw(h);
        if (h == first) {
          throw Error(ErrorCode::constraint, "there is no constraint from vertex %u to %u", a, b);
        }
      }
      free_edge(h);
      stack_.push_back(h);
      report(at);
      at = target(h);
    }
    report(b);
    legalize();
  });
}

}  // namespace radvor::delaunay
