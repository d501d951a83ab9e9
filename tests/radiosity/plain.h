// A plain of 2 x 2 about the origin, facing up, with thousands of samples: what lights are put on in tests.
#pragma once

#include "rooms.h"
#include "test_bake.h"

namespace radvor {

inline TestBake plain() {
  SceneBuilder builder;
  builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, builder.material(Color(0.5)));
  BakeOptions options;
  options.spacing.patch_spacing = 0.1;
  options.spacing.element_levels = 0;
  return TestBake(builder.take(), options, 1);
}

}  // namespace radvor
