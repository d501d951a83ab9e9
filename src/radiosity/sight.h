// What a receiver sees of a light source: all of it, none, or a part. Where neighbours differ in this, a shadow's edge
// runs between them.
#pragma once

#include <cstdint>

#include "base/hash.h"

namespace radvor {

struct Sight {
  bool open = false;    ///< something of it is seen
  bool hidden = false;  ///< something of it is hidden; neither: it lies under the horizon, or faces away

  void add(const Sight& other) {
    open = open || other.open;
    hidden = hidden || other.hidden;
  }
};

/// The sights of many sources in one number, of sources in a fixed order.
inline std::uint64_t with_sight(std::uint64_t sights, const Sight& sight) {
  return hash(sights, (sight.open ? 1u : 0u) | (sight.hidden ? 2u : 0u));
}

}  // namespace radvor
