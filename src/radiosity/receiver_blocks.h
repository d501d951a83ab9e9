// Receivers in blocks that lie close together: a block is a task, and its rays meet the same triangles.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/host.h"
#include "radiosity/receiver.h"
#include "surface/surface.h"

namespace radvor {

/// Samples sorted by facet and side, and along a Z-order curve in its plane, cut into blocks of k_size.
class ReceiverBlocks {
 public:
  static constexpr std::uint32_t k_size = 64;

  /// Of the given samples; receivers: of all.
  ReceiverBlocks(const Surface& surface, std::span<const Receiver> receivers, std::span<const std::uint32_t> samples,
                 Host& host);

  std::uint32_t count() const { return static_cast<std::uint32_t>((order_.size() + k_size - 1) / k_size); }
  /// The samples of a block.
  std::span<const std::uint32_t> block(std::uint32_t index) const {
    const std::size_t begin = std::size_t{index} * k_size;
    return std::span(order_).subspan(begin, std::min<std::size_t>(k_size, order_.size() - begin));
  }

 private:
  std::pmr::vector<std::uint32_t> order_;
};

}  // namespace radvor
