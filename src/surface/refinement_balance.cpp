// Balance near borders: squares of a facet's plane in which all sites, those to come as well, are of a level at least.
#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "surface/refinement.h"

namespace radvor {
namespace {

constexpr std::int64_t k_squares = 3;  // that are balanced on each side of a site's own

std::uint64_t hash_square(std::uint32_t facet, std::uint8_t level, std::int64_t x, std::int64_t y) {
  return hash(std::uint64_t{facet} << 8 | level, static_cast<std::uint64_t>(x), y);
}

std::int64_t square_of(double coordinate, double side) {
  return static_cast<std::int64_t>(std::floor(coordinate / side));
}

}  // namespace

std::uint32_t Refinement::find_mark(const Mark& square) const {
  return mark_table_.find(hash_square(square.facet, square.level, square.x, square.y),
                          [&](std::uint32_t k) { return marks_[k].is_at(square); });
}

void Refinement::mark(std::uint32_t facet, std::uint8_t level, const Vec2& point) {
  const double side = spacing(level);
  const Mark centre{facet, level, false, square_of(point.x, side), square_of(point.y, side)};
  if (const std::uint32_t known = find_mark(centre); known != IndexTable::k_absent && marks_[known].is_centre) {
    return;
  }
  const FacetGround& on = ground(facet);
  const auto bound = [&](double middle, std::int64_t squares, double low, double high) {
    return std::clamp(square_of(middle, side) + squares, square_of(low, side), square_of(high, side));
  };
  const std::int64_t first_x = bound(point.x, -k_squares, on.low().x, on.high().x);
  const std::int64_t last_x = bound(point.x, k_squares, on.low().x, on.high().x);
  const std::int64_t first_y = bound(point.y, -k_squares, on.low().y, on.high().y);
  const std::int64_t last_y = bound(point.y, k_squares, on.low().y, on.high().y);
  const std::size_t before = marks_.size();
  for (std::int64_t y = first_y; y <= last_y; ++y) {
    for (std::int64_t x = first_x; x <= last_x; ++x) {
      const Mark square{facet, level, false, x, y};
      const auto next = static_cast<std::uint32_t>(marks_.size());
      if (mark_table_.find_or_insert(hash_square(facet, level, x, y), next,
                                     [&](std::uint32_t k) { return marks_[k].is_at(square); }) == next) {
        marks_.push_back(square);
      }
    }
  }
  if (const std::uint32_t known = find_mark(centre); known != IndexTable::k_absent) {
    marks_[known].is_centre = true;
  }
  if (marks_.size() > before) {
    settle(facet, level, Vec2(first_x, first_y) * side, Vec2(last_x + 1, last_y + 1) * side);
  }
}

// The first so many; what lags in the others is not pending any more.
void Refinement::keep_marks(std::size_t count) {
  marks_.resize(count);
  mark_table_ = IndexTable(count, parts_.memory);
  for (std::uint32_t k = 0; k < count; ++k) {
    marks_[k].is_centre = false;  // part of what is about it may be gone
    const Mark& square = marks_[k];
    mark_table_.find_or_insert(hash_square(square.facet, square.level, square.x, square.y), k,
                               [](std::uint32_t) { return false; });
  }
}

// Raises what is in a box of marked squares and lags. Lagging sites are on the level before.
void Refinement::settle(std::uint32_t facet, std::uint8_t level, const Vec2& low, const Vec2& high) {
  const FacetGround& on = ground(facet);
  const auto before = static_cast<std::uint8_t>(level - 1);
  const std::uint32_t on_lattice = lattice_finest_ - finest_ + before;
  const Vec2 least = glm::max(low, on.low());
  const Vec2 most = glm::min(high, on.high());
  const std::int64_t last_row = on.lattice().last_row(on_lattice, most.y);
  for (std::int64_t j = on.lattice().first_row(on_lattice, least.y); j <= last_row; ++j) {
    const std::int64_t last = on.lattice().last_column(on_lattice, j, most.x);
    for (std::int64_t i = on.lattice().first_column(on_lattice, j, least.x); i <= last; ++i) {
      const std::uint32_t site = find_lattice_site(facet, {i * step(before), j * step(before)});
      if (site != k_none) {
        need(site, level);
      }
    }
  }
  const auto settle_border = [&](std::uint32_t site) {
    const Vec2 position = on.frame().to_plane(parts_.sites[site].position);
    if (position.x >= low.x && position.y >= low.y && position.x < high.x && position.y < high.y) {
      need(site, level);
    }
  };
  on.for_each_site_near(low, high, settle_border);
  const Vec3 middle = on.frame().to_world(0.5 * (low + high));
  const double reach = glm::distance(low, high);
  std::uint32_t last_edge = k_none;
  on.for_each_edge_near(low, high, [&](std::uint32_t edge) {
    if (edge == last_edge) {
      return;
    }
    last_edge = edge;
    settle_border(parts_.borders.at_vertex(parts_.welded.edges[edge].a));
    settle_border(parts_.borders.at_vertex(parts_.welded.edges[edge].b));
    const EdgeLine line = parts_.borders.line(edge);
    const double along = line.from_middle(middle);
    const std::int64_t outward = line.steps(spacing(before));
    const double at_most = static_cast<double>(outward);
    const auto first = static_cast<std::int64_t>(std::ceil(std::max((along - reach) / spacing(before), -at_most)));
    const auto end = static_cast<std::int64_t>(std::floor(std::min((along + reach) / spacing(before), at_most)));
    for (std::int64_t k = first; k <= end; ++k) {
      const std::uint32_t site = find_edge_site(edge, k * step(before));
      if (site != k_none) {
        settle_border(site);
      }
    }
  });
}

void Refinement::follow_marks(std::uint32_t site, std::uint32_t facet, const Vec2& position) {
  for (std::uint8_t level = finest_; !marks_.empty() && level > parts_.levels[site]; --level) {
    if (find_mark({facet, level, false, square_of(position.x, spacing(level)),
                   square_of(position.y, spacing(level))}) != IndexTable::k_absent) {
      need(site, level);
      return;
    }
  }
}

}  // namespace radvor
