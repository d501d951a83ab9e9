#include "surface/marked_squares.h"

#include <algorithm>

#include "base/hash.h"

namespace radvor {

namespace {

std::uint64_t hash_of(const MarkedSquares::Square& block) {
  return hash(std::uint64_t{block.facet} << 8 | block.level, static_cast<std::uint64_t>(block.x), block.y);
}

bool is_same(const MarkedSquares::Square& a, const MarkedSquares::Square& b) {
  return a.facet == b.facet && a.level == b.level && a.x == b.x && a.y == b.y;
}

}  // namespace

std::uint32_t MarkedSquares::find(const Square& square) const {
  const Square at{square.facet, square.level, square.x >> k_side_bits, square.y >> k_side_bits};
  return table_.find(hash_of(at), [&](std::uint32_t k) { return is_same(blocks_[k].at, at); });
}

MarkedSquares::Bits MarkedSquares::block_of(const Square& square) const {
  const std::uint32_t block = find(square);
  return block == IndexTable::k_absent ? Bits{} : blocks_[block].bits;
}

void MarkedSquares::set(std::uint32_t block, const Bits& bits) {
  undone_.push_back({block, blocks_[block].bits});
  blocks_[block].bits = bits;
}

void MarkedSquares::set_centre(const Square& square) {
  const std::uint32_t block = find(square);
  if (!contains(square)) {
    return;
  }
  const Bits now = blocks_[block].bits;
  set(block, {now.marked, now.centres | bit(square.x, square.y)});
}

bool MarkedSquares::mark(const Square& first, const Square& last) {
  bool some = false;
  for (std::int64_t y = first.y >> k_side_bits; y <= last.y >> k_side_bits; ++y) {
    for (std::int64_t x = first.x >> k_side_bits; x <= last.x >> k_side_bits; ++x) {
      // The box's part of this block: its columns in each of its rows.
      const auto within = [](std::int64_t coordinate, std::int64_t block) {
        return std::clamp<std::int64_t>(coordinate - block * k_side, 0, k_side - 1);
      };
      std::uint64_t mask = 0;
      for (std::int64_t row = within(first.y, y); row <= within(last.y, y); ++row) {
        const std::int64_t from = within(first.x, x), to = within(last.x, x);
        mask |= ((std::uint64_t{2} << to) - (std::uint64_t{1} << from)) << (k_side * row);
      }
      const Square at{first.facet, first.level, x, y};
      const auto next = static_cast<std::uint32_t>(blocks_.size());
      const std::uint32_t block =
          table_.find_or_insert(hash_of(at), next, [&](std::uint32_t k) { return is_same(blocks_[k].at, at); });
      if (block == next) {
        blocks_.push_back({at, {}});
      }
      const Bits& now = blocks_[block].bits;
      if ((mask & ~now.marked) != 0) {
        set(block, {now.marked | mask, now.centres});
        some = true;
      }
    }
  }
  return some;
}

void MarkedSquares::undo() {
  for (; !undone_.empty(); undone_.pop_back()) {
    blocks_[undone_.back().block].bits = undone_.back().bits;
  }
}

}  // namespace radvor
