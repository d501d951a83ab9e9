// Where light is gathered: a point on a surface, off every border, with the normal that shades it.
#pragma once

#include <cstdint>

#include "base/vector.h"

namespace radvor {

struct Receiver {
  Vec3 point;   ///< on the surface: form factors are taken here
  Vec3 lifted;  ///< off the surface by Visibility::lift(): rays start here
  Vec3 normal;  ///< unit shading normal
  /// How far light of emitting surfaces may be off, where that of the average receiver may by 1.
  double leeway = 1;
};

}  // namespace radvor
