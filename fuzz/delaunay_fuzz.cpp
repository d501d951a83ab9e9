// A byte stream is a program of edits and questions on one triangulation, through the C ABI; after it, and wherever a
// call failed, everything is audited. Coordinates come from a small lattice (ties, collinear runs), from integer points
// of a circle, or straight from the bytes.
#include <radvor.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Program {
  const std::uint8_t* data;
  std::size_t size;

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
    const std::uint8_t kind = byte();
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
    }
  }
};

// What the programs reach, printed at the end where RADVOR_FUZZ_COUNTERS is set.
struct Counters {
  unsigned long long runs = 0, inserted = 0, removed = 0, constrained = 0, refused = 0, crossed = 0, freed = 0,
                     split = 0, ties = 0, realigned = 0, located = 0, interpolated = 0, marked = 0;
  ~Counters() {
    if (std::getenv("RADVOR_FUZZ_COUNTERS")) {
      std::fprintf(
          stderr,
          "runs %llu inserted %llu removed %llu constrained %llu refused %llu crossed %llu freed %llu split %llu "
          "ties %llu realigned %llu located %llu interpolated %llu marked %llu\n",
          runs, inserted, removed, constrained, refused, crossed, freed, split, ties, realigned, located, interpolated,
          marked);
    }
  }
} g_counters;

radvor_context* g_context = nullptr;

void fail(const char* what) {
  std::fprintf(stderr, "%s: %s\n", what, radvor_context_error(g_context));
  std::abort();
}

void audit(const radvor_delaunay* d) {
  if (radvor_delaunay_validate(d) != RADVOR_OK) {
    fail("audit");
  }
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (!g_context && radvor_context_create(nullptr, &g_context) < 0) {
    std::abort();
  }
  radvor_delaunay* d = nullptr;
  if (radvor_delaunay_create(g_context, &d) < 0) {
    fail("create");
  }
  ++g_counters.runs;
  Program program{data, size};
  double xy[2];
  std::uint32_t hint = RADVOR_NONE;
  for (int step = 0; step < 400 && !program.ended(); ++step) {
    const std::uint8_t operation = program.byte() % 16;
    const std::uint32_t bound = radvor_delaunay_vertex_bound(d) + 1;
    switch (operation) {
      case 0:
      case 1:
      case 2:
      case 3: {
        program.point(xy);
        std::uint32_t vertex;
        if (worked(d, radvor_delaunay_insert(d, xy[0], xy[1], &vertex))) {
          ++g_counters.inserted;
        }
        break;
      }
      case 4: {
        double many[2 * 16];
        const std::uint32_t count = program.byte() % 16;
        for (std::uint32_t i = 0; i < count; ++i) {
          program.point(xy);
          many[2 * i] = xy[0];
          many[2 * i + 1] = xy[1];
        }
        std::uint32_t ids[16];
        if (worked(d, radvor_delaunay_insert_many(d, many, count, ids))) {
          g_counters.inserted += count;
          for (std::uint32_t i = 0; i < count; ++i) {
            if (radvor_delaunay_position(d, ids[i], xy) < 0 || xy[0] != many[2 * i] || xy[1] != many[2 * i + 1]) {
              fail("insert_many gave another point's id");
            }
          }
        }
        break;
      }
      case 5:
      case 6:
        g_counters.removed += worked(d, radvor_delaunay_remove(d, program.byte() % bound));
        break;
      case 7:
      case 8: {
        const std::uint32_t a = program.byte() % bound, b = program.byte() % bound;
        const std::uint32_t choice = program.byte();
        const bool split = (choice & 8) != 0;
        if (worked(d, radvor_delaunay_constrain_as(d, a, b, 1u << (choice % 3), split))) {
          ++(split ? g_counters.crossed : g_counters.constrained);
        } else {
          ++g_counters.refused;
        }
        break;
      }
      case 9: {
        const std::uint32_t a = program.byte() % bound, b = program.byte() % bound;
        g_counters.freed += worked(d, radvor_delaunay_unconstrain(d, a, b));
        break;
      }
      case 10: {
        const std::uint32_t a = program.byte() % bound, b = program.byte() % bound;
        double from[2], to[2];
        if (radvor_delaunay_position(d, a, from) >= 0 && radvor_delaunay_position(d, b, to) >= 0) {
          const double share = program.byte() / 256.0,
                       beside = std::ldexp(program.byte() - 128.0, -program.byte() % 60);
          g_counters.split += worked(d, radvor_delaunay_split(d, a, b, from[0] + share * (to[0] - from[0]),
                                                              from[1] + share * (to[1] - from[1]) + beside, nullptr));
        }
        break;
      }
      case 11: {
        const std::uint32_t first = program.byte() % bound;
        double values[8];
        const std::uint32_t count = program.byte() % 9;
        for (std::uint32_t i = 0; i < count; ++i) {
          const std::uint8_t value = program.byte();
          values[i] = value == 255 ? NAN : value % 8;
        }
        worked(d, radvor_delaunay_set_values(d, values, first, count));
        break;
      }
      case 12:
        if (worked(d, radvor_delaunay_realign(d))) {
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
      default:
        if (program.byte() % 2) {
          g_counters.marked += worked(d, radvor_delaunay_mark_domain(d));
        } else if (bound > 1) {
          const std::uint32_t vertex = program.byte() % bound;
          std::uint32_t sectors = 0;
          worked(d, radvor_delaunay_bounded_cell(d, vertex, 0, &sectors, nullptr, nullptr, nullptr, nullptr));
          worked(d, radvor_delaunay_cell(d, vertex, nullptr, 0, nullptr, nullptr, nullptr, nullptr));
        }
    }
  }
  audit(d);
  radvor_delaunay_destroy(d);
  return 0;
}
