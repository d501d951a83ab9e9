// What must hold of a triangulation whatever was done to it, asked through the C ABI: it is valid, it is the one that
// its vertices, constraints and values make when they come all at once, and cells fill the domain.
#pragma once

#include <radvor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace radvor::fuzz {

// What the programs reach, printed at the end where RADVOR_FUZZ_COUNTERS is set.
struct Counters {
  unsigned long long runs = 0, inserted = 0, removed = 0, constrained = 0, refused = 0, crossed = 0, freed = 0,
                     split = 0, ties = 0, realigned = 0, located = 0, interpolated = 0, marked = 0, starved = 0,
                     rebuilt = 0, filled = 0;
  ~Counters() {
    if (std::getenv("RADVOR_FUZZ_COUNTERS")) {
      std::fprintf(
          stderr,
          "runs %llu inserted %llu removed %llu constrained %llu refused %llu crossed %llu freed %llu split %llu "
          "ties %llu realigned %llu located %llu interpolated %llu marked %llu starved %llu rebuilt %llu filled %llu\n",
          runs, inserted, removed, constrained, refused, crossed, freed, split, ties, realigned, located, interpolated,
          marked, starved, rebuilt, filled);
    }
  }
};

inline Counters g_counters;

inline radvor_context* g_context = nullptr;

inline void fail(const char* what) {
  std::fprintf(stderr, "%s: %s\n", what, radvor_context_error(g_context));
  std::abort();
}

inline void must(radvor_result result, const char* what) {
  if (result < 0) {
    fail(what);
  }
}

inline void audit(const radvor_delaunay* d) {
  must(radvor_delaunay_validate(d), "audit");
}

/// What is there, in a form that can be compared.
struct State {
  std::vector<double> xy;
  std::vector<std::uint32_t> ids;
  std::vector<std::array<std::uint32_t, 3>> triangles;    // of ranks in ids, least first, sorted
  std::vector<std::array<std::uint32_t, 3>> constraints;  // two ranks and the flags, sorted
  bool operator==(const State&) const = default;
};

inline State state_of(const radvor_delaunay* d) {
  State state;
  const std::uint32_t vertex_count = radvor_delaunay_vertex_count(d),
                      triangle_count = radvor_delaunay_triangle_count(d);
  state.xy.resize(2 * std::size_t{vertex_count} + 2);
  state.ids.resize(vertex_count + 1);
  std::vector<std::uint32_t> indices(3 * std::size_t{triangle_count} + 3);
  must(radvor_delaunay_copy(d, state.xy.data(), state.ids.data(), vertex_count, indices.data(), triangle_count),
       "copy");
  state.ids.pop_back();
  for (std::uint32_t t = 0; t < triangle_count; ++t) {
    auto* const at = indices.data() + 3 * std::size_t{t};
    std::rotate(at, std::min_element(at, at + 3), at + 3);
    state.triangles.push_back({at[0], at[1], at[2]});
  }
  std::sort(state.triangles.begin(), state.triangles.end());
  std::uint32_t count = 0;
  must(radvor_delaunay_constraints(d, nullptr, &count), "constraints");
  std::vector<std::uint32_t> pairs(2 * std::size_t{count} + 2);
  must(radvor_delaunay_constraints(d, pairs.data(), &count), "constraints");
  const auto rank = [&](std::uint32_t id) {
    return static_cast<std::uint32_t>(std::lower_bound(state.ids.begin(), state.ids.end(), id) - state.ids.begin());
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t flags = 0;
    must(radvor_delaunay_constraint(d, pairs[2 * std::size_t{i}], pairs[2 * std::size_t{i} + 1], &flags), "constraint");
    state.constraints.push_back({rank(pairs[2 * std::size_t{i}]), rank(pairs[2 * std::size_t{i} + 1]), flags});
  }
  std::sort(state.constraints.begin(), state.constraints.end());
  return state;
}

// History leaves no trace: all at once gives the same. Values act at realign, so that comes first on both sides.
inline void compare_with_rebuilt(radvor_delaunay* d) {
  must(radvor_delaunay_realign(d), "realign");
  audit(d);
  State state = state_of(d);
  const auto count = static_cast<std::uint32_t>(state.ids.size());
  radvor_delaunay* again = nullptr;
  must(radvor_delaunay_create(g_context, &again), "create");
  must(radvor_delaunay_insert_many(again, state.xy.data(), count, nullptr), "insert_many");
  for (const auto& [a, b, flags] : state.constraints) {
    must(radvor_delaunay_constrain_as(again, a, b, flags, RADVOR_CROSSING_REFUSE), "constrain");
  }
  std::vector<double> values(count + 1);
  for (std::uint32_t i = 0; i < count; ++i) {
    must(radvor_delaunay_value(d, state.ids[i], &values[i]), "value");
    state.ids[i] = i;
  }
  must(radvor_delaunay_set_values(again, values.data(), 0, count), "set_values");
  must(radvor_delaunay_realign(again), "realign");
  audit(again);
  if (!(state_of(again) == state)) {
    fail("another triangulation than that of the same set, made at once");
  }
  radvor_delaunay_destroy(again);
  ++g_counters.rebuilt;
}

// On lattices numbers are harmless, so that areas must add up to rounding.
inline void fill_with_cells(const radvor_delaunay* d) {
  const State state = state_of(d);
  std::vector<std::uint8_t> inside(state.triangles.size() + 1);
  std::vector<std::uint32_t> indices(3 * state.triangles.size() + 3);
  must(radvor_delaunay_triangles(d, indices.data(), static_cast<std::uint32_t>(state.triangles.size())), "triangles");
  must(radvor_delaunay_inside(d, inside.data(), static_cast<std::uint32_t>(state.triangles.size())), "inside");
  double area = 0;
  for (std::size_t t = 0; t < state.triangles.size(); ++t) {
    double p[3][2];
    for (int k = 0; k < 3; ++k) {
      must(radvor_delaunay_position(d, indices[3 * t + static_cast<std::size_t>(k)], p[k]), "position");
    }
    if (inside[t]) {
      area += 0.5 * ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]));
    }
  }
  double sum = 0;
  for (const std::uint32_t id : state.ids) {
    std::uint32_t sectors = 0;
    must(radvor_delaunay_bounded_cell(d, id, 0, &sectors, nullptr, nullptr, nullptr, nullptr), "bounded_cell");
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      double part = 0;
      must(radvor_delaunay_bounded_cell(d, id, sector, nullptr, nullptr, nullptr, &part, nullptr), "bounded_cell");
      sum += part;
    }
  }
  if (!(std::fabs(sum - area) <= 1e-9 * (1 + area))) {
    std::fprintf(stderr, "cells %.17g, domain %.17g\n", sum, area);
    fail("cells do not fill the domain");
  }
  ++g_counters.filled;
}

}  // namespace radvor::fuzz
