// Many points at once: in rounds that grow geometrically, each along a Hilbert curve, so that the next point is near
// the last one and no order of the input is bad (N. Amenta, S. Choi, G. Rote, "Incremental Constructions con BRIO",
// 2003).
#include <algorithm>
#include <limits>

#include "base/error.h"
#include "delaunay/spatial_order.h"
#include "delaunay/transaction.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

void Triangulation::insert_many(std::span<const Vec2> points, VertexId* vertices) {
  for (const Vec2 point : points) {
    check(point);
  }
  changed_.clear();
  if (points.empty()) {
    return;
  }
  if (points.size() > (1u << 29)) {
    throw Error(ErrorCode::limit, "more than 2^29 points");
  }
  const bool from_nothing = vertex_count_ == 0 && positions_.empty();
  const Lattice lattice = lattice_;
  const auto work = [&] { insert_all(points, vertices); };
  const auto make_hints = [&] {
    if (hints_.is_too_coarse(vertex_count_)) {
      hints_.rebuild(vertex_count_, positions_, [&](VertexId v) { return is_vertex(v); });
    }
  };
  if (!from_nothing) {
    transact(work);
    make_hints();
    return;
  }
  try {
    work();
    make_hints();
  } catch (...) {
    mesh_.clear();
    positions_.clear();
    vertex_count_ = 0;
    last_ = k_none;
    flat_ = true;
    lattice_ = lattice;
    throw;
  }
}

// The point with index i becomes vertex first + i; where points coincide ids are closed up afterwards.
void Triangulation::insert_all(std::span<const Vec2> points, VertexId* vertices) {
  const VertexId first = vertex_bound();
  const auto count = static_cast<std::uint32_t>(points.size());
  std::pmr::vector<std::uint32_t> order(memory_);
  spatial_order(points, order, memory_);

  positions_.reserve(first + count);
  mesh_.reserve_vertices_exactly(first + count);
  mesh_.reserve_triangles(2 * count);
  if (!values_.empty()) {
    values_.resize(first + count, std::numeric_limits<double>::quiet_NaN());
  }
  positions_.insert(positions_.end(), points.begin(), points.end());
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh_.append_vertex();
    lattice_.include(points[i]);
  }

  struct Duplicate {
    std::uint32_t index;
    VertexId original;
  };
  std::pmr::vector<Duplicate> duplicates(memory_);
  // Until its turn comes, a new vertex is not there: the count tells.
  VertexId before_last = last_;
  for (std::uint32_t k = 0; k < count; ++k) {
    const VertexId p = first + order[k];
    if (k + 4 < count) {
      __builtin_prefetch(&positions_[first + order[k + 4]]);
    }
    const Vec2 point = positions_[p];
    if (vertex_count_ == 0) {
      ++vertex_count_;
      last_ = p;
      continue;
    }
    if (vertex_count_ == 1) {
      if (positions_[last_] == point) {
        duplicates.push_back({order[k], last_});
        continue;
      }
      before_last = last_;
      ++vertex_count_;
      start_chain(before_last, p);
      continue;
    }
    const Location location = locate_from(point, mesh_.out(last_), lattice_);
    if (location.where == Where::vertex) {
      duplicates.push_back({order[k], location.vertices[0]});
      continue;
    }
    prepare(point, location);
    ++vertex_count_;
    place(p, location);
  }
  if (duplicates.empty()) {
    if (vertices) {
      for (std::uint32_t i = 0; i < count; ++i) {
        vertices[i] = first + i;
      }
    }
    return;
  }

  // original[i]: the vertex at point i. A group's id is that of its earliest point.
  std::pmr::vector<VertexId> original(count, memory_);
  std::pmr::vector<VertexId> earliest(count, memory_);
  for (std::uint32_t i = 0; i < count; ++i) {
    original[i] = earliest[i] = first + i;
  }
  for (const Duplicate& duplicate : duplicates) {
    original[duplicate.index] = duplicate.original;
    if (duplicate.original >= first) {
      VertexId& lowest = earliest[duplicate.original - first];
      lowest = std::min(lowest, first + duplicate.index);
    }
  }
  std::pmr::vector<VertexId> renumbered(count, k_none, memory_);
  VertexId id = first;
  for (std::uint32_t i = 0; i < count; ++i) {
    const VertexId v = original[i];
    if (v >= first && earliest[v - first] == first + i) {
      renumbered[v - first] = id++;
    }
  }
  renumber(first, renumbered, id);
  if (vertices) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const VertexId v = original[i];
      vertices[i] = v < first ? v : renumbered[v - first];
    }
  }
}

// Vertex first + i gets the id renumbered[i], if it has any; `end` is the bound of ids then.
void Triangulation::renumber(VertexId first, std::span<const VertexId> renumbered, VertexId end) {
  std::pmr::vector<Vec2> positions(end - first, memory_);
  std::pmr::vector<HalfEdge> outs(end - first, memory_);
  for (std::size_t i = 0; i < renumbered.size(); ++i) {
    if (renumbered[i] != k_none) {
      positions[renumbered[i] - first] = positions_[first + i];
      outs[renumbered[i] - first] = mesh_.out(static_cast<VertexId>(first + i));
    }
  }
  const auto renamed = [&](VertexId v) { return v >= first && v < k_infinite ? renumbered[v - first] : v; };
  for (TriangleId t = 0; t < mesh_.record_count(); ++t) {
    const Triangle& record = mesh_.triangle(t);
    if (!mesh_.is_free(t) &&
        (renamed(record.vertex[0]) != record.vertex[0] || renamed(record.vertex[1]) != record.vertex[1] ||
         renamed(record.vertex[2]) != record.vertex[2])) {
      for (VertexId& v : mesh_.write(t).vertex) {
        v = renamed(v);
      }
    }
  }
  last_ = renamed(last_);
  positions_.resize(end);
  std::copy(positions.begin(), positions.end(), positions_.begin() + first);
  if (!values_.empty()) {
    values_.resize(end);
  }
  while (mesh_.vertex_capacity() > end) {
    mesh_.drop_last_vertex();
  }
  for (VertexId v = first; v < end; ++v) {
    mesh_.set_out(v, outs[v - first]);
  }
}

}  // namespace radvor::delaunay
