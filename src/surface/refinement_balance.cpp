// Balance near borders: in the squares about a site all others, those to come as well, are of a level at least.
#include <algorithm>
#include <cmath>

#include "surface/refinement.h"

namespace radvor {
namespace {

constexpr std::int64_t k_squares = 3;  // that are balanced on each side of a site's own

std::int64_t square_of(double coordinate, double side) {
  return static_cast<std::int64_t>(std::floor(coordinate / side));
}

}  // namespace

void Refinement::mark(std::uint32_t facet, std::uint8_t level, const Vec2& point) {
  const double side = spacing(level);
  const MarkedSquares::Square centre{facet, level, square_of(point.x, side), square_of(point.y, side)};
  if (marks_.is_centre(centre)) {
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
  const bool some = marks_.mark({facet, level, first_x, first_y}, {facet, level, last_x, last_y});
  marks_.set_centre(centre);
  if (some) {
    settle(facet, level, Vec2(first_x, first_y) * side, Vec2(last_x + 1, last_y + 1) * side);
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
    const double side = spacing(level);
    if (marks_.contains({facet, level, square_of(position.x, side), square_of(position.y, side)})) {
      need(site, level);
      return;
    }
  }
}

}  // namespace radvor
