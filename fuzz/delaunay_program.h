// The bytes of a fuzzer as a program: operations' numbers and points from a small lattice (ties, collinear runs), from
// integer points of a circle, or straight from the bits.
#pragma once

#include <cstdint>
#include <cstring>

namespace radvor::fuzz {

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

inline void point_of_great_circle(std::uint32_t index, double (&xy)[2]) {
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

}  // namespace radvor::fuzz
