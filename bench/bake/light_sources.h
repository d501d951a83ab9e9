// Lights as the path tracer samples them: emitting triangles by area, chosen by what they could give; points and suns
// one by one at the receivers and by flux at later vertices; the sky by the rays that leave the scene.
#pragma once

#include <radvor.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "light_choice.h"
#include "traced_scene.h"

namespace bench {

/// A segment to a light, and the irradiance that comes along it where nothing is in the way.
struct LightSample {
  Ray segment;
  glm::vec3 irradiance{0.0f};
};

class LightSources {
 public:
  /// Throws where the scene has a light that this tracer doesn't know (spot lights, skies with an image).
  LightSources(const TracedScene& scene, const std::vector<radvor_light_desc>& lights, float scene_size);

  bool any_emitters() const { return !emitters_.empty(); }
  std::size_t punctual_count() const { return punctual_.size(); }
  /// A point or a direction without size.
  bool is_sharp(std::size_t light) const {
    return !(punctual_[light].light.radius > 0) && !(punctual_[light].light.angle > 0);
  }
  glm::vec3 sky() const { return sky_; }

  /// Of an emitter chosen by flux, over the density of that choice and weighted against sampling by cosine.
  LightSample sample_emitters(const glm::vec3& position, const glm::vec3& normal, float u, float v) const;
  /// All of one light; u, v choose the point on a luminous sphere or sun.
  LightSample sample_punctual(std::size_t light, const glm::vec3& position, const glm::vec3& normal, float u,
                              float v) const;
  /// The same of one chosen by flux, over the probability of the choice.
  LightSample sample_any_punctual(const glm::vec3& position, const glm::vec3& normal, float choice, float u,
                                  float v) const;

  /// Weight of a ray sampled by cosine that met an emitter from a receiver, against sampling the emitter itself: the
  /// power heuristic of E. Veach and L. Guibas, "Optimally combining sampling techniques" (1995).
  float weight_of_hit(const glm::vec3& from, const glm::vec3& normal, const Hit& hit) const;

 private:
  struct Emitter {
    std::uint32_t triangle;
    glm::vec3 corner, edge_1, edge_2, normal, emission;
    float area;
  };
  struct Punctual {
    radvor_light_desc light;
    float probability;
  };

  /// Of directions: that of a point on the emitter, as its distance and tilt change it.
  float density_towards(const glm::vec3& from, const glm::vec3& to, const Emitter& emitter, float probability) const;

  const TracedScene& scene_;
  std::vector<Emitter> emitters_;
  mutable std::optional<LightChoice> choice_;       ///< fills its cells as it is asked
  std::vector<std::uint32_t> emitter_of_triangle_;  ///< k_nothing where it does not emit
  std::vector<Punctual> punctual_;
  glm::vec3 sky_{0.0f};
  float far_;  ///< beyond the scene
};

}  // namespace bench
