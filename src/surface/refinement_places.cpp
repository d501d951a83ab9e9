// What is where: sites by their place on a lattice or an edge, the edges at a corner, how far from obstacles a site is.
#include <bit>
#include <cmath>

#include "base/hash.h"
#include "surface/refinement.h"

namespace radvor {
namespace {

constexpr std::uint64_t k_edge = 1;  // kinds of places, for hashing
constexpr std::uint64_t k_lattice = 2;

std::uint64_t hash_place(std::uint64_t kind, std::uint64_t where, const LatticeIndex& index) {
  return hash(kind << 32 | where,
              static_cast<std::uint64_t>(index.i) ^ std::rotl(static_cast<std::uint64_t>(index.j), 32));
}

}  // namespace

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

bool Refinement::is_refused(std::uint32_t facet, const LatticeIndex& index, std::uint8_t level) const {
  const std::uint32_t known = refused_table_.find(hash_place(k_lattice, facet, index),
                                                  [&](std::uint32_t k) { return refused_[k].is_at(facet, index); });
  return known != IndexTable::k_absent && level < refused_[known].birth;
}

void Refinement::refuse(std::uint32_t facet, const LatticeIndex& index, std::uint8_t birth) {
  const auto next = static_cast<std::uint32_t>(refused_.size());
  const std::uint32_t known = refused_table_.find_or_insert(
      hash_place(k_lattice, facet, index), next, [&](std::uint32_t k) { return refused_[k].is_at(facet, index); });
  if (known == next) {
    refused_.push_back({facet, birth, index});
  } else {
    refused_[known].birth = birth;  // obstacles have come since
  }
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
    known = facet.clearance(facet.lattice().point(lattice_finest_, place.index), farthest());
  }
  return known;
}

}  // namespace radvor
