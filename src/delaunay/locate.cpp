// Where a point is. A visibility walk from triangle to triangle; it may go round in circles where constraints make the
// triangulation not Delaunay (Devillers, Pion, Teillaud, "Walking in a Triangulation", 2002), so after a generous
// number of steps the walk goes on along the straight line, which ends in any triangulation.
#include <cmath>

#include "base/error.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

Location Triangulation::locate(Vec2 point, VertexId* hint) const {
  check(point);
  Location location;
  if (vertex_count_ == 0) {
    return location;
  }
  if (vertex_count_ == 1) {
    const VertexId only = only_vertex();
    if (positions_[only] == point) {
      location.where = Where::vertex;
      location.vertices[0] = only;
    }
  } else {
    Lattice lattice = lattice_;
    lattice.include(point);
    location = locate_from(point, start_near(point, hint ? *hint : k_none), lattice);
  }
  if (hint) {
    *hint = location.vertices[0];
    if (location.where == Where::outside && location.edge != k_none) {
      *hint = origin(location.edge) != k_infinite ? origin(location.edge) : target(location.edge);
    }
    if (*hint != k_none) {
      mesh_.prefetch_out(*hint);
    }
  }
  return location;
}

HalfEdge Triangulation::start_near(Vec2 point, VertexId hint) const {
  if (!(hint < vertex_bound() && is_vertex(hint))) {
    hint = hints_.near(point);
    if (!(hint < vertex_bound() && is_vertex(hint))) {
      hint = last_;
    }
  }
  return mesh_.out(hint);
}

void Triangulation::note_for_hints(VertexId vertex) {
  if (hints_.is_too_coarse(vertex_count_)) {
    hints_.rebuild(vertex_count_, positions_, [&](VertexId v) { return is_vertex(v); });
  } else {
    hints_.note(positions_[vertex], vertex);
  }
}

Location Triangulation::describe(Where where, HalfEdge h) const {
  Location location;
  location.where = where;
  location.edge = h;
  if (where != Where::outside) {
    location.vertices[0] = origin(h);
  }
  if (where == Where::edge || where == Where::triangle) {
    location.vertices[1] = target(h);
  }
  if (where == Where::triangle) {
    location.vertices[2] = apex(h);
  }
  return location;
}

Location Triangulation::locate_from(Vec2 point, HalfEdge start, const Lattice& lattice) const {
  if (flat_) {
    return walk_chain(point, start, lattice);
  }
  // Leave a ghost over its real edge.
  HalfEdge h = start;
  if (is_ghost(triangle_of(h))) {
    while (apex(h) != k_infinite) {
      h = next(h);
    }
    h = twin(h);
  }
  // The first triangle's three edges, then the two others of each triangle: the point is beyond the one entered by.
  int entry_side = orientation(positions_[origin(h)], positions_[target(h)], point, lattice);
  if (entry_side < 0) {
    h = twin(h);
    entry_side = 1;
  }
  // Without constraints a visibility walk cannot go round in circles.
  const auto most_steps =
      constrained_ ? static_cast<std::uint64_t>(64 + 8 * std::sqrt(static_cast<double>(vertex_count_))) : UINT64_MAX;
  // Positions wait for memory: those that the next step may ask for are fetched while this one decides.
  const auto look_ahead = [&](HalfEdge beyond) {
    const VertexId v = apex(beyond);
    __builtin_prefetch(positions_.data() + (v == k_infinite ? 0 : v));
  };
  bool right_first = true;  // the side taken last comes first: around a vertex that is one question a triangle
  for (std::uint64_t step = 0; step < most_steps; ++step) {
    const VertexId c = apex(h);
    if (c == k_infinite) {
      return describe(Where::outside, h);
    }
    look_ahead(twin(next(h)));
    look_ahead(twin(previous(h)));
    const Vec2 at_c = positions_[c];
    const auto side_of_right = [&] { return orientation(positions_[target(h)], at_c, point, lattice); };
    const auto side_of_left = [&] { return orientation(at_c, positions_[origin(h)], point, lattice); };
    int right = right_first ? side_of_right() : 0;
    int left = 0;
    if (right >= 0) {
      left = side_of_left();
      if (!right_first && left >= 0) {
        right = side_of_right();
      }
    }
    if (right < 0 || left < 0) {
      right_first = left < 0;
      h = twin(right < 0 ? next(h) : previous(h));
      entry_side = 1;
      continue;
    }
    // Inside or on the border of this triangle.
    if (entry_side > 0 && right > 0 && left > 0) {
      return describe(Where::triangle, h);
    }
    if (right == 0) {
      return left == 0         ? describe(Where::vertex, previous(h))
             : entry_side == 0 ? describe(Where::vertex, next(h))
                               : describe(Where::edge, next(h));
    }
    if (left == 0) {
      return entry_side == 0 ? describe(Where::vertex, h) : describe(Where::edge, previous(h));
    }
    return describe(Where::edge, h);
  }
  return straight_walk(point, origin(h), lattice);
}

// From a vertex towards the point, over the edges that the segment crosses; anew from every vertex on it.
Location Triangulation::straight_walk(Vec2 point, VertexId start, const Lattice& lattice) const {
  VertexId source = start;
  for (;;) {
    const Vec2 from = positions_[source];
    if (from == point) {
      return describe(Where::vertex, mesh_.out(source));
    }
    // The triangle of the star that the direction enters.
    HalfEdge h = mesh_.out(source);
    const HalfEdge first = h;
    int side_a = 0;
    HalfEdge visible_ghost = k_none;
    bool found = false;
    do {
      const VertexId a = target(h);
      const VertexId b = apex(h);
      if (a == k_infinite || b == k_infinite) {
        const HalfEdge hull = a == k_infinite ? previous(h) : h;  // the real edge of the ghost
        if (orientation(positions_[origin(hull)], positions_[target(hull)], point, lattice) > 0) {
          visible_ghost = hull;
        }
      } else {
        side_a = orientation(from, positions_[a], point, lattice);
        found = side_a >= 0 && orientation(from, positions_[b], point, lattice) < 0;
        if (found) {
          break;
        }
      }
      h = rotate_ccw(h);
    } while (h != first);
    if (!found) {
      // Not towards a triangle, or along the last edge before a ghost.
      h = first;
      do {
        const VertexId a = target(h);
        if (a != k_infinite && orientation(from, positions_[a], point, lattice) == 0) {
          const Vec2 at = positions_[a];
          if (lexicographically_less(from, at) == lexicographically_less(from, point)) {
            found = true;
            side_a = 0;
            break;
          }
        }
        h = rotate_ccw(h);
      } while (h != first);
      if (!found) {
        return describe(Where::outside, visible_ghost);
      }
    }
    if (side_a == 0) {
      const Vec2 at = positions_[target(h)];
      const bool rising = lexicographically_less(from, point);
      if (point == at || (rising ? lexicographically_less(at, point) : lexicographically_less(point, at))) {
        source = target(h);
        continue;
      }
      return describe(Where::edge, is_ghost(triangle_of(h)) ? twin(h) : h);
    }
    // Across the edges; origin(h) is right of the line, target(h) left of it.
    h = next(h);
    for (;;) {
      const int side = orientation(positions_[origin(h)], positions_[target(h)], point, lattice);
      if (side >= 0) {
        return describe(side > 0 ? Where::triangle : Where::edge, h);
      }
      h = twin(h);
      const VertexId c = apex(h);
      if (c == k_infinite) {
        return describe(Where::outside, h);
      }
      const int side_c = orientation(from, point, positions_[c], lattice);
      if (side_c == 0) {
        const bool rising = lexicographically_less(from, point);
        const Vec2 at = positions_[c];
        if (rising ? lexicographically_less(point, at) : lexicographically_less(at, point)) {
          return describe(Where::triangle, h);
        }
        source = c;
        break;
      }
      h = side_c > 0 ? next(h) : previous(h);
    }
  }
}

TriangleId Triangulation::locate_roughly(Vec2 point, std::array<double, 3>& weights, TriangleId start) const {
  if (flat_ || vertex_count_ < 3) {
    return k_none;
  }
  TriangleId t = start;
  if (t == k_none) {
    HalfEdge h = start_near(point, k_none);
    while (apex(h) != k_infinite && is_ghost(triangle_of(h))) {
      h = next(h);
    }
    t = triangle_of(is_ghost(triangle_of(h)) ? twin(h) : h);
  }
  constexpr int k_most_steps = 64;
  for (int step = 0; step < k_most_steps && !is_ghost(t); ++step) {
    const Triangle& triangle = mesh_.triangle(t);
    const std::array<Vec2, 3> corners = {positions_[triangle.vertex[0]], positions_[triangle.vertex[1]],
                                         positions_[triangle.vertex[2]]};
    std::size_t beyond = 0;  // the edge that the point is farthest beyond
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2& from = corners[(k + 1) % 3];
      weights[k] = cross(corners[(k + 2) % 3] - from, point - from);
      beyond = weights[k] < weights[beyond] ? k : beyond;
    }
    if (weights[beyond] >= 0) {
      const double sum = weights[0] + weights[1] + weights[2];
      if (!(sum > 0)) {
        return k_none;
      }
      for (double& weight : weights) {
        weight /= sum;
      }
      return t;
    }
    t = triangle_of(triangle.twin[(beyond + 1) % 3]);
  }
  return k_none;
}

// All vertices on one line, in lexicographic order along the chain of edges.
Location Triangulation::walk_chain(Vec2 point, HalfEdge start, const Lattice& lattice) const {
  HalfEdge h = start;
  while (apex(h) != k_infinite) {
    h = next(h);
  }
  const int side = orientation(positions_[origin(h)], positions_[target(h)], point, lattice);
  if (side != 0) {
    return describe(Where::outside, side > 0 ? h : twin(h));
  }
  if (point == positions_[origin(h)]) {
    return describe(Where::vertex, h);
  }
  // Along the chain towards the point, which from now on is beyond the origin of h.
  const bool rising = lexicographically_less(positions_[origin(h)], point);
  if (lexicographically_less(positions_[origin(h)], positions_[target(h)]) != rising) {
    h = twin(h);
  }
  for (;;) {
    const Vec2 to = positions_[target(h)];
    if (point == to) {
      return describe(Where::vertex, next(h));
    }
    if (lexicographically_less(point, to) == rising) {
      return describe(Where::edge, h);
    }
    const HalfEdge ahead = next(twin(next(h)));
    if (target(ahead) == origin(h)) {
      return describe(Where::outside, ahead);  // out of the last vertex, back along the chain
    }
    h = ahead;
  }
}

}  // namespace radvor::delaunay
