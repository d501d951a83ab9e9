#include "radiosity/sky.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/strata.h"

namespace radvor {

namespace {

constexpr int k_max_side = 64;

}  // namespace

Sky::Sky(double tolerance, std::pmr::memory_resource* memory) : coarse_(memory), fine_(memory) {
  side_ = std::clamp(static_cast<int>(std::lround(32 * std::sqrt(0.02 / tolerance))), 12, k_max_side);
  for (int i = 0; i < side_; ++i) {
    for (int j = 0; j < side_; ++j) {
      coarse_.push_back(square_to_disk((2 * i + 1.0) / side_ - 1, (2 * j + 1.0) / side_ - 1));
      for (int part = 0; part < 4; ++part) {
        fine_.push_back(square_to_disk((2 * i + 0.5 + part / 2) / side_ - 1, (2 * j + 0.5 + part % 2) / side_ - 1));
      }
    }
  }
}

double Sky::open_share(const Receiver& receiver, Tracer& tracer, double far) const {
  const Basis basis(receiver.normal);
  const std::size_t count = coarse_.size();
  std::array<Vec3, 256> targets;
  std::array<std::uint8_t, k_max_side * k_max_side> blocked;
  for (std::size_t begin = 0; begin < count; begin += targets.size()) {
    const std::size_t size = std::min(targets.size(), count - begin);
    for (std::size_t k = 0; k < size; ++k) {
      targets[k] = receiver.lifted + far * basis.on_hemisphere(coarse_[begin + k]);
    }
    tracer.blocked_from(receiver.lifted, std::span(targets.data(), size), &blocked[begin]);
  }

  // Strata on the edge between open and closed are halved both ways; the others count whole.
  const auto at = [&](int i, int j) { return blocked[static_cast<std::size_t>(i * side_ + j)]; };
  double open = 0;
  std::size_t pending = 0;
  const auto flush = [&] {
    std::array<std::uint8_t, 256> hidden;
    tracer.blocked_from(receiver.lifted, std::span(targets.data(), pending), hidden.data());
    for (std::size_t k = 0; k < pending; ++k) {
      open += hidden[k] ? 0 : 0.25;
    }
    pending = 0;
  };
  for (int i = 0; i < side_; ++i) {
    for (int j = 0; j < side_; ++j) {
      const std::uint8_t own = at(i, j);
      const bool edge = (i > 0 && at(i - 1, j) != own) || (i + 1 < side_ && at(i + 1, j) != own) ||
                        (j > 0 && at(i, j - 1) != own) || (j + 1 < side_ && at(i, j + 1) != own);
      if (!edge) {
        open += own ? 0 : 1;
        continue;
      }
      for (int part = 0; part < 4; ++part) {
        const std::size_t index = static_cast<std::size_t>(4 * (i * side_ + j) + part);
        targets[pending++] = receiver.lifted + far * basis.on_hemisphere(fine_[index]);
      }
      if (pending == targets.size()) {
        flush();
      }
    }
  }
  flush();
  return open / static_cast<double>(count);
}

}  // namespace radvor
