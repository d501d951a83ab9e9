#include "surface/refinement.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/hash.h"

namespace radvor {

namespace {

constexpr double k_reach = 2.25;       // of a border into the lattice, in spacings of the level
constexpr std::int64_t k_squares = 3;  // that are balanced on each side of a site's own
constexpr double k_near_border = 3;    // in spacings: lattice sites this near balance as border sites do
constexpr double k_far = 3;            // in first spacings: no clearance beyond is told
constexpr std::uint64_t k_edge = 1;    // kinds of places, for hashing
constexpr std::uint64_t k_lattice = 2;

std::uint64_t hash_place(std::uint64_t kind, std::uint64_t where, const LatticeIndex& index) {
  return hash(kind << 32 | where,
              static_cast<std::uint64_t>(index.i) ^ std::rotl(static_cast<std::uint64_t>(index.j), 32));
}

std::uint64_t hash_square(std::uint32_t facet, std::uint8_t level, std::int64_t x, std::int64_t y) {
  return hash(std::uint64_t{facet} << 8 | level, static_cast<std::uint64_t>(x), y);
}

std::int64_t square_of(double coordinate, double side) {
  return static_cast<std::int64_t>(std::floor(coordinate / side));
}

}  // namespace

Refinement::Refinement(SurfaceParts& parts)
    : parts_(parts),
      finest_(static_cast<std::uint8_t>(refinements(parts.options))),
      lattice_finest_(parts.options.element_levels + finest_),
      table_(parts.sites.size(), parts.memory),
      clearance_(parts.memory),
      marks_(parts.memory),
      mark_table_(0, parts.memory),
      first_edge_(parts.memory),
      edges_(parts.memory),
      ground_of_(parts.records.size(), k_none, parts.memory),
      grounds_(parts.memory),
      irregular_(parts.memory),
      pending_(parts.memory),
      raised_(parts.memory),
      first_new_(static_cast<std::uint32_t>(parts.sites.size())) {
  list_edges();
  fill_table();
}

// ---- What is where

std::span<const LatticeIndex> Refinement::directions() const {
  static constexpr std::array<LatticeIndex, 6> k_hexagonal = {{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
  static constexpr std::array<LatticeIndex, 8> k_quadrilateral = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  return parts_.options.lattice == Lattice::hexagonal ? std::span<const LatticeIndex>(k_hexagonal)
                                                      : std::span<const LatticeIndex>(k_quadrilateral);
}

double Refinement::spacing(std::uint8_t level) const {
  return parts_.borders.spacing() * halved(level);
}

std::uint8_t Refinement::coarsest(std::int64_t i, std::int64_t j) const {
  const int even = std::countr_zero(static_cast<std::uint64_t>(i | j));
  return even >= finest_ ? std::uint8_t{0} : static_cast<std::uint8_t>(finest_ - even);
}

void Refinement::list_edges() {
  const WeldedScene& welded = parts_.welded;
  first_edge_.assign(welded.positions.size() + 1, 0);
  for (std::uint32_t edge = 0; edge < welded.edges.size(); ++edge) {
    if (parts_.borders.carries(edge)) {
      ++first_edge_[welded.edges[edge].a];
      ++first_edge_[welded.edges[edge].b];
    }
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& first : first_edge_) {
    sum += first;
    first = sum;
  }
  edges_.resize(sum);
  for (auto edge = static_cast<std::uint32_t>(welded.edges.size()); edge-- > 0;) {
    if (parts_.borders.carries(edge)) {
      edges_[--first_edge_[welded.edges[edge].a]] = edge;
      edges_[--first_edge_[welded.edges[edge].b]] = edge;
    }
  }
}

std::uint64_t Refinement::hash_of(std::uint32_t site) const {
  const SitePlace& place = parts_.places[site];
  return place.on_lattice ? hash_place(k_lattice, place.facet, place.index)
                          : hash_place(k_edge, parts_.sites[site].edge, place.index);
}

void Refinement::fill_table() {
  table_ = IndexTable(parts_.sites.size(), parts_.memory);
  for (std::uint32_t site = 0; site < parts_.sites.size(); ++site) {
    if (parts_.places[site].on_lattice || parts_.sites[site].edge != k_none) {
      table_.find_or_insert(hash_of(site), site, [](std::uint32_t) { return false; });
    }
  }
  clearance_.resize(parts_.sites.size(), -1.0);
}

std::uint32_t Refinement::find_lattice_site(std::uint32_t facet, const LatticeIndex& index) const {
  return table_.find(hash_place(k_lattice, facet, index), [&](std::uint32_t site) {
    const SitePlace& place = parts_.places[site];
    return place.on_lattice && place.facet == facet && place.index.i == index.i && place.index.j == index.j;
  });
}

std::uint32_t Refinement::find_edge_site(std::uint32_t edge, std::int64_t step) const {
  return table_.find(hash_place(k_edge, edge, {step, 0}), [&](std::uint32_t site) {
    return parts_.sites[site].edge == edge && parts_.places[site].index.i == step;
  });
}

template <class Function>
void Refinement::for_each_edge(std::uint32_t site, Function&& function) const {
  const Site at = parts_.sites[site];  // a copy: the function may add sites
  if (at.edge != k_none) {
    function(at.edge);
  } else if (at.vertex != k_none) {
    for (std::uint32_t k = first_edge_[at.vertex]; k < first_edge_[at.vertex + 1]; ++k) {
      function(edges_[k]);
    }
  }
}

// Those that have the site, and a lattice; each once.
template <class Function>
void Refinement::for_each_facet(std::uint32_t site, Function&& function) {
  if (parts_.places[site].facet != k_none) {
    if (is_lattice_facet(parts_.places[site].facet)) {
      function(parts_.places[site].facet);
    }
    return;
  }
  std::array<std::uint32_t, 64> known;  // corners where more meet may be told of a facet twice, which does no harm
  std::size_t count = 0;
  for_each_edge(site, [&](std::uint32_t edge) {
    for (const std::uint32_t use : parts_.welded.uses_at_edge(edge)) {
      const std::uint32_t facet = parts_.facets.facet_of_triangle[parts_.welded.uses_by_triangle[use].triangle];
      if (std::find(known.begin(), known.begin() + count, facet) == known.begin() + count && is_lattice_facet(facet)) {
        if (count < known.size()) {
          known[count++] = facet;
        }
        function(facet);
      }
    }
  });
}

bool Refinement::is_lattice_facet(std::uint32_t facet) const {
  const FacetRecord& record = parts_.records[facet];
  return record.first_share != k_none && (record.mesh == k_none || !parts_.meshes[record.mesh]->degenerate());
}

const FacetGround& Refinement::ground(std::uint32_t facet) {
  if (ground_of_[facet] == k_none) {
    ground_of_[facet] = static_cast<std::uint32_t>(grounds_.size());
    FacetGround& made = grounds_.emplace_back().emplace(parts_.input(facet));
    for (const InnerSite& site : irregular_) {
      if (parts_.places[site.site].facet == facet) {
        made.add(site);
      }
    }
  }
  return *grounds_[ground_of_[facet]];
}

// To tell it from `limit`; the answer may be less than it is, if it is more than that.
double Refinement::clearance_of(std::uint32_t site, double limit) {
  double& known = clearance_[site];
  if (known < limit) {
    const SitePlace& place = parts_.places[site];
    const FacetGround& facet = ground(place.facet);
    known = facet.clearance(facet.lattice().point(lattice_finest_, place.index), k_far * spacing(0));
  }
  return known;
}

// ---- Raising

void Refinement::raise(std::span<const std::uint32_t> sites, std::uint32_t max_sites) {
  clearance_.resize(parts_.sites.size(), -1.0);
  const std::pmr::vector<std::uint8_t> levels(parts_.levels, parts_.memory);  // a site named twice rises once
  for (const std::uint32_t site : sites) {
    const std::size_t before = parts_.sites.size();
    const auto level = static_cast<std::uint8_t>(levels[site] + 1);
    if (level <= finest_) {
      raised_.clear();
      need(site, level);
      if (!balance(max_sites > 0 ? max_sites : k_none)) {
        roll_back(before);
        break;
      }
    }
  }
}

// Raises what is pending, and all that this asks for. False where there would be too many sites; then what was done is
// to be undone.
bool Refinement::balance(std::size_t max_sites) {
  while (!pending_.empty()) {
    const Raising next = pending_.back();
    std::uint8_t& now = parts_.levels[next.site];
    if (now >= next.level) {
      pending_.pop_back();
    } else if (now + 1 < next.level) {
      need(next.site, static_cast<std::uint8_t>(next.level - 1));
    } else {
      pending_.pop_back();
      now = next.level;
      raised_.push_back(next.site);
      insert_around(next.site, next.level);
      if (parts_.sites.size() > max_sites) {
        return false;
      }
    }
  }
  return true;
}

void Refinement::roll_back(std::size_t site_count) {
  pending_.clear();
  for (const std::uint32_t site : raised_) {
    --parts_.levels[site];
  }
  while (!irregular_.empty() && irregular_.back().site >= site_count) {
    ground_of_[parts_.places[irregular_.back().site].facet] = k_none;  // to be made without it
    irregular_.pop_back();
  }
  parts_.sites.resize(site_count);
  parts_.places.resize(site_count);
  parts_.levels.resize(site_count);
  clearance_.resize(site_count);
  fill_table();
  // Squares that were marked for what is undone stay marked: it would have been too much, and little can come.
}

void Refinement::need(std::uint32_t site, std::uint8_t level) {
  if (parts_.levels[site] < level) {
    pending_.push_back({site, level});
  }
}

void Refinement::insert_around(std::uint32_t site, std::uint8_t level) {
  const SitePlace place = parts_.places[site];
  if (place.on_lattice) {
    insert_on_lattice(site, level);
    if (level > 1 && clearance_of(site, k_near_border * spacing(level - 1)) < k_near_border * spacing(level - 1)) {
      mark(place.facet, level - 1, ground(place.facet).lattice().point(lattice_finest_, place.index));
    }
    return;
  }
  insert_on_edges(site, level);
  for_each_facet(site, [&](std::uint32_t facet) {
    insert_beside(site, facet, level);
    if (level > 1) {
      mark(facet, level - 1, ground(facet).frame().to_plane(parts_.sites[site].position));
    }
  });
}

void Refinement::insert_on_lattice(std::uint32_t site, std::uint8_t level) {
  const SitePlace place = parts_.places[site];
  if (!is_lattice_facet(place.facet)) {
    return;
  }
  const Vec2 from = ground(place.facet).lattice().point(lattice_finest_, place.index);
  const double clearance = clearance_of(site, 2 * spacing(level));
  for (const LatticeIndex& direction : directions()) {
    const auto along = [&](std::int64_t steps) {
      return LatticeIndex{place.index.i + steps * direction.i, place.index.j + steps * direction.j};
    };
    lattice_site(place.facet, along(step(level)), level, from, clearance);
    const std::uint32_t outer = lattice_site(place.facet, along(2 * step(level)), level, from, clearance);
    if (outer != k_none) {
      need(outer, level - 1);
    }
  }
}

// Along each of its edges, the next one of the level to either side.
void Refinement::insert_on_edges(std::uint32_t site, std::uint8_t level) {
  const Site at = parts_.sites[site];
  if (at.edge != k_none) {
    const std::int64_t middle = parts_.places[site].index.i;
    edge_site(at.edge, middle - step(level), level);
    edge_site(at.edge, middle + step(level), level);
    return;
  }
  for_each_edge(site, [&](std::uint32_t edge) {
    const std::int64_t outward = parts_.borders.line(edge).steps(spacing(level));
    edge_site(edge, (at.vertex == parts_.welded.edges[edge].a ? -outward : outward) * step(level), level);
  });
}

void Refinement::insert_beside(std::uint32_t site, std::uint32_t facet, std::uint8_t level) {
  const FacetGround& on = ground(facet);
  const FacetLattice& lattice = on.lattice();
  const Vec2 from = on.frame().to_plane(parts_.sites[site].position);
  const std::uint32_t on_lattice = lattice_finest_ - finest_ + level;
  const double reach = k_reach * spacing(level);
  const double clear = k_half_spacing * spacing(level);  // of the facet's bounds, to begin with
  const Vec2 low = glm::max(from - reach, on.low() + clear);
  const Vec2 high = glm::min(from + reach, on.high() - clear);
  const std::int64_t last_row = lattice.last_row(on_lattice, high.y);
  for (std::int64_t j = lattice.first_row(on_lattice, low.y); j <= last_row; ++j) {
    const std::int64_t last = lattice.last_column(on_lattice, j, high.x);
    for (std::int64_t i = lattice.first_column(on_lattice, j, low.x); i <= last; ++i) {
      if (glm::distance(lattice.point(on_lattice, {i, j}), from) <= reach) {
        lattice_site(facet, {i * step(level), j * step(level)}, level, from, 0);
      }
    }
  }
}

// The site there, inserted where there is none and the level has one; else k_none. from: a point inside, that far or
// farther from all borders.
std::uint32_t Refinement::lattice_site(std::uint32_t facet, const LatticeIndex& index, std::uint8_t level,
                                       const Vec2& from, double from_clearance) {
  const std::uint32_t known = find_lattice_site(facet, index);
  if (known != k_none) {
    return known;
  }
  const FacetGround& on = ground(facet);
  const Vec2 point = on.lattice().point(lattice_finest_, index);
  std::uint8_t birth = coarsest(index.i, index.j);
  double clearance = from_clearance - glm::distance(point, from);
  if (clearance < spacing(birth)) {
    if (clearance <= 0 && !on.encloses(point)) {
      return k_none;
    }
    clearance = on.clearance(point, k_far * spacing(0));
  }
  while (birth <= level && clearance < k_half_spacing * spacing(birth)) {
    ++birth;
  }
  if (birth > level) {
    return k_none;
  }
  const std::uint32_t site = append(on.frame().to_world(point), birth, {facet, true, index}, clearance);
  follow_marks(site, facet, point);
  return site;
}

void Refinement::edge_site(std::uint32_t edge, std::int64_t at, std::uint8_t level) {
  const EdgeLine line = parts_.borders.line(edge);
  const auto has = [&](std::uint8_t on) {
    return at % step(on) == 0 && std::abs(at) <= line.steps(spacing(on)) * step(on);
  };
  if (!has(level) || find_edge_site(edge, at) != k_none) {
    return;
  }
  std::uint8_t birth = level;
  while (birth > 0 && has(birth - 1)) {
    --birth;
  }
  const std::uint32_t site = append(line.position(parts_.borders.from_middle(at)), birth, {k_none, false, {at, 0}}, 0);
  parts_.sites[site].edge = edge;
  table_.find_or_insert(hash_of(site), site, [](std::uint32_t) { return false; });
  for_each_facet(site, [&](std::uint32_t facet) {
    follow_marks(site, facet, ground(facet).frame().to_plane(parts_.sites[site].position));
  });
}

std::uint32_t Refinement::append(const Vec3& position, std::uint8_t level, const SitePlace& place, double clearance) {
  const auto site = static_cast<std::uint32_t>(parts_.sites.size());
  Site& made = parts_.sites.emplace_back();
  made.position = position;
  made.level = level;
  parts_.places.push_back(place);
  parts_.levels.push_back(level);
  clearance_.push_back(clearance);
  if (place.on_lattice) {
    table_.find_or_insert(hash_of(site), site, [](std::uint32_t) { return false; });
  }
  return site;
}

// ---- Balance near borders

bool Refinement::is_marked(const Mark& square) const {
  return mark_table_.find(hash_square(square.facet, square.level, square.x, square.y),
                          [&](std::uint32_t k) { return marks_[k] == square; }) != IndexTable::k_absent;
}

void Refinement::mark(std::uint32_t facet, std::uint8_t level, const Vec2& point) {
  const FacetGround& on = ground(facet);
  const double side = spacing(level);
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
      const Mark square{facet, level, x, y};
      const auto next = static_cast<std::uint32_t>(marks_.size());
      if (mark_table_.find_or_insert(hash_square(facet, level, x, y), next,
                                     [&](std::uint32_t k) { return marks_[k] == square; }) == next) {
        marks_.push_back(square);
      }
    }
  }
  if (marks_.size() > before) {
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
    if (is_marked({facet, level, square_of(position.x, spacing(level)), square_of(position.y, spacing(level))})) {
      need(site, level);
      return;
    }
  }
}

// ---- Irregular sites

void Refinement::insert(std::span<const WantedSite> wanted, std::uint32_t max_sites) {
  clearance_.resize(parts_.sites.size(), -1.0);
  const std::size_t most = max_sites > 0 ? max_sites : k_none;
  const std::size_t first = irregular_.size();
  for (const WantedSite& wish : wanted) {
    const std::size_t before = parts_.sites.size();
    if (before >= most) {
      break;
    }
    if (!is_lattice_facet(wish.facet)) {
      continue;
    }
    const Vec2 point = ground(wish.facet).frame().to_plane(wish.position);
    if (!is_free(wish.facet, point)) {
      continue;
    }
    const std::uint8_t level = level_at(wish.facet, point);
    const std::uint32_t site =
        append(ground(wish.facet).frame().to_world(point), level, {wish.facet, false, {0, 0}}, 0);
    irregular_.push_back({point, site, false, false});
    grounds_[ground_of_[wish.facet]]->add(irregular_.back());
    raised_.clear();
    follow_marks(site, wish.facet, point);
    if (level > 1) {
      mark(wish.facet, static_cast<std::uint8_t>(level - 1), point);
    }
    if (!balance(most)) {
      roll_back(before);
      break;
    }
  }
  if (irregular_.size() > first) {
    // Lattice sites near them may be nearer to an obstacle than was known.
    for (std::uint32_t site = 0; site < parts_.sites.size(); ++site) {
      clearance_[site] = parts_.places[site].on_lattice ? -1.0 : clearance_[site];
    }
  }
}

// Far enough from borders and other sites.
bool Refinement::is_free(std::uint32_t facet, const Vec2& point) {
  const FacetGround& on = ground(facet);
  const double apart = 0.25 * spacing(finest_);
  if (!on.encloses(point) || on.clearance(point, 2 * apart) < apart) {
    return false;
  }
  const LatticeIndex index = on.lattice().nearest(lattice_finest_, point);
  return glm::distance(on.lattice().point(lattice_finest_, index), point) >= apart ||
         find_lattice_site(facet, index) == k_none;
}

// The highest among the corners of the triangle that the point was in before.
std::uint8_t Refinement::level_at(std::uint32_t facet, const Vec2& point) const {
  const FacetPoint found = parts_.located(facet).locate(point);
  std::uint8_t level = 0;
  for (const std::uint32_t share : found.shares) {
    level = std::max(level, parts_.levels[parts_.samples[parts_.shares[share].sample].site]);
  }
  return level;
}

// ---- What came out

void Refinement::find_parents(std::uint32_t index) {
  Site& site = parts_.sites[index];
  const SitePlace& place = parts_.places[index];
  const auto adopt = [&](std::uint32_t a, std::uint32_t b) {
    if (a != k_none && b != k_none) {
      site.parents = {a, b};
    }
    return a != k_none && b != k_none;
  };
  const std::uint8_t level = place.on_lattice ? coarsest(place.index.i, place.index.j) : site.level;
  if (level == 0 || (!place.on_lattice && site.edge == k_none)) {
    return;
  }
  const std::int64_t half = step(level);
  if (site.edge != k_none) {
    adopt(find_edge_site(site.edge, place.index.i - half), find_edge_site(site.edge, place.index.i + half));
    return;
  }
  const auto across = [&](std::int64_t i, std::int64_t j) {
    return adopt(find_lattice_site(place.facet, {place.index.i - i, place.index.j - j}),
                 find_lattice_site(place.facet, {place.index.i + i, place.index.j + j}));
  };
  const std::int64_t i = place.index.i % (2 * half) != 0 ? half : 0;
  const std::int64_t j = place.index.j % (2 * half) != 0 ? half : 0;
  const bool crosswise = i != 0 && j != 0;  // on the hexagonal lattice that way alone leads to neighbours
  if (!across(crosswise ? -i : i, j) && crosswise && parts_.options.lattice == Lattice::quadrilateral) {
    across(i, j);
  }
}

ChangedFacets Refinement::take_changes() {
  struct NewOnEdge {
    std::uint32_t edge;
    EdgeSite site;
  };
  struct NewInside {
    std::uint32_t facet, site;
  };
  std::pmr::vector<NewOnEdge> on_edges(parts_.memory);
  std::pmr::vector<NewInside> inside(parts_.memory);
  ChangedFacets changed(parts_.memory);
  for (std::uint32_t site = first_new_; site < parts_.sites.size(); ++site) {
    find_parents(site);
    if (parts_.sites[site].edge != k_none) {
      on_edges.push_back({parts_.sites[site].edge, {site, parts_.places[site].index.i}});
    } else {
      inside.push_back({parts_.places[site].facet, site});
      changed.facets.push_back(parts_.places[site].facet);
    }
  }
  std::sort(on_edges.begin(), on_edges.end(), [](const NewOnEdge& a, const NewOnEdge& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.site.step < b.site.step;
  });
  std::pmr::vector<EdgeSite> more(parts_.memory);
  for (std::size_t k = 0; k < on_edges.size(); ++k) {
    more.push_back(on_edges[k].site);
    if (k + 1 == on_edges.size() || on_edges[k + 1].edge != on_edges[k].edge) {
      parts_.borders.insert(on_edges[k].edge, more);
      more.clear();
      for (const std::uint32_t use : parts_.welded.uses_at_edge(on_edges[k].edge)) {
        const std::uint32_t facet = parts_.facets.facet_of_triangle[parts_.welded.uses_by_triangle[use].triangle];
        if (parts_.records[facet].first_share != k_none) {
          changed.facets.push_back(facet);
        }
      }
    }
  }
  std::sort(changed.facets.begin(), changed.facets.end());
  changed.facets.erase(std::unique(changed.facets.begin(), changed.facets.end()), changed.facets.end());
  std::sort(inside.begin(), inside.end(), [](const NewInside& a, const NewInside& b) {
    return a.facet != b.facet ? a.facet < b.facet : a.site < b.site;
  });

  auto next = inside.begin();
  for (const std::uint32_t facet : changed.facets) {
    changed.first_inner.push_back(static_cast<std::uint32_t>(changed.inner.size()));
    const auto add = [&](std::uint32_t site) {
      const SitePlace& place = parts_.places[site];
      if (!place.on_lattice) {
        changed.inner.push_back(*std::lower_bound(irregular_.begin(), irregular_.end(), site,
                                                  [](const InnerSite& a, std::uint32_t b) { return a.site < b; }));
        return;
      }
      const std::int64_t whole = std::int64_t{1} << lattice_finest_;
      const bool is_centre = parts_.sites[site].level == 0 && place.index.i % whole == 0 && place.index.j % whole == 0;
      changed.inner.push_back({ground(facet).lattice().point(lattice_finest_, place.index), site, is_centre, true});
    };
    const auto given = parts_.given_on(facet);
    changed.inner.insert(changed.inner.end(), given.begin(), given.end());
    if (parts_.records[facet].mesh != k_none) {
      const FacetMesh& mesh = *parts_.meshes[parts_.records[facet].mesh];
      const auto old = mesh.sites().subspan(mesh.border_count());
      for (const std::uint32_t site : old.subspan(std::min(given.size(), old.size()))) {
        add(site);
      }
    }
    for (; next != inside.end() && next->facet == facet; ++next) {
      add(next->site);
    }
  }
  changed.first_inner.push_back(static_cast<std::uint32_t>(changed.inner.size()));
  first_new_ = static_cast<std::uint32_t>(parts_.sites.size());
  return changed;
}

}  // namespace radvor
