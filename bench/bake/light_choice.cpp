#include "light_choice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace bench {

LightChoice::LightChoice(std::vector<ChoosableEmitter> emitters, const glm::vec3& low, const glm::vec3& high)
    : emitters_(std::move(emitters)), low_(low) {
  const glm::vec3 size = high - low;
  cell_ = std::max({size.x, size.y, size.z}) / static_cast<float>(k_cells);
  std::size_t total = 1;
  for (int axis = 0; axis < 3; ++axis) {
    counts_[static_cast<std::size_t>(axis)] = std::max(1, static_cast<int>(std::ceil(size[axis] / cell_)));
    total *= static_cast<std::size_t>(counts_[static_cast<std::size_t>(axis)]);
  }
  sums_.resize(total);
}

const std::vector<float>& LightChoice::sums_at(const glm::vec3& position) {
  glm::vec3 centre;
  std::size_t index = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int count = counts_[static_cast<std::size_t>(axis)];
    const int cell = std::clamp(static_cast<int>((position[axis] - low_[axis]) / cell_), 0, count - 1);
    centre[axis] = low_[axis] + (static_cast<float>(cell) + 0.5f) * cell_;
    index = index * static_cast<std::size_t>(count) + static_cast<std::size_t>(cell);
  }
  std::vector<float>& sums = sums_[index];
  if (sums.empty()) {
    const float reach = std::sqrt(3.0f) * cell_;  // a cell's diagonal: no emitter is taken to be nearer
    float sum = 0;
    for (const ChoosableEmitter& emitter : emitters_) {
      const glm::vec3 way = centre - emitter.centre;
      // What no point of the cell sees is left out, for that is exact; all else keeps a share.
      const bool behind = glm::dot(way, emitter.normal) < -reach;
      sum += behind ? 0 : emitter.flux / std::max(glm::dot(way, way), reach * reach);
      sums.push_back(sum);
    }
    if (sum <= 0) {  // nothing shines here: any choice is as good
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = static_cast<float>(i + 1);
      }
      sum = sums.back();
    }
    for (float& value : sums) {
      value /= sum;
    }
  }
  return sums;
}

LightChoice::Choice LightChoice::choose(const glm::vec3& position, float u) {
  const std::vector<float>& sums = sums_at(position);
  const auto found = std::upper_bound(sums.begin(), sums.end() - 1, u);
  const float before = found == sums.begin() ? 0 : *(found - 1);
  const float probability = *found - before;
  const float rest = probability > 0 ? std::clamp((u - before) / probability, 0.0f, 1.0f) : 0;
  return {static_cast<std::uint32_t>(found - sums.begin()), probability, rest};
}

float LightChoice::probability(const glm::vec3& position, std::uint32_t emitter) {
  const std::vector<float>& sums = sums_at(position);
  return sums[emitter] - (emitter > 0 ? sums[emitter - 1] : 0);
}

}  // namespace bench
