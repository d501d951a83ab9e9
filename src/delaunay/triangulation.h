// A planar Delaunay triangulation that grows, shrinks and takes constraint edges: exact, incremental, without any
// tolerance. Points are distinct; every edge is locally Delaunay unless it is a constraint; where four or more points
// lie exactly on an empty circle (a tie), the diagonals follow the vertices' values or, without them, a rule that
// depends on the set of points alone. Knows nothing of light.
//
// Handles: vertex ids count up from 0 and are stable; an id is reused only after its vertex was removed. Half-edges
// and triangle ids are valid until the next edit. Const members write nothing: many threads may call them at once.
// Errors are radvor::Error or std::bad_alloc, and whatever throws leaves the triangulation as it was.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/vector.h"
#include "delaunay/hint_grid.h"
#include "delaunay/mesh.h"
#include "delaunay/predicates.h"

namespace radvor::delaunay {

/// What a constraint edge is. The upper four bits are the caller's own; they follow the edge when it is split.
namespace constraint {
inline constexpr std::uint8_t k_border = 1;         ///< separates the domain from what is outside; blocks cells
inline constexpr std::uint8_t k_discontinuous = 2;  ///< inside of the domain; blocks cells
inline constexpr std::uint8_t k_continuous = 4;     ///< kept as an edge; blocks nothing
inline constexpr std::uint8_t k_blocking = k_border | k_discontinuous;
}  // namespace constraint

/// What happens where a new constraint edge would cross an old one.
enum class Crossing { refuse, split };

enum class Where : std::uint32_t { vertex = 0, edge = 1, triangle = 2, outside = 3 };

struct Location {
  Where where = Where::outside;
  /// where: vertex, edge or triangle: 1, 2 or 3 vertices, the triangle's counter-clockwise; the rest k_none.
  std::array<VertexId, 3> vertices = {k_none, k_none, k_none};
  /// In the triangle found; vertex: out of it; edge: along it; outside: in a ghost. k_none without triangles.
  HalfEdge edge = k_none;
};

class Triangulation {
 public:
  explicit Triangulation(std::pmr::memory_resource* memory);
  Triangulation(const Triangulation&) = delete;
  Triangulation& operator=(const Triangulation&) = delete;

  // ---- Points

  /// Inserts a point; one that is already there gives its vertex. Splits the constraint edge it lies on exactly.
  /// Throws invalid_geometry (not finite) or limit (neither 0 nor 2^-142 .. 2^200 in magnitude).
  VertexId insert(Vec2 point) { return insert(point, k_none); }
  /// hint: a vertex near it, to start from.
  VertexId insert(Vec2 point, VertexId hint);

  /// All or nothing, in a spatial order of its own; the triangulation is that of inserting one by one in any order.
  /// New vertices get ids in input order. vertices: count ids, or NULL.
  void insert_many(std::span<const Vec2> points, VertexId* vertices);

  /// Makes room for so many vertices in all, so that a few insert_many need not make it one after the other.
  void reserve(std::uint32_t vertices);
  /// Lets go of the memory that edits keep for the next ones, and of what the last one changed.
  void trim();

  /// Removes a vertex and its constraint edges; two collinear ones with the same flags become one again.
  void remove(VertexId vertex);

  /// The vertices whose stars (or constraint flags) the last insert, remove, constrain, unconstrain, split or realign
  /// that succeeded changed, each once, in no particular order, without the removed one; none after insert_many. Calls
  /// that fail, or are given no points or vertices, leave it as it was.
  std::span<const VertexId> changed() const { return changed_; }

  std::uint32_t vertex_count() const { return vertex_count_; }
  /// Ids are below it; some may be free after removals.
  std::uint32_t vertex_bound() const { return static_cast<std::uint32_t>(positions_.size()); }
  bool is_vertex(VertexId vertex) const;
  Vec2 position(VertexId vertex) const { return positions_[vertex]; }

  // ---- Constraints

  /// Makes the segment a-b part of the triangulation. Vertices exactly on it split it. Where it would cross another
  /// constraint edge: throws constraint, or with Crossing::split inserts the crossing, rounded, into both. Edges that
  /// are constraints already get the new flags added. flags: nonzero, see namespace constraint.
  void constrain(VertexId a, VertexId b, std::uint8_t flags, Crossing crossing = Crossing::refuse);

  /// Frees the constraint edge a-b, or the collinear ones that constrain made of it. Throws constraint if there is
  /// none.
  void unconstrain(VertexId a, VertexId b);

  /// A point replaces the constraint edge a-b by a-p and p-b with the same flags, even where rounding put it beside
  /// the line, across other edges too. Throws constraint where the triangle of edge and point holds a vertex, which
  /// would change sides, or meets another constraint.
  VertexId split(VertexId a, VertexId b, Vec2 point);

  /// Flags of the edge a-b; 0: not a constraint or not an edge.
  std::uint8_t constraint_flags(VertexId a, VertexId b) const;
  std::uint8_t constraint_flags(HalfEdge h) const { return mesh_.constraint(h); }
  std::uint32_t constraint_count() const;
  /// False if there never was one: then every edge is locally Delaunay.
  bool may_have_constraints() const { return constrained_; }
  bool may_have_continuous_constraints() const { return seamed_; }

  // ---- Domain

  /// Marks triangles inside or outside of the polygon that the border edges bound: outside at infinity, and the other
  /// way beyond every border edge (even-odd, so holes and islands need no order). Later edits keep the marks; call it
  /// again after border edges were added. Freeing an edge between inside and outside unmarks the domain. Throws
  /// constraint where border edges do not close.
  void mark_domain();
  /// Everything in the convex hull is inside, as before mark_domain.
  void unmark_domain();
  /// Real, and not marked as outside.
  bool is_inside(TriangleId t) const { return !mesh_.is_ghost(t) && !(mesh_.state(t) & Triangle::k_outside); }

  // ---- Walking around (all ids and half-edges must be live)

  /// Below it are the triangle ids; is_triangle tells which are real (neither free nor a ghost).
  std::uint32_t triangle_bound() const { return mesh_.record_count(); }
  bool is_triangle(TriangleId t) const { return !mesh_.is_free(t) && !mesh_.is_ghost(t); }
  std::uint32_t triangle_count() const;  ///< real ones, inside or not
  std::array<VertexId, 3> triangle(TriangleId t) const { return mesh_.triangle(t).vertex; }

  VertexId origin(HalfEdge h) const { return mesh_.origin(h); }
  VertexId target(HalfEdge h) const { return mesh_.target(h); }
  VertexId apex(HalfEdge h) const { return mesh_.apex(h); }  ///< may be k_infinite, see is_ghost
  HalfEdge twin(HalfEdge h) const { return mesh_.twin(h); }
  bool is_ghost(TriangleId t) const { return mesh_.is_ghost(t); }

  /// A half-edge out of the vertex (its target may be k_infinite), k_none where it is the only vertex. With
  /// rotate_ccw until it comes round: the star, neighbours and triangles (on the left of each) counter-clockwise.
  HalfEdge out(VertexId vertex) const { return mesh_.out(vertex); }
  HalfEdge rotate_ccw(HalfEdge out) const { return mesh_.rotate_ccw(out); }
  HalfEdge rotate_cw(HalfEdge out) const { return mesh_.rotate_cw(out); }
  /// The half-edge from a to b, k_none where there is none.
  HalfEdge find_edge(VertexId a, VertexId b) const;

  /// function(VertexId neighbour) for each, counter-clockwise.
  template <class Function>
  void for_each_neighbour(VertexId vertex, Function&& function) const {
    const HalfEdge first = out(vertex);
    HalfEdge h = first;
    if (h == k_none) {
      return;
    }
    do {
      if (target(h) != k_infinite) {
        function(target(h));
      }
      h = rotate_ccw(h);
    } while (h != first);
  }

  /// function(TriangleId) for each triangle of the star inside of the domain, counter-clockwise.
  template <class Function>
  void for_each_inside_triangle(VertexId vertex, Function&& function) const {
    const HalfEdge first = out(vertex);
    HalfEdge h = first;
    if (h == k_none) {
      return;
    }
    do {
      if (is_inside(triangle_of(h))) {
        function(triangle_of(h));
      }
      h = rotate_ccw(h);
    } while (h != first);
  }

  /// A vertex of the convex hull's half-edge: the hull edge with the hull on its left; k_none without one. The next
  /// one counter-clockwise is hull_next.
  HalfEdge hull_edge() const;
  HalfEdge hull_next(HalfEdge hull) const;

  // ---- Questions

  /// hint: a vertex to start from (k_none or a removed one: any), and one near the answer after; or NULL.
  Location locate(Vec2 point, VertexId* hint = nullptr) const;
  /// As locate, in plain double precision: a triangle that the point is in but for rounding, and the weights of its
  /// corners (>= 0, sum 1). Several times as fast. k_none where it cannot tell: outside of the hull, and elsewhere too.
  /// start: a real triangle near it, or k_none.
  TriangleId locate_roughly(Vec2 point, std::array<double, 3>& weights, TriangleId start = k_none) const;

  /// Corner weights of a point in the triangle: affine, sum 1.
  std::array<double, 3> barycentric(TriangleId t, Vec2 point) const;

  /// Values interpolated linearly over the triangle; NaN outside of the hull or where one is unset.
  double interpolate_linear(Vec2 point, VertexId* hint = nullptr) const;

  /// Sibson's natural-neighbour interpolation; NaN likewise.
  double interpolate_natural(Vec2 point, VertexId* hint = nullptr) const;

  // ---- Values and ties

  /// One value a vertex, finite, or NaN: unset, the initial one. ids first ... first + count - 1; removed ones are
  /// skipped.
  void set_values(std::span<const double> values, VertexId first);
  double value(VertexId vertex) const;

  /// Resolves all ties anew: the diagonals of every cocircular polygon have the least sum of |difference| of values.
  /// Returns the number of polygons whose diagonals changed.
  std::uint32_t realign();
  /// The same for the polygons at the given vertices.
  std::uint32_t realign(std::span<const VertexId> vertices);
  /// Cocircular polygons of four or more vertices, not cut by constraints.
  std::uint32_t tie_count() const;

  // ---- Trust

  /// Topology, orientation, the exact Delaunay property, constraints, domain marks and ties; throws internal with
  /// what is wrong. Linear time.
  void validate() const;

  const Mesh& mesh() const { return mesh_; }
  std::span<const Vec2> positions() const { return positions_; }
  const Lattice& lattice() const { return lattice_; }  ///< that all positions are on
  std::pmr::memory_resource* memory() const { return memory_; }
  bool is_ordinary(HalfEdge h) const { return is_flippable(h); }  ///< no constraint, real triangles on both sides
  bool lies_on_circle(HalfEdge h) const;  ///< both real, no constraint, and the four corners on one circle

 private:
  friend class TiePolygon;
  friend class Audit;

  // Three lists in one array: the triangles that go, the edges around them, and those that wait to be looked at.
  struct Cavity {
    struct Slot {
      TriangleId triangle;
      HalfEdge outer;  // the triangle beyond keeps it
      HalfEdge stacked;
      std::uint8_t state;  // of the triangle that goes at `outer`
    };
    explicit Cavity(std::pmr::memory_resource* memory) : slots(memory) {}
    void grow() { slots.resize(2 * slots.size() + 30); }

    std::pmr::vector<Slot> slots;
    std::uint32_t triangle_count = 0, border_size = 0;
  };

  // insert.cpp
  static void check(Vec2 point);
  void reserve_one();
  VertexId add_vertex(Vec2 point);
  VertexId insert_new(Vec2 point, const Location& location);
  void prepare(Vec2 point, const Location& location);
  void place(VertexId p, const Location& location);
  void collect_cavity(Vec2 point, TriangleId start, HalfEdge crossed, const Lattice& lattice, Cavity& cavity) const;
  void fill_cavity(VertexId p);
  // interpolate.cpp
  double linear_in(TriangleId t, Vec2 point) const;

  // conflict.h
  bool conflicts(HalfEdge entry, Vec2 point, const Lattice& lattice) const;

  // chain.cpp
  void start_chain(VertexId a, VertexId p);
  void extend_chain(VertexId p, HalfEdge end);
  void split_chain(VertexId p, HalfEdge uv);
  void remove_from_chain(VertexId vertex);

  // bulk.cpp
  void insert_all(std::span<const Vec2> points, VertexId* vertices);
  struct Duplicate {
    VertexId vertex, original;
  };
  void number_without_duplicates(std::span<const Vec2> points, VertexId first, std::span<const Duplicate> duplicates,
                                 std::span<std::uint32_t> order, VertexId* vertices);
  void renumber(VertexId first, std::span<const std::uint32_t> renumbered, VertexId end);

  // locate.cpp
  HalfEdge start_near(Vec2 point, VertexId hint) const;
  void note_for_hints(VertexId vertex);
  Location locate_from(Vec2 point, HalfEdge start, const Lattice& lattice) const;
  Location straight_walk(Vec2 point, VertexId start, const Lattice& lattice) const;
  Location walk_chain(Vec2 point, HalfEdge start, const Lattice& lattice) const;
  Location describe(Where where, HalfEdge h) const;

  // flips.cpp
  bool is_flippable(HalfEdge h) const;
  bool prefers_flip(HalfEdge h) const;
  void legalize();

  // close_hole.cpp
  bool close_hole(VertexId vertex);

  // remove.cpp
  VertexId only_vertex() const;
  void free_again(VertexId vertex);
  void remove_from_plane(VertexId vertex);
  void shrink_star(VertexId vertex);
  void close_inner(VertexId vertex);
  void close_hull(VertexId vertex);

  // constrain.cpp
  using Pair = std::array<VertexId, 2>;
  struct Segment;
  void require_vertex(VertexId vertex) const;
  void constrain_along(VertexId a, VertexId b, std::uint8_t flags, Crossing crossing);
  VertexId next_stop(Segment& segment) const;
  void force_edge(Segment& segment);
  void free_edge(HalfEdge h);

  // split.cpp
  bool find_beside(HalfEdge edge, Vec2 point, Location& location) const;
  VertexId split_edge(HalfEdge h, Vec2 point);
  VertexId split_crossing(VertexId a, VertexId b, Pair edge);

  void report_star(VertexId vertex);
  void report(VertexId vertex) { changed_.push_back(vertex); }
  void make_report_unique();
  template <class Edit>
  void transact(Edit&& edit);
  // ties.cpp
  void refresh_ties();
  bool is_aligned() const;

  std::pmr::memory_resource* memory_;
  Mesh mesh_;
  std::pmr::vector<Vec2> positions_;  // x is NaN where the id is free; y then holds nothing
  std::pmr::vector<double> values_;   // empty until a value is set
  std::uint32_t vertex_count_ = 0;
  VertexId free_vertex_ = k_none;
  bool flat_ = true;          // all vertices are collinear: no real triangle
  bool unaligned_ = false;    // values changed since the last realign
  bool steered_ = false;      // some value was set: ties may be other than canonical
  bool constrained_ = false;  // there was a constraint once
  bool seamed_ = false;       // one that blocks no view
  bool marked_ = false;       // by mark_domain
  VertexId last_ = k_none;    // where the last edit was
  Lattice lattice_;
  HintGrid hints_;

  std::pmr::vector<VertexId> reused_;  // free ids that the open transaction took

  // Scratch that insertions keep.
  std::pmr::vector<VertexId> changed_;
  std::pmr::vector<VertexId> changed_before_;  // by the edit before the open transaction
  std::pmr::vector<std::uint32_t> reports_;    // of each vertex: the last long report it was in
  std::uint32_t report_number_ = 0;
  std::pmr::vector<HalfEdge> stack_;
  Cavity cavity_;
};

}  // namespace radvor::delaunay
