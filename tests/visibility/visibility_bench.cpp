// Million shadow rays a second on one core, by how they are packed: one receiver to many points of a light, the same
// rays one at a time, and neighbouring receivers to one point. In a room of boxes, from 36 triangles to 240,000.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "base/floating_point.h"
#include "base/hash.h"
#include "base/host.h"
#include "visibility/embree_visibility.h"

namespace {

using namespace radvor;

constexpr std::size_t k_receivers = 4096;
constexpr std::size_t k_points = 16;

double random(std::uint64_t a, std::uint64_t b) {
  return to_unit(hash(a, b));
}

void add_box(const Vec3& low, const Vec3& high, std::vector<Vec3>& positions, std::vector<std::uint32_t>& corners) {
  static constexpr std::uint32_t k_faces[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                                2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  const auto first = static_cast<std::uint32_t>(positions.size());
  for (int corner = 0; corner < 8; ++corner) {
    positions.emplace_back(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z);
  }
  std::transform(std::begin(k_faces), std::end(k_faces), std::back_inserter(corners),
                 [&](std::uint32_t corner) { return first + corner; });
}

// A room of 10 x 10 x 4 with boxes on its floor, receivers on the floor in rows of neighbours, a light of 1 x 1 at the
// ceiling.
struct Room {
  Host host{HostMemory(nullptr, nullptr, nullptr), Log(nullptr, nullptr),
            Jobs(1, nullptr, nullptr, std::pmr::get_default_resource())};
  EmbreeLibrary library{""};
  std::vector<Vec3> receivers;
  std::vector<Vec3> light;
  std::unique_ptr<EmbreeVisibility> visibility;

  explicit Room(std::int64_t triangles) {
    std::vector<Vec3> positions;
    std::vector<std::uint32_t> corners;
    add_box(Vec3(0, 0, 0), Vec3(10, 10, 4), positions, corners);
    const std::int64_t boxes = triangles / 12 - 1;
    const double size = std::min(2.0, 10 / std::sqrt(static_cast<double>(boxes)));
    for (std::int64_t box = 0; box < boxes; ++box) {
      const auto seed = static_cast<std::uint64_t>(box);
      const Vec3 low(8 * random(seed, 0), 8 * random(seed, 1), 2 * random(seed, 2));
      const Vec3 extent(size * random(seed, 3), size * random(seed, 4), size * random(seed, 5));
      add_box(low, low + extent, positions, corners);
    }
    visibility = std::make_unique<EmbreeVisibility>(library, Occluders{positions, corners}, host);
    const double lift = visibility->lift();
    for (std::size_t i = 0; i < k_receivers; ++i) {
      receivers.emplace_back(10 * random(i / 16, 6), 10 * random(i / 16, 7) + 0.01 * static_cast<double>(i % 16), lift);
    }
    for (std::size_t i = 0; i < k_points; ++i) {
      const auto column = static_cast<double>(i % 4), row = static_cast<double>(i / 4);
      light.emplace_back(4.5 + (column + 0.5) / 4, 4.5 + (row + 0.5) / 4, 4 - lift);
    }
  }
};

template <class Trace>
void run(benchmark::State& state, const Trace& trace) {
  const Room room(state.range(0));
  std::vector<std::uint8_t> blocked(k_receivers * k_points);
  const FloatingPointGuard guard(Denormals::flush);
  for (auto _ : state) {
    trace(room, blocked.data());
    benchmark::DoNotOptimize(blocked.data());
  }
  const auto rays = static_cast<double>(blocked.size());
  state.counters["rays/s"] = benchmark::Counter(rays, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["blocked"] = static_cast<double>(std::count(blocked.begin(), blocked.end(), 1)) / rays;
}

void one_receiver_to_16_points(benchmark::State& state) {
  run(state, [](const Room& room, std::uint8_t* blocked) {
    for (std::size_t i = 0; i < k_receivers; ++i) {
      room.visibility->blocked_from(room.receivers[i], room.light, blocked + i * k_points);
    }
  });
}

void one_ray_at_a_time(benchmark::State& state) {
  run(state, [](const Room& room, std::uint8_t* blocked) {
    for (std::size_t i = 0; i < k_receivers; ++i) {
      for (std::size_t point = 0; point < k_points; ++point) {
        room.visibility->blocked_from(room.receivers[i], {&room.light[point], 1}, blocked + i * k_points + point);
      }
    }
  });
}

void one_receiver_to_4_points(benchmark::State& state) {
  run(state, [](const Room& room, std::uint8_t* blocked) {
    for (std::size_t i = 0; i < k_receivers; ++i) {
      for (std::size_t point = 0; point < k_points; point += 4) {
        room.visibility->blocked_from(room.receivers[i], {&room.light[point], 4}, blocked + i * k_points + point);
      }
    }
  });
}

void sixteen_neighbours_to_one_point(benchmark::State& state) {
  run(state, [](const Room& room, std::uint8_t* blocked) {
    Sightline segments[16];
    for (std::size_t i = 0; i < k_receivers; i += 16) {
      for (std::size_t point = 0; point < k_points; ++point) {
        for (std::size_t neighbour = 0; neighbour < 16; ++neighbour) {
          segments[neighbour] = {room.receivers[i + neighbour], room.light[point]};
        }
        room.visibility->blocked(segments, blocked + i * k_points + point * 16);
      }
    }
  });
}

void first_hits(benchmark::State& state) {
  run(state, [](const Room& room, std::uint8_t* blocked) {
    for (std::size_t i = 0; i < k_receivers; ++i) {
      for (std::size_t point = 0; point < k_points; ++point) {
        const Vec3 direction = room.light[point] - room.receivers[i];
        blocked[i * k_points + point] = room.visibility->first_hit(room.receivers[i], direction).distance < 1;
      }
    }
  });
}

#define RADVOR_TRIANGLES Arg(36)->Arg(12'000)->Arg(240'000)->Unit(benchmark::kMillisecond)
BENCHMARK(one_receiver_to_16_points)->RADVOR_TRIANGLES;
BENCHMARK(one_receiver_to_4_points)->RADVOR_TRIANGLES;
BENCHMARK(one_ray_at_a_time)->RADVOR_TRIANGLES;
BENCHMARK(sixteen_neighbours_to_one_point)->RADVOR_TRIANGLES;
BENCHMARK(first_hits)->RADVOR_TRIANGLES;

}  // namespace

BENCHMARK_MAIN();
