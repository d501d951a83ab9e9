// Many points at once: in rounds that grow geometrically, each along a Hilbert curve, so that the next point is near
// the last one and no order of the input is bad (N. Amenta, S. Choi, G. Rote, "Incremental Constructions con BRIO",
// 2003).
#include <algorithm>
#include <limits>
#include <numeric>
#include <type_traits>

#include "base/error.h"
#include "delaunay/spatial_order.h"
#include "delaunay/transaction.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

namespace {
constexpr std::uint32_t k_most_at_once = 1u << 29;  // points: they have twice as many triangles
}  // namespace

void Triangulation::insert_many(std::span<const Vec2> points, VertexId* vertices) {
  for (const Vec2 point : points) {
    check(point);
  }
  if (points.empty()) {
    return;
  }
  if (points.size() > k_most_at_once) {
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
    changed_.clear();
    make_hints();
    return;
  }
  try {
    work();
    changed_.clear();
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

void Triangulation::reserve(std::uint32_t vertices) {
  if (vertices > k_most_at_once) {
    throw Error(ErrorCode::limit, "more than 2^29 points");
  }
  positions_.reserve(vertices);
  mesh_.reserve_vertices_exactly(vertices);
  mesh_.reserve_triangles_exactly(2 * vertices);
}

void Triangulation::trim() {
  const auto let_go = [](auto& vector) {
    std::remove_reference_t<decltype(vector)> none(vector.get_allocator());
    none.swap(vector);
  };
  mesh_.trim();
  let_go(reused_);
  let_go(changed_);
  let_go(changed_before_);
  let_go(reports_);
  let_go(stack_);
  let_go(cavity_.slots);
}

// The work is done with ids in the spatial order, so that what is near in the plane is near in memory; afterwards the
// vertices get the ids of the input's order, closed up where points coincide.
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
  for (const std::uint32_t index : order) {
    positions_.push_back(points[index]);
    lattice_.include(points[index]);
  }
  mesh_.append_vertices(count);

  std::pmr::vector<Duplicate> duplicates(memory_);
  // Until its turn comes, a new vertex is not there: the count tells.
  const VertexId end = first + count;
  for (VertexId p = first; p < end; ++p) {
    const Vec2 point = positions_[p];
    if (vertex_count_ >= 2) {
      const Location location = locate_from(point, mesh_.out(last_), lattice_);
      if (location.where == Where::vertex) {
        duplicates.push_back({p, location.vertices[0]});
        continue;
      }
      prepare(point, location);
      ++vertex_count_;
      place(p, location);
      if (steered_) {
        report_star(p);  // its ties follow at the end of the transaction
      }
    } else if (vertex_count_ == 1) {
      if (positions_[last_] == point) {
        duplicates.push_back({p, last_});
        continue;
      }
      ++vertex_count_;
      start_chain(last_, p);
    } else {
      ++vertex_count_;
      last_ = p;
    }
  }

  VertexId bound = end;
  if (duplicates.empty()) {
    std::copy(points.begin(), points.end(), positions_.begin() + first);
    if (vertices) {
      std::iota(vertices, vertices + count, first);
    }
  } else {
    bound -= static_cast<VertexId>(duplicates.size());
    number_without_duplicates(points, first, duplicates, order, vertices);
  }
  renumber(first, order, bound);
}

// Of coinciding points the earliest gives the id and its position. order: what the point was that became vertex
// first + i; after it: what to add to `first` for the id that the vertex is to have, k_none for duplicates.
void Triangulation::number_without_duplicates(std::span<const Vec2> points, VertexId first,
                                              std::span<const Duplicate> duplicates, std::span<std::uint32_t> order,
                                              VertexId* vertices) {
  const std::size_t count = order.size();
  std::pmr::vector<std::uint32_t> earliest(order.begin(), order.end(), memory_);  // point, of each vertex
  std::pmr::vector<VertexId> vertex_of(count, memory_);                           // of each point
  for (std::size_t i = 0; i < count; ++i) {
    vertex_of[order[i]] = static_cast<VertexId>(first + i);
  }
  for (const Duplicate& duplicate : duplicates) {
    const std::uint32_t point = order[duplicate.vertex - first];
    order[duplicate.vertex - first] = k_none;
    vertex_of[point] = duplicate.original;
    if (duplicate.original >= first) {
      std::uint32_t& least = earliest[duplicate.original - first];
      least = std::min(least, point);
    }
  }
  std::uint32_t id = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const VertexId v = vertex_of[i];
    if (v >= first && earliest[v - first] == i) {
      positions_[first + id] = points[i];
      order[v - first] = id++;
    }
  }
  if (vertices) {
    for (std::size_t i = 0; i < count; ++i) {
      vertices[i] = vertex_of[i] < first ? vertex_of[i] : first + order[vertex_of[i] - first];
    }
  }
}

// Vertex first + i gets the id first + renumbered[i], where that is not k_none; `end` is the bound of ids then.
void Triangulation::renumber(VertexId first, std::span<const std::uint32_t> renumbered, VertexId end) {
  std::pmr::vector<HalfEdge> outs(end - first, memory_);
  for (std::uint32_t i = 0; i < renumbered.size(); ++i) {
    if (renumbered[i] != k_none) {
      outs[renumbered[i]] = mesh_.out(first + i);
    }
  }
  const auto renamed = [&](VertexId v) { return v >= first && v < k_infinite ? first + renumbered[v - first] : v; };
  for (TriangleId t = 0; t < mesh_.record_count(); ++t) {
    const auto& v = mesh_.triangle(t).vertex;
    if (!mesh_.is_free(t) && ((v[0] >= first && v[0] < k_infinite) || (v[1] >= first && v[1] < k_infinite) ||
                              (v[2] >= first && v[2] < k_infinite))) {
      for (VertexId& corner : mesh_.write(t).vertex) {
        corner = renamed(corner);
      }
    }
  }
  last_ = renamed(last_);
  for (VertexId& vertex : changed_) {
    vertex = renamed(vertex);
  }
  positions_.resize(end);
  if (!values_.empty()) {
    values_.resize(end);
  }
  mesh_.set_last_outs(outs, first);
}

}  // namespace radvor::delaunay
