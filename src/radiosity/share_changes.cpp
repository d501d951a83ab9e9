#include "radiosity/share_changes.h"

#include <algorithm>

#include "radiosity/facet_ranges.h"

namespace radvor {

namespace {

constexpr std::size_t k_range = 4096;  // shares of a task

bool alike(const Share& a, const SharesBefore::Share& b) {
  return a.facet == b.facet && a.back == b.back;
}

// Where a share's sample is no more (a facet too thin to be triangulated anew takes its sectors apart): the share of
// the same facet and side at the same site, or any of the facet.
void place_orphans(const SharesBefore& before, std::span<const std::uint32_t> orphans, const Surface& surface,
                   ShareChanges& changes) {
  const auto shares = surface.shares();
  const auto samples = surface.samples();
  std::pmr::vector<std::uint32_t> first_at_site(surface.sites().size(), k_none, changes.now.get_allocator());
  std::pmr::vector<std::uint32_t> next_at_site(shares.size(), k_none, changes.now.get_allocator());
  std::pmr::vector<std::uint32_t> any_of_facet(surface.facets().facets.size(), k_none, changes.now.get_allocator());
  std::pmr::vector<std::uint8_t> taken_apart(any_of_facet.size(), 0, changes.now.get_allocator());
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    const std::uint32_t site = samples[shares[s].sample].site;
    next_at_site[s] = first_at_site[site];
    first_at_site[site] = s;
    any_of_facet[shares[s].facet] = shares[s].back ? any_of_facet[shares[s].facet] : s;
  }
  for (const std::uint32_t s : orphans) {
    const SharesBefore::Share& old = before.shares[s];
    std::uint32_t share = first_at_site[before.sites[old.sample]];
    while (share != k_none && !alike(shares[share], old)) {
      share = next_at_site[share];
    }
    const std::uint32_t front = any_of_facet[old.facet];
    changes.now[s] = share != k_none ? share : old.back ? shares[front].other_side : front;
    taken_apart[old.facet] = 1;
  }
  for (std::uint32_t s = 0; s < shares.size(); ++s) {
    changes.divided[s] |= taken_apart[shares[s].facet];
  }
}

// A new site takes part in every triangle that it makes another of: so all corners of triangles that are no more are
// corners of triangles with a new one.
void mark_divided(std::uint32_t facet, std::span<const std::uint8_t> is_new, const Surface& surface,
                  std::span<std::uint8_t> divided) {
  const auto shares = surface.shares();
  for (const ShareTriangle& triangle : surface.triangles(facet)) {
    if (std::none_of(triangle.begin(), triangle.end(), [&](auto s) { return is_new[shares[s].sample] != 0; })) {
      continue;
    }
    for (const std::uint32_t share : triangle) {
      divided[share] = 1;
      if (shares[share].other_side != k_none) {
        divided[shares[share].other_side] = 1;
      }
    }
  }
}

void mark_divided(std::span<const std::uint32_t> samples_now, const Surface& surface, std::span<std::uint8_t> divided,
                  Host& host) {
  std::pmr::vector<std::uint8_t> is_new(surface.samples().size(), 1, &host.memory);
  for (const std::uint32_t sample : samples_now) {
    if (sample != k_none) {
      is_new[sample] = 0;
    }
  }
  // Shares belong to one facet, both sides of them: tasks do not meet.
  const EvenRanges ranges = ranges_by_triangles(surface, host);
  ranges.for_each(host.jobs, [&](std::uint32_t, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t facet = begin; facet < end; ++facet) {
      mark_divided(facet, is_new, surface, divided);
    }
  });
}

}  // namespace

SharesBefore::SharesBefore(const Surface& surface, Host& host)
    : shares(surface.shares().size(), &host.memory), sites(surface.samples().size(), &host.memory) {
  host.jobs.for_ranges(shares.size(), k_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const radvor::Share& share = surface.shares()[s];
      shares[s] = {share.sample, share.facet, share.back};
    }
  });
  host.jobs.for_ranges(sites.size(), k_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sites[i] = surface.samples()[i].site;
    }
  });
}

ShareChanges follow_shares(const SharesBefore& before, std::span<const std::uint32_t> samples_now,
                           const Surface& surface, Host& host) {
  const auto shares = surface.shares();
  const auto samples = surface.samples();
  ShareChanges changes{std::pmr::vector<std::uint32_t>(before.shares.size(), k_none, &host.memory),
                       std::pmr::vector<std::uint8_t>(shares.size(), 0, &host.memory)};
  host.jobs.for_ranges(before.shares.size(), k_range, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const std::uint32_t sample = samples_now[before.shares[s].sample];
      std::uint32_t share = sample == k_none ? k_none : samples[sample].first_share;
      while (share != k_none && !alike(shares[share], before.shares[s])) {
        share = shares[share].next_in_sample;
      }
      changes.now[s] = share;
    }
  });
  std::pmr::vector<std::uint32_t> orphans(&host.memory);
  for (std::uint32_t s = 0; s < before.shares.size(); ++s) {
    if (changes.now[s] == k_none) {
      orphans.push_back(s);
    }
  }
  if (!orphans.empty()) {
    place_orphans(before, orphans, surface, changes);
  }
  mark_divided(samples_now, surface, changes.divided, host);
  return changes;
}

std::uint32_t ShareMoves::move(std::uint32_t share, const ShareChanges& changes) {
  const std::uint32_t now = changes.now[share];
  return changes.divided[now] != 0 ? now | k_divided : now;
}

ShareMoves::ShareMoves(const ShareChanges& changes, Host& host) : moves_(changes.now.size(), &host.memory) {
  host.jobs.for_ranges(moves_.size(), k_range, [&](std::size_t begin, std::size_t end) {
    for (auto share = static_cast<std::uint32_t>(begin); share < end; ++share) {
      moves_[share] = move(share, changes);
    }
  });
}

void ShareMoves::follow(const ShareChanges& changes, Host& host) {
  host.jobs.for_ranges(moves_.size(), k_range, [&](std::size_t begin, std::size_t end) {
    for (auto share = static_cast<std::uint32_t>(begin); share < end; ++share) {
      moves_[share] = move(now(share), changes) | (moves_[share] & k_divided);
    }
  });
}

}  // namespace radvor
