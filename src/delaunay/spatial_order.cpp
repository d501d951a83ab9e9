// Hilbert keys, a radix sort, and finer keys where many points share one.
#include "delaunay/spatial_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "base/hash.h"

namespace radvor::delaunay {

namespace {

struct Keyed {
  std::uint32_t key;
  std::uint32_t index;
};

struct Box {
  Vec2 low, high;
};

constexpr std::uint32_t k_side = 1u << 16;    // cells along one side of the curve's square
constexpr std::size_t k_small_sort = 256;     // below: std::sort
constexpr std::size_t k_most_in_a_cell = 16;  // above: a curve of its own

// Where the cell (x, y) comes along a Hilbert curve of 2^16 x 2^16 cells.
std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y) {
  std::uint32_t key = 0;
  for (std::uint32_t s = k_side / 2; s > 0; s /= 2) {
    const std::uint32_t right = (x & s) != 0;
    const std::uint32_t upper = (y & s) != 0;
    key = (key << 2) | ((3 * right) ^ upper);
    if (upper == 0) {
      if (right == 1) {
        x = k_side - 1 - x;
        y = k_side - 1 - y;
      }
      std::swap(x, y);
    }
  }
  return key;
}

Box bounds(std::span<const Vec2> points, std::span<const Keyed> some) {
  Box box{points[some[0].index], points[some[0].index]};
  for (const Keyed& entry : some) {
    box.low = glm::min(box.low, points[entry.index]);
    box.high = glm::max(box.high, points[entry.index]);
  }
  return box;
}

void set_keys(std::span<const Vec2> points, std::span<Keyed> some, const Box& box) {
  const Vec2 size = box.high - box.low;
  const double longest = std::max(size.x, size.y);
  const double scale = longest > 0 ? (k_side - 0.5) / longest : 0;
  for (Keyed& entry : some) {
    const Vec2 at = (points[entry.index] - box.low) * scale;
    entry.key = hilbert_key(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y));
  }
}

void sort_by_key(std::span<Keyed> some, std::span<Keyed> scratch) {
  const auto less = [](const Keyed& a, const Keyed& b) {
    return a.key < b.key || (a.key == b.key && a.index < b.index);
  };
  if (some.size() < k_small_sort) {
    std::sort(some.begin(), some.end(), less);
    return;
  }
  // Least significant digit first, 11 bits a pass, stable; an odd number of passes ends in scratch.
  constexpr std::uint32_t k_bits = 11, k_passes = 3;
  std::array<std::array<std::uint32_t, 1u << k_bits>, k_passes> counts{};
  const auto digit = [](std::uint32_t key, std::uint32_t pass) {
    return (key >> (pass * k_bits)) & ((1u << k_bits) - 1);
  };
  for (const Keyed& entry : some) {
    for (std::uint32_t pass = 0; pass < k_passes; ++pass) {
      ++counts[pass][digit(entry.key, pass)];
    }
  }
  std::span<Keyed> from = some, to = scratch.subspan(0, some.size());
  for (std::uint32_t pass = 0; pass < k_passes; ++pass) {
    std::uint32_t start = 0;
    for (std::uint32_t& count : counts[pass]) {
      start += std::exchange(count, start);
    }
    for (const Keyed& entry : from) {
      to[counts[pass][digit(entry.key, pass)]++] = entry;
    }
    std::swap(from, to);
  }
  std::copy(from.begin(), from.end(), some.begin());
}

// Runs of one key are sorted along curves through their own bounding boxes.
void sort_along_curve(std::span<const Vec2> points, std::span<Keyed> all, std::span<Keyed> scratch,
                      std::pmr::memory_resource* memory) {
  std::pmr::vector<std::span<Keyed>> pending(memory);
  pending.push_back(all);
  while (!pending.empty()) {
    const std::span<Keyed> some = pending.back();
    pending.pop_back();
    const Box box = bounds(points, some);
    if (box.low == box.high) {
      continue;
    }
    set_keys(points, some, box);
    sort_by_key(some, scratch);
    for (std::size_t begin = 0, end = 0; begin < some.size(); begin = end) {
      for (end = begin + 1; end < some.size() && some[end].key == some[begin].key; ++end) {
      }
      if (end - begin > k_most_in_a_cell && end - begin < some.size()) {
        pending.push_back(some.subspan(begin, end - begin));
      }
    }
  }
}

}  // namespace

void spatial_order(std::span<const Vec2> points, std::pmr::vector<std::uint32_t>& order,
                   std::pmr::memory_resource* memory) {
  const std::size_t count = points.size();
  // Round r gets the points whose hash has r leading zeros, at most as many rounds as leave a few points in the first.
  const auto last_round = static_cast<std::uint32_t>(std::max(0, static_cast<int>(std::bit_width(count)) - 6));
  const auto round_of = [&](std::size_t index) {
    const auto zeros = static_cast<std::uint32_t>(std::countl_zero(mix(index + 0x9e3779b97f4a7c15u)));
    return last_round - std::min(zeros, last_round);  // 0 comes first
  };
  {
    std::pmr::vector<Keyed> entries(count, memory), scratch(count, memory);
    std::array<std::size_t, 66> starts{};
    for (std::size_t i = 0; i < count; ++i) {
      ++starts[round_of(i) + 1];
    }
    for (std::size_t r = 1; r < starts.size(); ++r) {
      starts[r] += starts[r - 1];
    }
    std::array<std::size_t, 66> next = starts;
    for (std::size_t i = 0; i < count; ++i) {
      entries[next[round_of(i)]++].index = static_cast<std::uint32_t>(i);
    }
    for (std::uint32_t r = 0; r <= last_round; ++r) {
      if (starts[r + 1] > starts[r]) {
        sort_along_curve(points, std::span(entries).subspan(starts[r], starts[r + 1] - starts[r]), scratch, memory);
      }
    }
    order.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      order[i] = entries[i].index;
    }
  }
}

}  // namespace radvor::delaunay
