// Rounds chosen by a hash, Hilbert keys, a radix sort, and finer keys where many points share one.
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

constexpr std::uint32_t k_bits = 12;          // of a cell's number along one side of the curve's square
constexpr std::size_t k_small_sort = 1024;    // below: std::sort
constexpr std::size_t k_most_in_a_cell = 16;  // above: a curve of its own
constexpr std::uint32_t k_ratio_bits = 3;     // a round is 2^3 - 1 times as large as all before

// Four levels of the curve at once. A level's quarter is the whole curve, perhaps with x and y swapped and perhaps
// turned half round: two bits of state. Entry [state][x][y], four bits of x and y: 8 bits of key, and the next state
// above them.
constexpr std::array<std::uint16_t, 1024> make_curve() {
  std::array<std::uint16_t, 1024> curve{};
  for (std::uint32_t entry = 0; entry < 1024; ++entry) {
    std::uint32_t swapped = entry >> 9, turned = (entry >> 8) & 1, key = 0;
    for (std::uint32_t bit = 4; bit-- > 0;) {
      const std::uint32_t x = (entry >> (4 + bit)) & 1, y = (entry >> bit) & 1;
      const std::uint32_t right = (swapped ? y : x) ^ turned, upper = (swapped ? x : y) ^ turned;
      key = (key << 2) | ((3 * right) ^ upper);
      if (upper == 0) {
        turned ^= right;
        swapped ^= 1;
      }
    }
    curve[entry] = static_cast<std::uint16_t>(swapped << 9 | turned << 8 | key);
  }
  return curve;
}
constexpr std::array<std::uint16_t, 1024> k_curve = make_curve();

// Where the cell (x, y) comes along a Hilbert curve of 2^12 x 2^12 cells.
std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y) {
  std::uint32_t key = 0;
  std::uint32_t state = 0;
  for (std::uint32_t shift = k_bits; shift > 0;) {
    shift -= 4;
    const std::uint32_t entry = k_curve[state | ((x >> shift) & 15) << 4 | ((y >> shift) & 15)];
    key = key << 8 | (entry & 255);
    state = entry & 0x300;
  }
  return key;
}

// The curve's square over a box.
class Curve {
 public:
  explicit Curve(const Box& box) : low_(box.low) {
    const Vec2 size = box.high - box.low;
    const double longest = std::max(size.x, size.y);
    per_unit_ = longest > 0 ? ((1 << k_bits) - 0.5) / longest : 0;
  }
  std::uint32_t key(Vec2 point) const {
    const Vec2 at = (point - low_) * per_unit_;
    return hilbert_key(static_cast<std::uint32_t>(static_cast<std::int32_t>(at.x)),
                       static_cast<std::uint32_t>(static_cast<std::int32_t>(at.y)));
  }

 private:
  Vec2 low_;
  double per_unit_;
};

void sort_by_key(std::span<Keyed> some, std::span<Keyed> scratch) {
  const auto less = [](const Keyed& a, const Keyed& b) {
    return a.key < b.key || (a.key == b.key && a.index < b.index);
  };
  if (some.size() < k_small_sort) {
    std::sort(some.begin(), some.end(), less);
    return;
  }
  // Least significant digit first, stable, two passes.
  std::array<std::uint32_t, 1u << k_bits> low{}, high{};
  constexpr std::uint32_t k_mask = (1u << k_bits) - 1;
  for (const Keyed& entry : some) {
    ++low[entry.key & k_mask];
    ++high[entry.key >> k_bits];
  }
  std::uint32_t low_start = 0, high_start = 0;
  for (std::uint32_t digit = 0; digit <= k_mask; ++digit) {
    low_start += std::exchange(low[digit], low_start);
    high_start += std::exchange(high[digit], high_start);
  }
  for (const Keyed& entry : some) {
    scratch[low[entry.key & k_mask]++] = entry;
  }
  for (const Keyed& entry : scratch.subspan(0, some.size())) {
    some[high[entry.key >> k_bits]++] = entry;
  }
}

// Sorts by the keys that are there; runs of one key are sorted along curves through their own bounding boxes.
void sort_along_curve(std::span<const Vec2> points, std::span<Keyed> all, std::span<Keyed> scratch,
                      std::pmr::vector<std::span<Keyed>>& pending) {
  pending.push_back(all);
  while (!pending.empty()) {
    const std::span<Keyed> some = pending.back();
    pending.pop_back();
    sort_by_key(some, scratch);
    for (std::size_t begin = 0, end = 0; begin < some.size(); begin = end) {
      for (end = begin + 1; end < some.size() && some[end].key == some[begin].key; ++end) {
      }
      if (end - begin <= k_most_in_a_cell) {
        continue;
      }
      const std::span<Keyed> run = some.subspan(begin, end - begin);
      Box box{points[run[0].index], points[run[0].index]};
      for (const Keyed& entry : run) {
        box.low = glm::min(box.low, points[entry.index]);
        box.high = glm::max(box.high, points[entry.index]);
      }
      if (box.low != box.high) {
        const Curve curve(box);
        for (Keyed& entry : run) {
          entry.key = curve.key(points[entry.index]);
        }
        pending.push_back(run);
      }
    }
  }
}

}  // namespace

void spatial_order(std::span<const Vec2> points, std::pmr::vector<std::uint32_t>& order,
                   std::pmr::memory_resource* memory) {
  const std::size_t count = points.size();
  order.resize(count);
  // Where a hash has 3 r leading zeros comes in the r-th last round, at most as many rounds as leave a few points in
  // the first.
  const auto last_round =
      static_cast<std::uint32_t>(std::max(0, static_cast<int>(std::bit_width(count)) - 6)) / k_ratio_bits;
  const auto round_of = [&](std::size_t index) {
    const auto zeros = static_cast<std::uint32_t>(std::countl_zero(mix(index + 0x9e3779b97f4a7c15u)));
    return last_round - std::min(zeros / k_ratio_bits, last_round);  // 0 comes first
  };
  std::pmr::vector<Keyed> both(2 * count, memory);
  std::pmr::vector<std::span<Keyed>> pending(memory);
  const std::span<Keyed> entries = std::span(both).first(count), scratch = std::span(both).last(count);
  std::array<std::size_t, 24> starts{};
  Box box{points[0], points[0]};
  for (std::size_t i = 0; i < count; ++i) {
    ++starts[round_of(i) + 1];
    box.low = glm::min(box.low, points[i]);
    box.high = glm::max(box.high, points[i]);
  }
  for (std::size_t r = 1; r < starts.size(); ++r) {
    starts[r] += starts[r - 1];
  }
  std::array<std::size_t, 24> next = starts;
  const Curve curve(box);
  for (std::size_t i = 0; i < count; ++i) {
    entries[next[round_of(i)]++] = {curve.key(points[i]), static_cast<std::uint32_t>(i)};
  }
  for (std::uint32_t r = 0; r <= last_round; ++r) {
    if (starts[r + 1] > starts[r]) {
      sort_along_curve(points, entries.subspan(starts[r], starts[r + 1] - starts[r]), scratch, pending);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    order[i] = entries[i].index;
  }
}

}  // namespace radvor::delaunay
