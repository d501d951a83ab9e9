#include "surface/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radvor {
namespace {

constexpr double k_reach = 2.25;         // of a border into the lattice, in spacings of the level
constexpr std::uint32_t k_at_once = 16;  // sites, each some microseconds
constexpr double k_near_border = 3;      // in spacings: lattice sites this near balance as border sites do

}  // namespace

Refinement::Refinement(SurfaceParts& parts)
    : parts_(parts),
      finest_(static_cast<std::uint8_t>(refinements(parts.options))),
      lattice_finest_(parts.options.element_levels + finest_),
      table_(parts.sites.size(), parts.memory),
      clearance_(parts.memory),
      refused_table_(0, parts.memory),
      refused_(parts.memory),
      marks_(parts.memory),
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

Steps Refinement::raise(std::span<const std::uint32_t> sites, std::uint32_t max_sites, Pace& pace) {
  clearance_.resize(parts_.sites.size(), -1.0);
  const std::pmr::vector<std::uint8_t> levels(parts_.levels, parts_.memory);  // a site named twice rises once
  std::uint32_t raised = 0;
  for (const std::uint32_t site : sites) {
    const auto level = static_cast<std::uint8_t>(levels[site] + 1);
    if (level <= finest_) {
      const std::size_t before = begin_step();
      need(site, level);
      if (!balance(max_sites > 0 ? max_sites : k_none)) {
        roll_back(before);
        break;
      }
      if (++raised % k_at_once == 0) {
        co_await pace;
      }
    }
  }
}

std::size_t Refinement::begin_step() {
  raised_.clear();
  marks_.begin_step();
  return parts_.sites.size();
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

void Refinement::roll_back(std::size_t sites_before) {
  pending_.clear();
  for (const std::uint32_t site : raised_) {
    --parts_.levels[site];
  }
  while (!irregular_.empty() && irregular_.back().site >= sites_before) {
    ground_of_[parts_.places[irregular_.back().site].facet] = k_none;  // to be made without it
    irregular_.pop_back();
    refused_.clear();  // it may have been in the way
    refused_table_ = IndexTable(0, parts_.memory);
  }
  parts_.sites.resize(sites_before);
  parts_.places.resize(sites_before);
  parts_.levels.resize(sites_before);
  clearance_.resize(sites_before);
  fill_table();
  marks_.undo();
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
  if (is_refused(facet, index, level)) {
    return k_none;
  }
  const FacetGround& on = ground(facet);
  const Vec2 point = on.lattice().point(lattice_finest_, index);
  std::uint8_t birth = coarsest(index.i, index.j);
  double clearance = from_clearance - glm::distance(point, from);
  if (clearance < spacing(birth)) {
    if (clearance <= 0 && !on.encloses(point)) {
      refuse(facet, index, k_never);
      return k_none;
    }
    clearance = on.clearance(point, farthest());
  }
  while (birth <= finest_ && clearance < k_half_spacing * spacing(birth)) {
    ++birth;
  }
  if (birth > level) {
    refuse(facet, index, birth);
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

}  // namespace radvor
