// Receivers in blocks that lie close together: what is true of a block need not be found out for each receiver.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "base/host.h"
#include "radiosity/occluder_tree.h"
#include "radiosity/receiver.h"
#include "radiosity/shooting_tree.h"
#include "surface/surface.h"

namespace radvor {

/// Samples sorted by facet and side, and along a Z-order curve in its plane, cut into blocks of k_size.
class ReceiverBlocks {
 public:
  static constexpr std::uint32_t k_size = 64;

  ReceiverBlocks(const Surface& surface, std::span<const Receiver> receivers, Host& host);

  std::uint32_t count() const { return static_cast<std::uint32_t>((order_.size() + k_size - 1) / k_size); }
  /// The samples of a block.
  std::span<const std::uint32_t> block(std::uint32_t index) const;

  /// For each root, 1 where nothing can stand between it and any receiver of the block; empty where the block does not
  /// lie in one plane.
  void find_clear_roots(std::uint32_t block, const ShootingTree& tree, std::span<const std::uint32_t> roots,
                        const OccluderTree& occluders, double lift, std::pmr::vector<std::uint8_t>& clear) const;

 private:
  struct Plane {
    std::array<Vec3, 4> rectangle;  // about the lifted receivers, counter-clockwise about the normal
    Vec3 normal;
  };

  std::pmr::vector<std::uint32_t> order_;
  std::pmr::vector<std::optional<Plane>> planes_;
};

}  // namespace radvor
