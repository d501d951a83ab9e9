// Numbers that are the same with every compiler and standard library: the distributions of <random> are not, nor is the
// order in which arguments are evaluated, so that a vector of three random numbers needs a function of its own.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace radvor::test {

/// SplitMix64 (Steele, Lea, Flood 2014).
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  float between(float low, float high) { return low + (high - low) * (static_cast<float>(next() >> 40) * 0x1p-24f); }

  /// Each coordinate by itself.
  glm::vec3 vector_between(float low, float high) {
    glm::vec3 v;
    for (int axis = 0; axis < 3; ++axis) {
      v[axis] = between(low, high);
    }
    return v;
  }

 private:
  std::uint64_t state_;
};

}  // namespace radvor::test
