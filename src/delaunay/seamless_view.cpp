#include "delaunay/seamless_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "delaunay/circumcentre.h"

namespace radvor::delaunay {

namespace {

// The disk of a circumcircle, a little larger than it is: what meets the true one meets this.
struct Disk {
  Disk(Vec2 a, Vec2 b, Vec2 c) : centre(circumcentre(a, b, c)) {
    const Vec2 radius = a - centre;
    square = 1.0001 * glm::dot(radius, radius);
  }
  bool meets(Vec2 a, Vec2 b) const {
    const Vec2 along = b - a;
    const double share = std::clamp(glm::dot(centre - a, along) / glm::dot(along, along), 0.0, 1.0);
    const Vec2 nearest = a + share * along - centre;
    return !(glm::dot(nearest, nearest) > square);
  }
  Vec2 centre;
  double square;
};

}  // namespace

void SeamlessView::look(const Triangulation& triangulation, VertexId site) {
  triangulation_ = &triangulation;
  site_ = site;
  index_.clear();
  changed_.clear();
  out_ = triangulation.out(site);
  if (out_ == k_none || !triangulation.may_have_continuous_constraints()) {
    return;
  }
  // Until every triangle of the star has seen all that its circle holds.
  HalfEdge unseen = out_, end = k_none;
  while (unseen != end) {
    if (is_inside(triangle_of(unseen)) && improve_beyond(unseen)) {
      unseen = out_;
      end = k_none;
    } else {
      unseen = rotate_ccw(unseen);
      end = out_;
    }
  }
}

HalfEdge SeamlessView::find_out(VertexId target_vertex) const {
  HalfEdge h = out_;
  do {
    if (target(h) == target_vertex) {
      return h;
    }
    h = rotate_ccw(h);
  } while (h != out_);
  return k_none;
}

Triangle& SeamlessView::write(TriangleId t) {
  if (index_.add(t)) {
    changed_.push_back(triangulation_->mesh().triangle(t));
  }
  return changed_[index_.find(t)];
}

bool SeamlessView::flips(HalfEdge h) const {
  if (blocks(h)) {
    return false;
  }
  const Vec2 a = triangulation_->position(origin(h)), b = triangulation_->position(target(h));
  const Vec2 c = triangulation_->position(apex(h)), d = triangulation_->position(apex(twin(h)));
  const int side = in_circle(a, b, c, d, triangulation_->lattice());
  return side > 0 || (side == 0 && wins_tie(a, b, c, d));
}

// As Mesh::flip, and what is kept along the diagonal is forgotten.
void SeamlessView::flip(HalfEdge h) {
  const HalfEdge opposite = twin(h);
  const TriangleId t = triangle_of(h), u = triangle_of(opposite);
  const HalfEdge sides[4] = {previous(h), next(opposite), previous(opposite), next(h)};  // c-a, a-d, d-b, b-c
  const VertexId a = origin(h), b = target(h), c = apex(h), d = apex(opposite);
  std::array<HalfEdge, 4> beyond;
  std::array<std::uint8_t, 4> flags;
  for (std::size_t i = 0; i < 4; ++i) {
    beyond[i] = twin(sides[i]);
    flags[i] = record(triangle_of(sides[i])).constraint[corner_of(sides[i])];
  }
  Triangle& first = write(t);
  first.vertex = {c, a, d};
  first.constraint = {flags[0], flags[1], 0};
  first.twin = {beyond[0], beyond[1], half_edge(u, 2)};
  Triangle& second = write(u);
  second.vertex = {d, b, c};
  second.constraint = {flags[2], flags[3], 0};
  second.twin = {beyond[2], beyond[3], half_edge(t, 2)};
  const HalfEdge moved[4] = {half_edge(t, 0), half_edge(t, 1), half_edge(u, 0), half_edge(u, 1)};
  for (std::size_t i = 0; i < 4; ++i) {
    write(triangle_of(beyond[i])).twin[corner_of(beyond[i])] = moved[i];
  }
  if (site_ == a || site_ == c) {
    out_ = half_edge(t, site_ == c ? 0 : 1);
  } else if (site_ == b || site_ == d) {
    out_ = half_edge(u, site_ == d ? 0 : 1);
  }
}

// Seen from a triangle, the edges on the way to any vertex in its circle meet its disk; if all of them are locally
// Delaunay, no such vertex is seen. Flips (and those that follow from it) the first edge that is not.
bool SeamlessView::improve_beyond(HalfEdge spoke) {
  const Disk disk(triangulation_->position(origin(spoke)), triangulation_->position(target(spoke)),
                  triangulation_->position(apex(spoke)));
  visited_.clear();
  visited_.add(triangle_of(spoke));
  stack_.assign(1, triangle_of(spoke));
  while (!stack_.empty()) {
    const TriangleId t = stack_.back();
    stack_.pop_back();
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const HalfEdge h = half_edge(t, corner);
      if (blocks(h) || !disk.meets(triangulation_->position(origin(h)), triangulation_->position(target(h)))) {
        continue;
      }
      if (flips(h)) {
        pending_.assign(1, h);
        while (!pending_.empty()) {
          const HalfEdge edge = pending_.back();
          pending_.pop_back();
          if (flips(edge)) {
            const TriangleId one = triangle_of(edge), other = triangle_of(twin(edge));
            flip(edge);
            pending_.insert(pending_.end(),
                            {half_edge(one, 0), half_edge(one, 1), half_edge(other, 0), half_edge(other, 1)});
          }
        }
        return true;
      }
      if (visited_.add(triangle_of(twin(h)))) {
        stack_.push_back(triangle_of(twin(h)));
      }
    }
  }
  return false;
}

}  // namespace radvor::delaunay
