// A small software rasteriser: triangles seen in perspective, nearest first, for the preview picture and for choosing
// its camera. After Pineda, "A parallel algorithm for polygon rasterization" (1988): three edge functions a sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "camera.h"

namespace bake {

/// Triangles to draw; those that wind clockwise as seen from the eye are not drawn.
struct DrawnMesh {
  const float* positions;        ///< 3 a vertex
  const float* radiance;         ///< 3 a vertex
  const std::uint32_t* indices;  ///< 3 a triangle
  std::size_t triangle_count;
};

/// What one sample sees of one triangle.
struct Fragment {
  std::size_t sample;  ///< row by row from the top left
  std::array<std::uint32_t, 3> vertices;
  glm::dvec3 weights;    ///< of the vertices, in space
  double distance;       ///< along the view axis
  double edge_distance;  ///< to the triangle's nearest edge, samples
  double thickness;      ///< the triangle's smallest height, samples
};

class Rasteriser {
 public:
  Rasteriser(const Camera& camera, std::size_t width, std::size_t height);

  /// Calls shade for every sample where a triangle is nearer than all before. Of triangles that coincide the first one
  /// stays.
  void draw(const DrawnMesh& mesh, const std::function<void(const Fragment&)>& shade);

  /// Width of a sample at distance 1.
  double sample_size() const noexcept { return 2 * tangent_ / static_cast<double>(height_); }

 private:
  struct Corner {
    glm::dvec3 view;     ///< right, up, forward
    glm::dvec3 weights;  ///< of the triangle's own corners
  };

  glm::dvec3 to_view(const float* position) const;
  void draw_triangle(const std::array<std::uint32_t, 3>& vertices, const std::array<Corner, 3>& corners, bool whole,
                     const std::function<void(const Fragment&)>& shade);

  glm::dvec3 eye_, right_, up_, forward_;
  double tangent_;
  double near_;
  std::size_t width_, height_;
  std::vector<double> nearness_;  ///< 1 / distance of what a sample sees so far
};

}  // namespace bake
