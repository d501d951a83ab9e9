#include "radiosity/sample_neighbours.h"

namespace radvor {

namespace {

// Both ways, on both sides of two-sided facets.
template <class OnEdge>
void for_each_edge(const Surface& surface, OnEdge&& on_edge) {
  const auto shares = surface.shares();
  for (std::uint32_t facet = 0; facet < surface.facets().facets.size(); ++facet) {
    for (const ShareTriangle& triangle : surface.triangles(facet)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Share &a = shares[triangle[k]], &b = shares[triangle[(k + 1) % 3]];
        on_edge(a.sample, b.sample);
        on_edge(b.sample, a.sample);
        if (a.other_side != k_none) {
          on_edge(shares[a.other_side].sample, shares[b.other_side].sample);
          on_edge(shares[b.other_side].sample, shares[a.other_side].sample);
        }
      }
    }
  }
}

}  // namespace

SampleNeighbours::SampleNeighbours(const Surface& surface, Host& host)
    : first_(surface.samples().size() + 1, 0, &host.memory), list_(&host.memory) {
  for_each_edge(surface, [&](std::uint32_t from, std::uint32_t) { ++first_[from + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) {
    first_[i] += first_[i - 1];
  }
  list_.resize(first_.back());
  std::pmr::vector<std::uint32_t> next(first_.begin(), first_.end() - 1, &host.memory);
  for_each_edge(surface, [&](std::uint32_t from, std::uint32_t to) { list_[next[from]++] = to; });
}

}  // namespace radvor
