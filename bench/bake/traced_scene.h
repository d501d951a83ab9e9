// The scene as the path tracer sees it: one array of triangles in Embree, and what a hit needs to know. The conventions
// are those of radvor.h: fronts alone emit and reflect, both sides block.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <type_traits>
#include <vector>

#include "scene_data.h"

namespace bench {

struct Hit {
  glm::vec3 position;
  glm::vec3 geometric_normal;  ///< unit, of the front
  glm::vec3 normal;            ///< unit, for shading
  glm::vec3 albedo;
  std::uint32_t triangle;
};

/// A ray, or a segment where its direction reaches to its end.
struct Ray {
  glm::vec3 origin, direction;
};

class TracedScene {
 public:
  static constexpr std::uint32_t k_nothing = RTC_INVALID_GEOMETRY_ID;
  static constexpr std::size_t k_packet = 16;

  explicit TracedScene(const bake::SceneData& scene);

  /// What rays meet first: which triangle, or k_nothing, and where in it. coherent: they are close to each other.
  struct Meeting {
    std::uint32_t triangle;
    float u, v;
  };
  void intersect(const Ray* rays, std::size_t count, bool coherent, Meeting* meetings) const;

  /// Of segments, open at both ends.
  void occluded(const Ray* segments, std::size_t count, bool coherent, bool* blocked) const;

  Hit hit(const Meeting& meeting) const;
  bool meets_front(const Ray& ray, std::uint32_t triangle) const;

  std::size_t triangle_count() const { return corners_.size() / 3; }
  glm::vec3 corner(std::uint32_t triangle, std::uint32_t i) const { return positions_[corners_[3 * triangle + i]]; }
  glm::vec3 emission(std::uint32_t triangle) const { return materials_[triangle_materials_[triangle]].emission; }

  /// How far a point must be lifted off its surface for the rounding of floats not to put it under.
  float lift() const { return lift_; }
  std::uint64_t rays() const { return rays_; }

 private:
  template <auto release>
  struct Release {
    template <class Handle>
    void operator()(Handle* handle) const noexcept {
      release(handle);
    }
  };

  void add(const bake::MeshData& mesh);
  void build();

  std::vector<bake::MaterialData> materials_;
  std::vector<glm::vec3> positions_, normals_, colors_;
  std::vector<std::uint32_t> corners_, triangle_materials_;
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release<rtcReleaseDevice>> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Release<rtcReleaseScene>> scene_;
  float lift_ = 0;
  mutable std::uint64_t rays_ = 0;
};

}  // namespace bench
