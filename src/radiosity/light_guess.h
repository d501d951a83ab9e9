// What a receiver gets from all sources, guessed in a few microseconds: for a solution that is shown before the sources
// have shone on it. Nothing that stays is made of it.
#pragma once

#include <memory_resource>
#include <vector>

#include "radiosity/direct_light.h"
#include "radiosity/receiver.h"
#include "radiosity/tracer.h"

namespace radvor {

/// One per task.
class LightGuess {
 public:
  LightGuess(const DirectLight& light, std::pmr::memory_resource* memory) : light_(light), aims_(memory) {}

  /// Of surfaces that emit and are near exactly what there is. Of the others, those that would give most are asked by
  /// one ray each whether they are seen, a packet at most; of what is left the same share is taken as seen.
  Color at(const Receiver& receiver, Tracer& tracer);

 private:
  const DirectLight& light_;
  std::pmr::vector<DirectLight::Aim> aims_;
};

}  // namespace radvor
