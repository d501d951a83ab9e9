// What became of the shares of a surface that was refined.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "base/raw_vector.h"
#include "surface/surface.h"

namespace radvor {

struct ShareChanges {
  std::pmr::vector<std::uint32_t> now;     ///< of each old share: its number, or that of the one in its place
  std::pmr::vector<std::uint8_t> divided;  ///< of each new one: it is a corner of a triangle that was not there
};

/// The same over any number of refinements: what became of the shares that there were before the first of them.
class ShareMoves {
 public:
  ShareMoves(const ShareChanges& changes, Host& host);
  /// One more refinement.
  void follow(const ShareChanges& changes, Host& host);

  std::uint32_t now(std::uint32_t share) const { return moves_[share] & ~k_divided; }
  bool is_divided(std::uint32_t share) const { return (moves_[share] & k_divided) != 0; }

 private:
  static constexpr std::uint32_t k_divided = std::uint32_t{1} << 31;
  static std::uint32_t move(std::uint32_t share, const ShareChanges& changes);

  RawVector<std::uint32_t> moves_;  // per old share: its number now, and whether it was divided on the way
};

/// What there is to know of shares once they are no more.
struct SharesBefore {
  struct Share {
    std::uint32_t sample, facet;
    bool back;
  };

  SharesBefore(const Surface& surface, Host& host);

  RawVector<Share> shares;
  RawVector<std::uint32_t> sites;  ///< of each sample
};

/// samples_now: the number of each old sample, k_none where it is no more. surface: as it is now.
ShareChanges follow_shares(const SharesBefore& before, std::span<const std::uint32_t> samples_now,
                           const Surface& surface, Host& host);

}  // namespace radvor
