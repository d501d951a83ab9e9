// Scenes for tests of refinement, which sites of them to raise, and what has to hold then.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "surface/made_surface.h"
#include "surface/solids.h"

namespace radvor::test {

/// One of the scenes that refinement is tested on.
using Make = Scene (*)();

inline Scene l_shaped() {
  SceneBuilder builder(heap());
  l_shaped_room(builder);
  return builder.take();
}
inline Scene smooth_cylinder() {
  SceneBuilder builder(heap());
  cylinder(builder, 24, 1.0, 1.0, true);
  return builder.take();
}
inline Scene slit_floor() {
  SceneBuilder builder(heap());
  floor_with_wall(builder);
  return builder.take();
}
inline Scene ring() {
  SceneBuilder builder(heap());
  std::mt19937 random(3);
  std::vector<Vec2> outer, inner;
  random_rings(random, 9, outer, inner);
  builder.prism(outer, inner, 0.7f);
  return builder.take();
}
inline Scene floor_of_one() {
  SceneBuilder builder(heap());
  builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  return builder.take();
}
inline constexpr Make k_scenes[] = {room, l_shaped, smooth_cylinder, slit_floor, ring, floor_of_one};

inline SurfaceOptions options(double spacing, std::uint32_t refinements, Lattice lattice = Lattice::hexagonal,
                              std::uint32_t element_levels = 0) {
  return {lattice, spacing, element_levels, std::ldexp(spacing, -static_cast<int>(element_levels + refinements))};
}

inline void expect_true(const MadeSurface& made) {
  audit(made);
  audit_cells(made);
  expect_balanced(made);
}

/// Random sites, mostly the latest, so that refinement goes deep somewhere.
inline std::vector<std::uint32_t> some_sites(const Surface& surface, std::size_t wanted, std::mt19937& random) {
  std::vector<std::uint32_t> sites;
  const auto count = static_cast<std::uint32_t>(surface.sites().size());
  for (std::size_t k = 0; k < wanted; ++k) {
    const auto of = k % 2 == 0 ? count : count / 5 + 1;
    sites.push_back(count - 1 - static_cast<std::uint32_t>(random()) % of);
  }
  return sites;
}

}  // namespace radvor::test
