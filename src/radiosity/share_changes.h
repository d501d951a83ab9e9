// What became of the shares of a surface that was refined.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "surface/surface.h"

namespace radvor {

struct ShareChanges {
  std::pmr::vector<std::uint32_t> now;     ///< of each old share: its number, or that of the one in its place
  std::pmr::vector<std::uint8_t> divided;  ///< of each new one: it is a corner of a triangle that was not there
};

/// before: the old shares; sites_before: the site of each old sample; samples_now: the number of each old sample,
/// k_none where it is no more. surface: as it is now.
ShareChanges follow_shares(std::span<const Share> before, std::span<const std::uint32_t> sites_before,
                           std::span<const std::uint32_t> samples_now, const Surface& surface, Host& host);

}  // namespace radvor
