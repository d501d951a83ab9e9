// Where to start looking: for each cell of a grid over the points one vertex that is in it, or was. What it says may be
// out of date; any vertex is a valid start. It is made anew when the set has doubled.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <memory_resource>
#include <vector>

#include "base/vector.h"
#include "delaunay/mesh.h"

namespace radvor::delaunay {

class HintGrid {
 public:
  explicit HintGrid(std::pmr::memory_resource* memory) : cells_(memory) {}

  /// k_none where no vertex is known.
  VertexId near(Vec2 point) const { return cells_.empty() ? k_none : cells_[cell_of(point)]; }

  void note(Vec2 point, VertexId vertex) noexcept {
    if (!cells_.empty()) {
      cells_[cell_of(point)] = vertex;
    }
  }

  bool is_too_coarse(std::uint32_t vertex_count) const { return vertex_count >= next_size_; }

  /// is_vertex(id) and position(id) for ids below bound. Without memory it stays as it is: it only saves time.
  template <class IsVertex>
  void rebuild(std::uint32_t vertex_count, const std::pmr::vector<Vec2>& positions, IsVertex&& is_vertex) noexcept;

  void clear() noexcept {
    cells_.clear();
    next_size_ = k_first_size;
  }

 private:
  static constexpr std::uint32_t k_first_size = 64;
  static constexpr std::uint32_t k_vertices_a_cell = 2;

  std::size_t cell_of(Vec2 point) const {
    const auto index = [&](double at) {
      return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(side_ - 1)));
    };
    return index((point.y - low_.y) * per_unit_.y) * side_ + index((point.x - low_.x) * per_unit_.x);
  }

  std::pmr::vector<VertexId> cells_;
  std::size_t side_ = 0;
  Vec2 low_{0.0}, per_unit_{0.0};
  std::uint32_t next_size_ = k_first_size;
};

template <class IsVertex>
void HintGrid::rebuild(std::uint32_t vertex_count, const std::pmr::vector<Vec2>& positions,
                       IsVertex&& is_vertex) noexcept {
  next_size_ = vertex_count * 2;
  std::size_t side = 1;
  while (side * side * k_vertices_a_cell < vertex_count) {
    side += side / 8 + 1;
  }
  try {
    cells_.reserve(side * side);
  } catch (...) {
    return;
  }
  cells_.assign(side * side, k_none);
  side_ = side;
  Vec2 low(0.0), high(0.0);
  bool any = false;
  const auto bound = static_cast<VertexId>(positions.size());
  for (VertexId v = 0; v < bound; ++v) {
    if (is_vertex(v)) {
      low = any ? glm::min(low, positions[v]) : positions[v];
      high = any ? glm::max(high, positions[v]) : positions[v];
      any = true;
    }
  }
  low_ = low;
  for (int axis = 0; axis < 2; ++axis) {
    per_unit_[axis] = high[axis] > low[axis] ? static_cast<double>(side) / (high[axis] - low[axis]) : 0;
  }
  for (VertexId v = 0; v < bound; ++v) {
    if (is_vertex(v)) {
      cells_[cell_of(positions[v])] = v;
    }
  }
  // Empty cells take over from the one before in their row, or else in the row before.
  for (std::size_t i = 1; i < cells_.size(); ++i) {
    if (cells_[i] == k_none) {
      cells_[i] = cells_[i % side != 0 || i < side ? i - 1 : i - side];
    }
  }
  for (std::size_t i = cells_.size(); i-- > 1;) {
    if (cells_[i - 1] == k_none) {
      cells_[i - 1] = cells_[i];
    }
  }
}

}  // namespace radvor::delaunay
