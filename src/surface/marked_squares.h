// Squares of facets' planes in which all sites, those to come as well, are of a level at least; a square's side is that
// level's spacing. They are marked by boxes of some fifty that overlap, so 8 x 8 squares are one record, a bit each.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "scene/index_table.h"

namespace radvor {

class MarkedSquares {
 public:
  struct Square {
    std::uint32_t facet;
    std::uint8_t level;
    std::int64_t x, y;
  };

  explicit MarkedSquares(std::pmr::memory_resource* memory) : table_(0, memory), blocks_(memory), undone_(memory) {}

  /// Nothing was ever marked.
  bool empty() const { return blocks_.empty(); }
  bool contains(const Square& square) const { return (block_of(square).marked & bit(square.x, square.y)) != 0; }
  /// Remembers that all that is ever to be marked about a square is marked; nothing where it is not marked itself.
  void set_centre(const Square& square);
  bool is_centre(const Square& square) const { return (block_of(square).centres & bit(square.x, square.y)) != 0; }

  /// Marks first to last on both axes, of one facet and level; whether one of them was not marked before.
  bool mark(const Square& first, const Square& last);

  /// What is marked from now on, undo() takes back; that a square is a centre, too.
  void begin_step() { undone_.clear(); }
  void undo();

 private:
  struct Bits {
    std::uint64_t marked = 0, centres = 0;  // row by row
  };
  struct Block {
    Square at;  // in blocks
    Bits bits;
  };
  struct Before {
    std::uint32_t block;
    Bits bits;
  };

  static constexpr int k_side_bits = 3;
  static constexpr std::int64_t k_side = 1 << k_side_bits;

  static std::uint64_t bit(std::int64_t x, std::int64_t y) {
    return std::uint64_t{1} << (k_side * (y & (k_side - 1)) + (x & (k_side - 1)));
  }
  std::uint32_t find(const Square& square) const;
  Bits block_of(const Square& square) const;
  void set(std::uint32_t block, const Bits& bits);

  IndexTable table_;  // blocks, by their place
  std::pmr::vector<Block> blocks_;
  std::pmr::vector<Before> undone_;  // of this step's changes, in their order
};

}  // namespace radvor
