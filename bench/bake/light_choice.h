// Which of many emitters to sample from where: in proportion to what each could give a cell of a coarse grid, so that
// in a house of many rooms the lamps nearby are asked more often. Cells are filled when first asked.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace bench {

struct ChoosableEmitter {
  glm::vec3 centre, normal;
  float flux;
};

class LightChoice {
 public:
  /// Positions asked for lie in the box low ... high, or are taken to its nearest cell.
  LightChoice(std::vector<ChoosableEmitter> emitters, const glm::vec3& low, const glm::vec3& high);

  struct Choice {
    std::uint32_t emitter;
    float probability;
    float rest;  ///< of u, again of 0 to 1
  };
  Choice choose(const glm::vec3& position, float u);
  float probability(const glm::vec3& position, std::uint32_t emitter);

 private:
  static constexpr int k_cells = 16;  // along the longest side

  const std::vector<float>& sums_at(const glm::vec3& position);

  std::vector<ChoosableEmitter> emitters_;
  glm::vec3 low_;
  float cell_;
  std::array<int, 3> counts_{};
  std::vector<std::vector<float>> sums_;  ///< running sums of the probabilities, for each cell
};

}  // namespace bench
