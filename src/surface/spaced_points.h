// Points of a plane that keep a distance from each other, in time that grows with their number alone.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/hash.h"
#include "base/vector.h"
#include "scene/index_table.h"

namespace radvor {

class SpacedPoints {
 public:
  SpacedPoints(double distance, std::pmr::memory_resource* memory)
      : distance_(distance), points_(memory), table_(0, memory) {}

  /// False where one is nearer than the distance; else the point is one of them from now on.
  bool add(const Vec2& point) {
    const Square at = square_of(point);
    for (std::int64_t y = at.y - 2; y <= at.y + 2; ++y) {
      for (std::int64_t x = at.x - 2; x <= at.x + 2; ++x) {
        const std::uint32_t other = find({x, y});
        if (other != IndexTable::k_absent && glm::distance(points_[other], point) < distance_) {
          return false;
        }
      }
    }
    table_.find_or_insert(hash_of(at), static_cast<std::uint32_t>(points_.size()), [](std::uint32_t) { return false; });
    points_.push_back(point);
    return true;
  }

 private:
  /// So small that no two of the points are in one.
  struct Square {
    std::int64_t x, y;
    bool operator==(const Square&) const = default;
  };

  Square square_of(const Vec2& point) const {
    const double side = 0.5 * distance_;
    return {static_cast<std::int64_t>(std::floor(point.x / side)),
            static_cast<std::int64_t>(std::floor(point.y / side))};
  }
  static std::uint64_t hash_of(const Square& square) {
    return hash(static_cast<std::uint64_t>(square.x), static_cast<std::uint64_t>(square.y));
  }
  std::uint32_t find(const Square& square) const {
    return table_.find(hash_of(square), [&](std::uint32_t k) { return square_of(points_[k]) == square; });
  }

  double distance_;
  std::pmr::vector<Vec2> points_;
  IndexTable table_;
};

}  // namespace radvor
