// A byte stream is a program of edits and questions on one triangulation, through the C ABI. Wherever a call failed,
// for want of memory too, everything is audited and has to be as it was; at the end all of delaunay_audits.h must hold.
#include <radvor.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "delaunay_audits.h"
#include "delaunay_program.h"

namespace {

using namespace radvor::fuzz;

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
