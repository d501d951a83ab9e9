// radvor_delaunay_*: the questions. They write nothing, and what they need for a moment is on the stack where it fits.
#include <algorithm>
#include <cmath>

#include "api/checks.h"
#include "api/delaunay.h"
#include "delaunay/cells.h"

using namespace radvor;
using namespace radvor::api;
using namespace radvor::delaunay;

namespace {

// The caller's array and its capacity; counts what it has no room for too.
template <class Element>
class Output {
 public:
  Output(Element* array, std::uint32_t* count) : array_(array), count_(count) { require(count, "the count"); }

  void add(Element element) {
    if (array_ && size_ < *count_) {
      array_[size_] = element;
    }
    ++size_;
  }
  void finish() {
    const std::uint32_t capacity = *count_;
    *count_ = size_;
    if (array_ && size_ > capacity) {
      throw Error(ErrorCode::invalid_argument, "there are %u elements, and room for %u", size_, capacity);
    }
  }

 private:
  Element* array_;
  std::uint32_t* count_;
  std::uint32_t size_ = 0;
};

void check_vertex(const Triangulation& d, std::uint32_t vertex) {
  if (!d.is_vertex(vertex)) {
    throw Error(ErrorCode::invalid_argument, "there is no vertex %u", vertex);
  }
}

void check_capacity(const char* what, std::uint32_t capacity, std::uint32_t count) {
  if (capacity < count) {
    throw Error(ErrorCode::invalid_argument, "%s has room for %u of %u", what, capacity, count);
  }
}

template <class Function>
void for_each_triangle(const Triangulation& d, Function&& function) {
  for (TriangleId t = 0; t < d.triangle_bound(); ++t) {
    if (d.is_triangle(t)) {
      function(t);
    }
  }
}

template <class Function>
void for_each_hull_vertex(const Triangulation& d, Function&& function) {
  const HalfEdge first = d.hull_edge();
  if (first == k_none) {
    return;
  }
  HalfEdge h = first;
  do {
    function(d.origin(h));
    h = d.hull_next(h);
  } while (h != first);
}

// Each once, from its lower end; wanted(half-edge).
template <class Wanted>
void give_edges(const Triangulation& d, std::uint32_t* pairs, std::uint32_t* count, Wanted&& wanted) {
  require(count, "the count");
  const std::uint32_t capacity = *count;
  std::uint32_t size = 0;
  const auto for_each = [&](auto&& function) {
    for (TriangleId t = 0; t < d.triangle_bound(); ++t) {
      for (std::uint32_t corner = 0; corner < 3 && !d.mesh().is_free(t); ++corner) {
        const HalfEdge h = half_edge(t, corner);
        if (d.origin(h) < d.target(h) && d.target(h) != k_infinite && wanted(h)) {
          function(h);
        }
      }
    }
  };
  for_each([&](HalfEdge) { ++size; });
  *count = size;
  if (pairs) {
    check_capacity("pairs", capacity, size);
    for_each([&](HalfEdge h) {
      *pairs++ = d.origin(h);
      *pairs++ = d.target(h);
    });
  }
}

void give_polygon(std::span<const Vec2> points, double* polygon, std::uint32_t* size) {
  if (size) {
    const auto count = static_cast<std::uint32_t>(points.size());
    const std::uint32_t capacity = *size;
    *size = count;
    if (polygon) {
      check_capacity("polygon", capacity, count);
    }
  } else if (polygon) {
    require(size, "polygon_size");
  }
  if (polygon) {
    for (const Vec2 point : points) {
      *polygon++ = point.x;
      *polygon++ = point.y;
    }
  }
}

void give_measures(const Sector& sector, double* area, double* centroid) {
  if (area) {
    *area = sector.area;
  }
  if (centroid) {
    centroid[0] = sector.centroid.x;
    centroid[1] = sector.centroid.y;
  }
}

// A cell query's memory: on the stack unless the cell is huge.
struct Scratch {
  explicit Scratch(std::pmr::memory_resource* upstream) : memory(room, sizeof room, upstream) {}
  alignas(16) std::byte room[8192];
  std::pmr::monotonic_buffer_resource memory;
};

}  // namespace

radvor_result radvor_delaunay_constraint(const radvor_delaunay* delaunay, uint32_t a, uint32_t b, uint32_t* flags) {
  return enter(context_of(delaunay), __func__, [&] {
    require(flags, "flags");
    check_vertex(delaunay->triangulation, a);
    check_vertex(delaunay->triangulation, b);
    *flags = delaunay->triangulation.constraint_flags(a, b);
  });
}

radvor_result radvor_delaunay_position(const radvor_delaunay* delaunay, uint32_t vertex, double xy[2]) {
  return enter(context_of(delaunay), __func__, [&] {
    require(xy, "xy");
    check_vertex(delaunay->triangulation, vertex);
    const Vec2 at = delaunay->triangulation.position(vertex);
    xy[0] = at.x;
    xy[1] = at.y;
  });
}

radvor_result radvor_delaunay_value(const radvor_delaunay* delaunay, uint32_t vertex, double* value) {
  return enter(context_of(delaunay), __func__, [&] {
    require(value, "value");
    check_vertex(delaunay->triangulation, vertex);
    *value = delaunay->triangulation.value(vertex);
  });
}

radvor_result radvor_delaunay_locate(const radvor_delaunay* delaunay, double x, double y, uint32_t* hint,
                                     uint32_t* where, uint32_t vertices[3]) {
  return enter(context_of(delaunay), __func__, [&] {
    require(where, "where");
    static_assert(static_cast<int>(Where::vertex) == RADVOR_ON_VERTEX &&
                  static_cast<int>(Where::edge) == RADVOR_ON_EDGE &&
                  static_cast<int>(Where::triangle) == RADVOR_IN_TRIANGLE &&
                  static_cast<int>(Where::outside) == RADVOR_OUTSIDE && k_none == RADVOR_NONE);
    const Location location = delaunay->triangulation.locate({x, y}, hint);
    *where = static_cast<std::uint32_t>(location.where);
    if (vertices) {
      std::copy(location.vertices.begin(), location.vertices.end(), vertices);
    }
  });
}

radvor_result radvor_delaunay_interpolate(const radvor_delaunay* delaunay, uint32_t method, double x, double y,
                                          uint32_t* hint, double* value) {
  return enter(context_of(delaunay), __func__, [&] {
    require(value, "value");
    if (method > RADVOR_NATURAL_NEIGHBOUR) {
      throw Error(ErrorCode::invalid_argument, "method is %u", method);
    }
    *value = method == RADVOR_BARYCENTRIC ? delaunay->triangulation.interpolate_linear({x, y}, hint)
                                          : delaunay->triangulation.interpolate_natural({x, y}, hint);
  });
}

uint32_t radvor_delaunay_vertex_count(const radvor_delaunay* delaunay) {
  return delaunay ? delaunay->triangulation.vertex_count() : 0;
}

uint32_t radvor_delaunay_vertex_bound(const radvor_delaunay* delaunay) {
  return delaunay ? delaunay->triangulation.vertex_bound() : 0;
}

uint32_t radvor_delaunay_triangle_count(const radvor_delaunay* delaunay) {
  const FloatingPointGuard guard(Denormals::keep);
  return delaunay ? delaunay->triangulation.triangle_count() : 0;
}

uint32_t radvor_delaunay_constraint_count(const radvor_delaunay* delaunay) {
  return delaunay ? delaunay->triangulation.constraint_count() : 0;
}

radvor_result radvor_delaunay_tie_count(const radvor_delaunay* delaunay, uint32_t* count) {
  return enter(context_of(delaunay), __func__, [&] {
    require(count, "count");
    *count = delaunay->triangulation.tie_count();
  });
}

radvor_result radvor_delaunay_triangles(const radvor_delaunay* delaunay, uint32_t* indices, uint32_t capacity) {
  return enter(context_of(delaunay), __func__, [&] {
    const Triangulation& d = delaunay->triangulation;
    const std::uint32_t count = d.triangle_count();
    check_capacity("indices", capacity, count);
    if (count > 0) {
      require(indices, "indices");
    }
    for_each_triangle(d, [&](TriangleId t) {
      const auto v = d.triangle(t);
      indices = std::copy(v.begin(), v.end(), indices);
    });
  });
}

radvor_result radvor_delaunay_inside(const radvor_delaunay* delaunay, uint8_t* inside, uint32_t capacity) {
  return enter(context_of(delaunay), __func__, [&] {
    const Triangulation& d = delaunay->triangulation;
    const std::uint32_t count = d.triangle_count();
    check_capacity("inside", capacity, count);
    if (count > 0) {
      require(inside, "inside");
    }
    for_each_triangle(d, [&](TriangleId t) { *inside++ = d.is_inside(t); });
  });
}

radvor_result radvor_delaunay_copy(const radvor_delaunay* delaunay, double* xy, uint32_t* ids, uint32_t vertex_capacity,
                                   uint32_t* indices, uint32_t triangle_capacity) {
  return enter(context_of(delaunay), __func__, [&] {
    const Triangulation& d = delaunay->triangulation;
    if (xy || ids) {
      check_capacity("xy", vertex_capacity, d.vertex_count());
    }
    if (indices) {
      check_capacity("indices", triangle_capacity, d.triangle_count());
    }
    std::pmr::vector<std::uint32_t> rank(indices ? d.vertex_bound() : 0, d.memory());
    std::uint32_t count = 0;
    for (VertexId v = 0; v < d.vertex_bound(); ++v) {
      if (!d.is_vertex(v)) {
        continue;
      }
      if (xy) {
        xy[2 * std::size_t{count}] = d.position(v).x;
        xy[2 * std::size_t{count} + 1] = d.position(v).y;
      }
      if (ids) {
        ids[count] = v;
      }
      if (indices) {
        rank[v] = count;
      }
      ++count;
    }
    if (indices) {
      for_each_triangle(d, [&](TriangleId t) {
        for (const VertexId v : d.triangle(t)) {
          *indices++ = rank[v];
        }
      });
    }
  });
}

radvor_result radvor_delaunay_neighbours(const radvor_delaunay* delaunay, uint32_t vertex, uint32_t* vertices,
                                         uint32_t* count) {
  return enter(context_of(delaunay), __func__, [&] {
    check_vertex(delaunay->triangulation, vertex);
    Output<std::uint32_t> output(vertices, count);
    delaunay->triangulation.for_each_neighbour(vertex, [&](VertexId v) { output.add(v); });
    output.finish();
  });
}

radvor_result radvor_delaunay_hull(const radvor_delaunay* delaunay, uint32_t* vertices, uint32_t* count) {
  return enter(context_of(delaunay), __func__, [&] {
    Output<std::uint32_t> output(vertices, count);
    for_each_hull_vertex(delaunay->triangulation, [&](VertexId v) { output.add(v); });
    output.finish();
  });
}

radvor_result radvor_delaunay_edges(const radvor_delaunay* delaunay, uint32_t* pairs, uint32_t* count) {
  return enter(context_of(delaunay), __func__,
               [&] { give_edges(delaunay->triangulation, pairs, count, [](HalfEdge) { return true; }); });
}

radvor_result radvor_delaunay_constraints(const radvor_delaunay* delaunay, uint32_t* pairs, uint32_t* count) {
  return enter(context_of(delaunay), __func__, [&] {
    const Triangulation& d = delaunay->triangulation;
    give_edges(d, pairs, count, [&](HalfEdge h) { return d.constraint_flags(h) != 0; });
  });
}

radvor_result radvor_delaunay_changes(const radvor_delaunay* delaunay, uint32_t* vertices, uint32_t* count) {
  return enter(context_of(delaunay), __func__, [&] {
    Output<std::uint32_t> output(vertices, count);
    for (const VertexId v : delaunay->triangulation.changed()) {
      output.add(v);
    }
    output.finish();
  });
}

radvor_result radvor_delaunay_cell(const radvor_delaunay* delaunay, uint32_t vertex, const double* window,
                                   uint32_t window_size, double* polygon, uint32_t* polygon_size, double* area,
                                   double* centroid) {
  return enter(context_of(delaunay), __func__, [&] {
    const Triangulation& d = delaunay->triangulation;
    check_vertex(d, vertex);
    Scratch scratch(d.memory());
    std::pmr::vector<Vec2> corners(&scratch.memory);
    if (window) {
      if (window_size < 3) {
        throw Error(ErrorCode::invalid_argument, "a window of %u points", window_size);
      }
      for (std::uint32_t i = 0; i < window_size; ++i) {
        const Vec2 corner(window[2 * std::size_t{i}], window[2 * std::size_t{i} + 1]);
        if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) {
          throw Error(ErrorCode::invalid_geometry, "window point %u is not finite", i);
        }
        corners.push_back(corner);
      }
      for (std::uint32_t i = 0; i < window_size; ++i) {
        const Vec2 a = corners[i], b = corners[(i + 1) % window_size], c = corners[(i + 2) % window_size];
        if (exact::orientation(a, b, c) < 0) {
          throw Error(ErrorCode::invalid_argument, "the window turns right at point %u", (i + 1) % window_size);
        }
      }
    } else if (d.triangle_count() > 0) {
      for_each_hull_vertex(d, [&](VertexId v) { corners.push_back(d.position(v)); });
    }
    CellBuffer buffer(&scratch.memory);
    if (!corners.empty()) {
      window_cell(d, vertex, corners, buffer);
    }
    Sector none{};
    const Sector& sector = buffer.sectors().empty() ? none : buffer.sectors().front();
    give_polygon(buffer.polygon(sector), polygon, polygon_size);
    give_measures(sector, area, centroid);
  });
}

radvor_result radvor_delaunay_bounded_cell(const radvor_delaunay* delaunay, uint32_t vertex, uint32_t sector,
                                           uint32_t* sector_count, double* polygon, uint32_t* polygon_size,
                                           double* area, double* centroid) {
  return enter(context_of(delaunay), __func__, [&] {
    const Triangulation& d = delaunay->triangulation;
    check_vertex(d, vertex);
    Scratch scratch(d.memory());
    CellBuffer buffer(&scratch.memory);
    bounded_cell(d, vertex, buffer);
    const auto count = static_cast<std::uint32_t>(buffer.sectors().size());
    if (sector_count) {
      *sector_count = count;
    }
    if (!polygon && !polygon_size && !area && !centroid) {
      return;
    }
    if (sector >= count) {
      throw Error(ErrorCode::invalid_argument, "vertex %u has %u sectors, none is %u", vertex, count, sector);
    }
    give_polygon(buffer.polygon(buffer.sectors()[sector]), polygon, polygon_size);
    give_measures(buffer.sectors()[sector], area, centroid);
  });
}

radvor_result radvor_delaunay_validate(const radvor_delaunay* delaunay) {
  return enter(context_of(delaunay), __func__, [&] { delaunay->triangulation.validate(); });
}
