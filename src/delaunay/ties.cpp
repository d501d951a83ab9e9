// Values at the vertices, and the ties that follow them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "delaunay/tie_polygon.h"
#include "delaunay/transaction.h"
#include "delaunay/triangulation.h"

namespace radvor::delaunay {

void Triangulation::set_values(std::span<const double> values, VertexId first) {
  if (first > vertex_bound() || values.size() > vertex_bound() - first) {
    throw Error(ErrorCode::invalid_argument, "values for vertices %u ... %llu of %u", first,
                static_cast<unsigned long long>(first) + values.size() - 1, vertex_bound());
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isinf(values[i])) {
      throw Error(ErrorCode::invalid_argument, "the value of vertex %u is infinite", static_cast<VertexId>(first + i));
    }
  }
  if (values_.empty()) {
    values_.reserve(positions_.capacity());
    values_.resize(positions_.size(), std::numeric_limits<double>::quiet_NaN());
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_vertex(static_cast<VertexId>(first + i))) {
      values_[first + i] = values[i];
      steered_ = steered_ || !std::isnan(values[i]);
    }
  }
  unaligned_ = true;
}

double Triangulation::value(VertexId vertex) const {
  return vertex < values_.size() ? values_[vertex] : std::numeric_limits<double>::quiet_NaN();
}

bool Triangulation::lies_on_circle(HalfEdge h) const {
  return is_flippable(h) && in_circle(positions_[origin(h)], positions_[target(h)], positions_[apex(h)],
                                      positions_[apex(twin(h))], lattice_) == 0;
}

// The polygons that an edit touched: at the vertices whose stars changed.
void Triangulation::refresh_ties() {
  TiePolygon polygon(memory_);
  std::pmr::vector<VertexId> touched(changed_, memory_);
  std::sort(touched.begin(), touched.end());
  const auto has_changed = [&](VertexId v) { return std::binary_search(touched.begin(), touched.end(), v); };
  for (const VertexId v : touched) {
    const HalfEdge first = mesh_.out(v);
    if (first == k_none) {
      continue;
    }
    // Resolving changes the star; start over with what it is then.
    bool again = true;
    while (again) {
      again = false;
      HalfEdge h = mesh_.out(v);
      const HalfEdge start = h;
      do {
        const TriangleId t = triangle_of(h);
        if (!is_ghost(t) && (has_changed(target(h)) || has_changed(apex(h))) && polygon.collect(*this, t) > 3 &&
            polygon.resolve(*this)) {
          polygon.apply(mesh_);
          changed_.insert(changed_.end(), polygon.corners().begin(), polygon.corners().end());
          again = true;
          break;
        }
        h = rotate_ccw(h);
      } while (h != start);
    }
  }
  make_report_unique();
}

std::uint32_t Triangulation::realign(std::span<const VertexId> vertices) {
  for (const VertexId v : vertices) {
    require_vertex(v);
  }
  std::uint32_t count = 0;
  if (vertices.empty()) {
    return count;
  }
  if (!steered_) {
    changed_.clear();
    return count;
  }
  TiePolygon polygon(memory_);
  std::pmr::vector<TriangleId> star(memory_);
  transact([&] {
    for (const VertexId v : vertices) {
      bool again = mesh_.out(v) != k_none;
      while (again) {
        again = false;
        star.clear();
        HalfEdge h = mesh_.out(v);
        do {
          if (!is_ghost(triangle_of(h))) {
            star.push_back(triangle_of(h));
          }
          h = rotate_ccw(h);
        } while (h != mesh_.out(v));
        for (const TriangleId t : star) {
          if (polygon.collect(*this, t) > 3 && polygon.resolve(*this)) {
            polygon.apply(mesh_);
            changed_.insert(changed_.end(), polygon.corners().begin(), polygon.corners().end());
            ++count;
            again = true;
            break;
          }
        }
      }
    }
  });
  return count;
}

std::uint32_t Triangulation::realign() {
  std::uint32_t count = 0;
  if (steered_) {
    TiePolygon polygon(memory_);
    std::pmr::vector<bool> seen(mesh_.record_count(), false, memory_);
    transact([&] {
      for (TriangleId t = 0; t < mesh_.record_count(); ++t) {
        if (seen[t] || !is_triangle(t) || polygon.collect(*this, t) == 3) {
          continue;
        }
        for (const TriangleId part : polygon.triangles()) {
          seen[part] = true;
        }
        if (polygon.resolve(*this)) {
          polygon.apply(mesh_);
          changed_.insert(changed_.end(), polygon.corners().begin(), polygon.corners().end());
          ++count;
        }
      }
    });
  } else {
    changed_.clear();
  }
  unaligned_ = false;
  return count;
}

bool Triangulation::is_aligned() const {
  TiePolygon polygon(memory_);
  std::pmr::vector<bool> seen(mesh_.record_count(), false, memory_);
  for (TriangleId t = 0; t < mesh_.record_count(); ++t) {
    if (!seen[t] && is_triangle(t) && polygon.collect(*this, t) > 3) {
      for (const TriangleId part : polygon.triangles()) {
        seen[part] = true;
      }
      if (polygon.resolve(*this)) {
        return false;
      }
    }
  }
  return true;
}

std::uint32_t Triangulation::tie_count() const {
  TiePolygon polygon(memory_);
  std::pmr::vector<bool> seen(mesh_.record_count(), false, memory_);
  std::uint32_t count = 0;
  for (TriangleId t = 0; t < mesh_.record_count(); ++t) {
    if (!seen[t] && is_triangle(t) && polygon.collect(*this, t) > 3) {
      for (const TriangleId part : polygon.triangles()) {
        seen[part] = true;
      }
      ++count;
    }
  }
  return count;
}

}  // namespace radvor::delaunay
