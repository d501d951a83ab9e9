#include "radiosity/sample_neighbours.h"

#include <algorithm>

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
  const auto count = static_cast<std::uint32_t>(surface.samples().size());
  std::pmr::vector<std::uint32_t> begin(count + 1, 0, &host.memory);
  for_each_edge(surface, [&](std::uint32_t from, std::uint32_t) { ++begin[from + 1]; });
  for (std::uint32_t i = 0; i < count; ++i) {
    begin[i + 1] += begin[i];
  }
  std::pmr::vector<std::uint32_t> all(begin.back(), &host.memory), end(begin.begin(), begin.end() - 1, &host.memory);
  for_each_edge(surface, [&](std::uint32_t from, std::uint32_t to) { all[end[from]++] = to; });

  // Each once: counted first, then written.
  const auto in_blocks = [&](auto&& on_sample) {
    host.jobs.for_ranges(count, 1024, [&](std::size_t first, std::size_t last) {
      for (auto i = static_cast<std::uint32_t>(first); i < last; ++i) {
        on_sample(i);
      }
    });
  };
  in_blocks([&](std::uint32_t i) {
    std::sort(all.begin() + begin[i], all.begin() + end[i]);
    for (std::uint32_t k = begin[i]; k < end[i]; ++k) {
      first_[i + 1] += k == begin[i] || all[k] != all[k - 1] ? 1 : 0;
    }
  });
  for (std::uint32_t i = 0; i < count; ++i) {
    first_[i + 1] += first_[i];
  }
  list_.resize(first_.back());
  in_blocks([&](std::uint32_t i) {
    std::uint32_t to = first_[i];
    for (std::uint32_t k = begin[i]; k < end[i]; ++k) {
      if (k == begin[i] || all[k] != all[k - 1]) {
        list_[to++] = {all[k], 0};
      }
      ++list_[to - 1].triangles;
    }
  });
}

}  // namespace radvor
