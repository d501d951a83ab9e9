// Surgery on triangle records, and the transactions that undo it.
#include "delaunay/mesh.h"

#include <algorithm>
#include <cassert>

#include "base/error.h"

namespace radvor::delaunay {

namespace {
// Half-edges are 4 t + i and the two highest ids are taken.
constexpr std::uint32_t k_most_triangles = (1u << 30) - 2;

// Records: most constraints of small triangulations change no more.
constexpr std::size_t k_first_saved = 16;

template <class Vector>
void grow_to_hold(Vector& vector, std::size_t size) {
  if (vector.capacity() < size) {
    vector.reserve(std::max(size, vector.capacity() + vector.capacity() / 2));
  }
}
}  // namespace

Mesh::Mesh(std::pmr::memory_resource* memory) : triangles_(memory), outs_(memory), saved_(memory) {}

void Mesh::reserve_triangles(std::uint32_t more) {
  if (more > free_count_) {
    const std::size_t size = triangles_.size() + (more - free_count_);
    if (size > k_most_triangles) {
      throw Error(ErrorCode::limit, "more than %u triangles", k_most_triangles);
    }
    grow_to_hold(triangles_, size);
  }
}

void Mesh::reserve_triangles_exactly(std::uint32_t total) {
  if (total > k_most_triangles) {
    throw Error(ErrorCode::limit, "more than %u triangles", k_most_triangles);
  }
  triangles_.reserve(total);
}

void Mesh::reserve_vertex() {
  grow_to_hold(outs_, outs_.size() + 1);
}

TriangleId Mesh::allocate() {
  if (free_ != k_none) {
    const TriangleId t = free_;
    Triangle& record = write(t);
    free_ = record.vertex[0];
    --free_count_;
    record.state = 0;
    record.constraint = {};
    return t;
  }
  triangles_.push_back(Triangle{{}, {}, 0, {k_none, k_none, k_none}, 0});
  return record_count() - 1;
}

void Mesh::release(TriangleId t) {
  Triangle& record = write(t);
  record.state = Triangle::k_free;
  record.vertex[0] = free_;
  free_ = t;
  ++free_count_;
}

void Mesh::set_constraint(HalfEdge h, std::uint8_t flags) {
  const HalfEdge other = twin(h);
  write(triangle_of(h)).constraint[corner_of(h)] = flags;
  write(triangle_of(other)).constraint[corner_of(other)] = flags;
}

// before:    c           after:    c
//           / \                   /|\.
//          / t \                 / | \.
//         a --h-> b             a t|u b
//          \ u /                 \ | /
//           \ /                   \|/
//            d                     d
HalfEdge Mesh::flip(HalfEdge h) {
  const HalfEdge opposite = twin(h);
  const TriangleId t = triangle_of(h);
  const TriangleId u = triangle_of(opposite);
  const HalfEdge bc = next(h), ca = previous(h);
  const HalfEdge ad = next(opposite), db = previous(opposite);
  const VertexId a = origin(h), b = origin(opposite), c = origin(ca), d = origin(db);
  const HalfEdge bc_twin = twin(bc), ca_twin = twin(ca), ad_twin = twin(ad), db_twin = twin(db);
  const std::uint8_t bc_flags = constraint(bc), ca_flags = constraint(ca);
  const std::uint8_t ad_flags = constraint(ad), db_flags = constraint(db);
  const std::uint8_t t_state = state(t), u_state = state(u);

  set_triangle(t, c, a, d, t_state);  // ca, ad, dc
  set_triangle(u, d, b, c, u_state);  // db, bc, cd
  triangles_[t].constraint = {ca_flags, ad_flags, 0};
  triangles_[u].constraint = {db_flags, bc_flags, 0};
  link(half_edge(t, 0), ca_twin);
  link(half_edge(t, 1), ad_twin);
  link(half_edge(u, 0), db_twin);
  link(half_edge(u, 1), bc_twin);
  link(half_edge(t, 2), half_edge(u, 2));
  return half_edge(u, 2);
}

void Mesh::clear() {
  triangles_.clear();
  outs_.clear();
  free_ = k_none;
  free_count_ = 0;
}

void Mesh::begin() {
  assert(transaction_ == 0);
  if (last_transaction_ == UINT32_MAX) {  // marks start over
    for (Triangle& record : triangles_) {
      record.mark = 0;
    }
    last_transaction_ = 0;
  }
  transaction_ = ++last_transaction_;
  saved_.clear();
  saved_records_ = record_count();
  saved_vertices_ = vertex_capacity();
  saved_free_ = free_;
  saved_free_count_ = free_count_;
}

void Mesh::remember(TriangleId t) {
  if (t < saved_records_ && triangles_[t].mark != transaction_) {
    if (saved_.capacity() == 0) {
      saved_.reserve(k_first_saved);
    }
    saved_.push_back({t, triangles_[t]});
    triangles_[t].mark = transaction_;
  }
}

void Mesh::commit() {
  transaction_ = 0;
  saved_.clear();
}

void Mesh::rollback() noexcept {
  transaction_ = 0;
  triangles_.resize(saved_records_);  // never more than there are
  outs_.resize(saved_vertices_);
  for (const Saved& saved : saved_) {
    triangles_[saved.id] = saved.record;
  }
  // Memory may have run out between two records of one step, so which vertices lost their half-edges is not known.
  for (TriangleId t = 0; t < saved_records_ && !saved_.empty(); ++t) {
    for (std::uint32_t corner = 0; corner < 3 && !is_free(t); ++corner) {
      if (triangles_[t].vertex[corner] != k_infinite) {
        outs_[triangles_[t].vertex[corner]] = half_edge(t, corner);
      }
    }
  }
  free_ = saved_free_;
  free_count_ = saved_free_count_;
  saved_.clear();
}

}  // namespace radvor::delaunay
