// A byte stream is a program of edits and questions on one triangulation, through the C ABI. Wherever a call failed,
// for want of memory too, everything is audited and has to be as it was; at the end the triangulation has to be the one
// that its vertices, constraints and values make when they come all at once, and cells have to fill the domain.
// Coordinates come from a small lattice (ties, collinear runs), from integer points of a circle, or straight from the
// bytes.
#include <radvor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

struct Program {
  const std::uint8_t* data;
  std::size_t size;
  bool tame = false;       // no coordinates from the bits
  bool on_lattice = true;  // none came from the bits or from a rounded split

  bool ended() const { return size == 0; }
  std::uint8_t byte() {
    if (size == 0) {
      return 0;
    }
    --size;
    return *data++;
  }
  double bits() {
    std::uint64_t raw = 0;
    for (int i = 0; i < 8; ++i) {
      raw = raw << 8 | byte();
    }
    double value;
    std::memcpy(&value, &raw, sizeof value);
    return value;
  }
  // Lattice, circle x^2 + y^2 = 65^2, or raw bits.
  void point(double (&xy)[2]) {
    static const int k_circle[][2] = {{65, 0},  {63, 16}, {60, 25}, {56, 33}, {52, 39},
                                      {39, 52}, {33, 56}, {25, 60}, {16, 63}, {0, 65}};
    const std::uint8_t kind = tame ? byte() % 230 : byte();
    if (kind < 160) {
      const std::uint8_t place = byte();
      xy[0] = place % 12;
      xy[1] = place / 12 % 12;
    } else if (kind < 230) {
      const auto& on = k_circle[byte() % 10];
      xy[0] = kind & 1 ? on[0] : -on[0];
      xy[1] = kind & 2 ? on[1] : -on[1];
    } else {
      xy[0] = bits();
      xy[1] = bits();
      on_lattice = false;
    }
  }
};

// All integer points of the circle x^2 + y^2 = 1105^2: a tie polygon of more corners than are resolved exactly.
constexpr std::uint32_t k_most_at_once = 108;

void point_of_great_circle(std::uint32_t index, double (&xy)[2]) {
  static const int k_quarter[][2] = {
      {1105, 0},  {1104, 47}, {1100, 105}, {1092, 169}, {1073, 264}, {1071, 272}, {1020, 425}, {1001, 468}, {975, 520},
      {952, 561}, {943, 576}, {884, 663},  {855, 700},  {817, 744},  {744, 817},  {700, 855},  {663, 884},  {576, 943},
      {561, 952}, {520, 975}, {468, 1001}, {425, 1020}, {272, 1071}, {264, 1073}, {169, 1092}, {105, 1100}, {47, 1104}};
  const auto& at = k_quarter[index % 27];
  const double x = at[0], y = at[1];
  const double turned[4][2] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
  xy[0] = turned[index / 27][0];
  xy[1] = turned[index / 27][1];
}

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
} g_counters;

radvor_context* g_context = nullptr;

// ---- Memory that runs out on request

std::uint32_t g_allocations_left = UINT32_MAX;

void* acquire(void*, std::size_t bytes, std::size_t alignment) {
  if (g_allocations_left != UINT32_MAX && g_allocations_left-- == 0) {
    g_allocations_left = 0;
    return nullptr;
  }
  return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

void release(void*, void* memory, std::size_t, std::size_t) {
  std::free(memory);
}

void fail(const char* what) {
  std::fprintf(stderr, "%s: %s\n", what, radvor_context_error(g_context));
  std::abort();
}

void must(radvor_result result, const char* what) {
  if (result < 0) {
    fail(what);
  }
}

void audit(const radvor_delaunay* d) {
  must(radvor_delaunay_validate(d), "audit");
}

// ---- What is there, in a form that can be compared

struct State {
  std::vector<double> xy;
  std::vector<std::uint32_t> ids;
  std::vector<std::array<std::uint32_t, 3>> triangles;    // of ranks in ids, least first, sorted
  std::vector<std::array<std::uint32_t, 3>> constraints;  // two ranks and the flags, sorted
  bool operator==(const State&) const = default;
};

State state_of(const radvor_delaunay* d) {
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
void compare_with_rebuilt(radvor_delaunay* d) {
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
void fill_with_cells(const radvor_delaunay* d) {
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

// Errors that a caller may cause; anything else is a find.
bool worked(const radvor_delaunay* d, radvor_result result) {
  if (result == RADVOR_ERROR_INTERNAL || result == RADVOR_ERROR_OUT_OF_MEMORY) {
    fail("call");
  }
  if (result < 0) {
    audit(d);
  }
  return result >= 0;
}

// The same for edits: one that fails changes nothing.
template <class Edit>
bool edits(radvor_delaunay* d, std::uint32_t& starvation, Edit&& edit) {
  const bool starving = starvation != UINT32_MAX;
  if (!starving) {
    return worked(d, edit());
  }
  const State before = state_of(d);
  g_allocations_left = starvation;
  starvation = UINT32_MAX;
  const radvor_result result = edit();
  g_allocations_left = UINT32_MAX;
  if (result == RADVOR_ERROR_INTERNAL) {
    fail("call");
  }
  if (result < 0) {
    g_counters.starved += result == RADVOR_ERROR_OUT_OF_MEMORY;
    audit(d);
    if (!(state_of(d) == before)) {
      fail("an edit that failed changed something");
    }
  }
  return result >= 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (!g_context) {
    radvor_context_desc desc{};
    desc.struct_size = sizeof desc;
    desc.thread_count = 1;
    desc.acquire = acquire;
    desc.release = release;
    if (radvor_context_create(&desc, &g_context) < 0) {
      std::abort();
    }
  }
  radvor_delaunay* d = nullptr;
  if (radvor_delaunay_create(g_context, &d) < 0) {
    fail("create");
  }
  ++g_counters.runs;
  Program program{data, size};
  program.tame = program.byte() % 4 != 0;
  double xy[2];
  std::uint32_t hint = RADVOR_NONE;
  std::uint32_t starvation = UINT32_MAX;  // of the next edit: allocations until one fails
  for (int step = 0; step < 400 && !program.ended(); ++step) {
    const std::uint8_t operation = program.byte() % 20;
    const std::uint32_t bound = radvor_delaunay_vertex_bound(d) + 1;
    switch (operation) {
      case 0:
      case 1:
      case 2:
      case 3: {
        program.point(xy);
        std::uint32_t vertex;
        if (edits(d, starvation, [&] { return radvor_delaunay_insert(d, xy[0], xy[1], &vertex); })) {
          ++g_counters.inserted;
        }
        break;
      }
      case 4: {
        double many[2 * k_most_at_once];
        const std::uint8_t choice = program.byte();
        const std::uint32_t count = choice < 240 ? choice % 48 : k_most_at_once;
        for (std::uint32_t i = 0; i < count; ++i) {
          if (choice < 240) {
            program.point(xy);
          } else {
            point_of_great_circle(i, xy);
          }
          many[2 * std::size_t{i}] = xy[0];
          many[2 * std::size_t{i} + 1] = xy[1];
        }
        std::uint32_t ids[k_most_at_once];
        if (edits(d, starvation, [&] { return radvor_delaunay_insert_many(d, many, count, ids); })) {
          g_counters.inserted += count;
          for (std::uint32_t i = 0; i < count; ++i) {
            if (radvor_delaunay_position(d, ids[i], xy) < 0 || xy[0] != many[2 * std::size_t{i}] ||
                xy[1] != many[2 * std::size_t{i} + 1]) {
              fail("insert_many gave another point's id");
            }
          }
        }
        break;
      }
      case 5:
      case 6: {
        const std::uint32_t vertex = program.byte() % bound;
        g_counters.removed += edits(d, starvation, [&] { return radvor_delaunay_remove(d, vertex); });
        break;
      }
      case 7:
      case 8: {
        const std::uint32_t a = program.byte() % bound, b = program.byte() % bound;
        const std::uint32_t choice = program.byte();
        const bool split = (choice & 8) != 0;
        if (edits(d, starvation, [&] { return radvor_delaunay_constrain_as(d, a, b, 1u << (choice % 3), split); })) {
          ++(split ? g_counters.crossed : g_counters.constrained);
          program.on_lattice = program.on_lattice && !split;
        } else {
          ++g_counters.refused;
        }
        break;
      }
      case 9: {
        const std::uint32_t a = program.byte() % bound, b = program.byte() % bound;
        g_counters.freed += edits(d, starvation, [&] { return radvor_delaunay_unconstrain(d, a, b); });
        break;
      }
      case 10: {
        const std::uint32_t a = program.byte() % bound, b = program.byte() % bound;
        double from[2], to[2];
        if (radvor_delaunay_position(d, a, from) >= 0 && radvor_delaunay_position(d, b, to) >= 0) {
          const double share = program.byte() / 256.0,
                       beside = std::ldexp(program.byte() - 128.0, -program.byte() % 60);
          g_counters.split += edits(d, starvation, [&] {
            return radvor_delaunay_split(d, a, b, from[0] + share * (to[0] - from[0]),
                                         from[1] + share * (to[1] - from[1]) + beside, nullptr);
          });
          program.on_lattice = false;
        }
        break;
      }
      case 11: {
        const std::uint32_t first = program.byte() % bound;
        const std::uint8_t choice = program.byte();
        if (choice < 250) {
          double values[8];
          const std::uint32_t count = choice % 9;
          for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint8_t value = program.byte();
            values[i] = value == 255 ? NAN : value % 8;
          }
          edits(d, starvation, [&] { return radvor_delaunay_set_values(d, values, first, count); });
        } else {  // all of them
          std::vector<double> values(bound - 1);
          for (std::uint32_t i = 0; i + 1 < bound; ++i) {
            values[i] = (i * (first + 1) ^ choice) % 7;
          }
          edits(d, starvation, [&] { return radvor_delaunay_set_values(d, values.data(), 0, bound - 1); });
        }
        break;
      }
      case 12:
        if (edits(d, starvation, [&] { return radvor_delaunay_realign(d); })) {
          ++g_counters.realigned;
          std::uint32_t ties = 0;
          worked(d, radvor_delaunay_tie_count(d, &ties));
          g_counters.ties += ties;
        }
        break;
      case 13: {
        program.point(xy);
        std::uint32_t where, vertices[3];
        g_counters.located += worked(d, radvor_delaunay_locate(d, xy[0], xy[1], &hint, &where, vertices));
        break;
      }
      case 14: {
        program.point(xy);
        double value;
        g_counters.interpolated +=
            worked(d, radvor_delaunay_interpolate(d, program.byte() % 2, xy[0], xy[1], &hint, &value));
        break;
      }
      case 16:
        starvation = program.byte() % 16;
        break;
      case 17: {
        const std::uint32_t vertex = program.byte() % bound;
        edits(d, starvation, [&] { return radvor_delaunay_realign_near(d, &vertex, 1); });
        break;
      }
      case 18: {
        program.point(xy);
        if (edits(d, starvation, [&] { return radvor_delaunay_insert_near(d, xy[0], xy[1], &hint); })) {
          ++g_counters.inserted;
        }
        break;
      }
      case 19: {
        // Lists: the hull, a star, the last report.
        std::uint32_t list[64], count = 64;
        worked(d, radvor_delaunay_hull(d, list, &count));
        count = 64;
        worked(d, radvor_delaunay_neighbours(d, program.byte() % bound, list, &count));
        count = 64;
        if (worked(d, radvor_delaunay_changes(d, list, &count))) {
          std::sort(list, list + count);
          if (std::adjacent_find(list, list + count) != list + count) {
            fail("a vertex is told of twice");
          }
          for (std::uint32_t i = 0; i < count; ++i) {
            must(radvor_delaunay_position(d, list[i], xy), "a vertex is told of that is not there");
          }
        }
        break;
      }
      default:
        if (program.byte() % 2) {
          g_counters.marked += edits(d, starvation, [&] { return radvor_delaunay_mark_domain(d); });
        } else if (bound > 1) {
          const std::uint32_t vertex = program.byte() % bound;
          std::uint32_t sectors = 0;
          worked(d, radvor_delaunay_bounded_cell(d, vertex, 0, &sectors, nullptr, nullptr, nullptr, nullptr));
          worked(d, radvor_delaunay_cell(d, vertex, nullptr, 0, nullptr, nullptr, nullptr, nullptr));
        }
    }
  }
  audit(d);
  if (program.on_lattice) {
    fill_with_cells(d);
  }
  compare_with_rebuilt(d);
  radvor_delaunay_destroy(d);
  return 0;
}
