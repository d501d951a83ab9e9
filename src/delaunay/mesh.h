// The topology of a triangulated sphere: 32-byte triangle records with 32-bit ids, and the surgery on them. It never
// sees a coordinate. Besides the real vertices there is the infinite one, k_infinite: a triangle that has it is a
// *ghost* and stands for what lies beyond one edge of the convex hull. So every edge has two sides and every star
// closes, also where all vertices are collinear: then all triangles are ghosts, two to an edge of the chain.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace radvor::delaunay {

using VertexId = std::uint32_t;
using TriangleId = std::uint32_t;

/// The edge from corner i of triangle t to its corner i + 1, with t on its left: 4 t + i.
using HalfEdge = std::uint32_t;

inline constexpr std::uint32_t k_none = UINT32_MAX;
inline constexpr VertexId k_infinite = UINT32_MAX - 1;

inline constexpr TriangleId triangle_of(HalfEdge h) {
  return h >> 2;
}
inline constexpr std::uint32_t corner_of(HalfEdge h) {
  return h & 3u;
}
inline constexpr HalfEdge half_edge(TriangleId triangle, std::uint32_t corner) {
  return (triangle << 2) | corner;
}
/// The next half-edge of the same triangle, counter-clockwise.
inline constexpr HalfEdge next(HalfEdge h) {
  return (h & 3u) == 2u ? h - 2u : h + 1u;
}
inline constexpr HalfEdge previous(HalfEdge h) {
  return (h & 3u) == 0u ? h + 2u : h - 1u;
}

struct alignas(32) Triangle {
  static constexpr std::uint8_t k_outside = 1;  ///< of the domain
  static constexpr std::uint8_t k_free = 2;     ///< no triangle: vertex[0] is the next free record

  std::array<VertexId, 3> vertex;
  std::array<std::uint8_t, 3> constraint;  ///< of edge i; 0: none
  std::uint8_t state;
  std::array<HalfEdge, 3> twin;  ///< of edge i
  std::uint32_t mark;            ///< the last transaction that wrote here
};
static_assert(sizeof(Triangle) == 32);

class Mesh {
 public:
  explicit Mesh(std::pmr::memory_resource* memory);

  // ---- Reading

  VertexId origin(HalfEdge h) const { return triangles_[triangle_of(h)].vertex[corner_of(h)]; }
  VertexId target(HalfEdge h) const { return origin(next(h)); }
  VertexId apex(HalfEdge h) const { return origin(previous(h)); }
  HalfEdge twin(HalfEdge h) const { return triangles_[triangle_of(h)].twin[corner_of(h)]; }
  std::uint8_t constraint(HalfEdge h) const { return triangles_[triangle_of(h)].constraint[corner_of(h)]; }
  const Triangle& triangle(TriangleId t) const { return triangles_[t]; }
  std::uint8_t state(TriangleId t) const { return triangles_[t].state; }

  /// The half-edges out of one vertex, in counter-clockwise and clockwise order.
  HalfEdge rotate_ccw(HalfEdge out) const { return twin(previous(out)); }
  HalfEdge rotate_cw(HalfEdge out) const { return next(twin(out)); }

  bool is_free(TriangleId t) const { return (triangles_[t].state & Triangle::k_free) != 0; }
  bool is_ghost(TriangleId t) const {
    const auto& v = triangles_[t].vertex;
    return v[0] == k_infinite || v[1] == k_infinite || v[2] == k_infinite;
  }

  std::uint32_t record_count() const { return static_cast<std::uint32_t>(triangles_.size()); }
  TriangleId first_free() const { return free_; }  ///< and so on in their vertex[0]; k_none after the last
  std::uint32_t live_count() const { return record_count() - free_count_; }  ///< triangles, ghosts included

  /// A half-edge out of the vertex, k_none where it has none (a single vertex).
  HalfEdge out(VertexId v) const { return outs_[v]; }
  void prefetch_out(VertexId v) const { __builtin_prefetch(&outs_[v]); }
  std::uint32_t vertex_capacity() const { return static_cast<std::uint32_t>(outs_.size()); }

  // ---- Room: after these the surgery below allocates nothing (outside of a transaction)

  void reserve_triangles(std::uint32_t more);
  void reserve_triangles_exactly(std::uint32_t total);
  void reserve_vertices_exactly(std::uint32_t total) { outs_.reserve(total); }
  void reserve_vertex();
  void append_vertex() { outs_.push_back(k_none); }
  void append_vertices(std::uint32_t count) { outs_.resize(outs_.size() + count, k_none); }
  /// Of the vertices from `first` on; there are no others after them.
  void set_last_outs(std::span<const HalfEdge> outs, VertexId first) {
    outs_.resize(first + outs.size());
    std::copy(outs.begin(), outs.end(), outs_.begin() + first);
  }
  void set_out(VertexId v, HalfEdge h) { outs_[v] = h; }

  // ---- Surgery

  TriangleId allocate();
  void release(TriangleId t);
  /// For writing whole records: a transaction remembers what was there.
  Triangle& write(TriangleId t) {
    if (transaction_ != 0) {
      remember(t);
    }
    return triangles_[t];
  }
  void link(HalfEdge a, HalfEdge b) {
    write(triangle_of(a)).twin[corner_of(a)] = b;
    write(triangle_of(b)).twin[corner_of(b)] = a;
  }
  /// Without constraints; its twins are to be linked.
  void set_triangle(TriangleId t, VertexId a, VertexId b, VertexId c, std::uint8_t state) {
    Triangle& record = write(t);
    record.vertex = {a, b, c};
    record.constraint = {};
    record.state = state;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      if (record.vertex[corner] != k_infinite) {
        outs_[record.vertex[corner]] = half_edge(t, corner);
      }
    }
  }
  /// A triangle of a fan around p: (p, b, a) inside of the half-edge a-b, whose constraint it shares; no twins at p
  /// yet.
  void set_fan_triangle(TriangleId t, VertexId p, HalfEdge outer, std::uint8_t state) {
    const Triangle& beyond = write(triangle_of(outer));
    const std::uint32_t corner = corner_of(outer);
    const VertexId a = beyond.vertex[corner];
    const VertexId b = beyond.vertex[corner == 2 ? 0 : corner + 1];
    triangles_[triangle_of(outer)].twin[corner] = half_edge(t, 1);
    Triangle& record = write(t);
    record.vertex = {p, b, a};
    record.constraint = {0, beyond.constraint[corner], 0};
    record.state = state;
    record.twin[1] = outer;
    if (b != k_infinite) {
      outs_[b] = half_edge(t, 1);
    }
  }
  /// The origin of h becomes another vertex.
  void replace_corner(HalfEdge h, VertexId v) {
    write(triangle_of(h)).vertex[corner_of(h)] = v;
    outs_[v] = h;
  }
  /// Both sides of the edge.
  void set_constraint(HalfEdge h, std::uint8_t flags);
  void set_state(TriangleId t, std::uint8_t state) { write(t).state = state; }

  /// Turns the diagonal of the two triangles at h; returns the new diagonal, from the apex of h to that of its twin.
  HalfEdge flip(HalfEdge h);

  void clear();

  // ---- Transactions: what is done between begin and commit can be undone

  void begin();
  void commit();
  void rollback() noexcept;
  bool in_transaction() const { return transaction_ != 0; }
  /// Lets go of the memory that transactions keep for the next ones; not within one.
  void trim() {
    assert(!in_transaction());
    std::pmr::vector<Saved>(saved_.get_allocator()).swap(saved_);
  }

 private:
  struct Saved {
    TriangleId id;
    Triangle record;
  };

  void remember(TriangleId t);

  std::pmr::vector<Triangle> triangles_;
  std::pmr::vector<HalfEdge> outs_;
  TriangleId free_ = k_none;
  std::uint32_t free_count_ = 0;

  std::uint32_t transaction_ = 0;  // 0: none
  std::uint32_t last_transaction_ = 0;
  std::pmr::vector<Saved> saved_;
  std::uint32_t saved_records_ = 0;
  std::uint32_t saved_vertices_ = 0;
  TriangleId saved_free_ = k_none;
  std::uint32_t saved_free_count_ = 0;
};

}  // namespace radvor::delaunay
