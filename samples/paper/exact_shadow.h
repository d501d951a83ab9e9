// The experiment's light without any error but that of doubles: a floor point sees the emitter minus the triangle's
// projection, and what it sees is a polygon, whose form factor is Lambert's contour integral (J. H. Lambert,
// Photometria, 1760; R. Siegel and J. Howell, "Thermal Radiation Heat Transfer", chapter on configuration factors).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace paper {

/// Form factor from a point with a normal to a polygon wholly in front of it, of whatever orientation.
double form_factor(const glm::dvec3& point, const glm::dvec3& normal, const std::vector<glm::dvec3>& polygon);

/// The part of a convex polygon that lies inside of another, both counter-clockwise (I. Sutherland and G. Hodgman,
/// "Reentrant polygon clipping", 1974).
std::vector<glm::dvec2> intersection(std::vector<glm::dvec2> polygon, const std::vector<glm::dvec2>& window);

/// The paper's experiment: the floor is the unit square at height 0, seen from above as (x, y); its heights are z.
struct Experiment {
  std::vector<glm::dvec2> emitter;  ///< counter-clockwise
  double emitter_height = 1;
  std::vector<glm::dvec2> occluder;  ///< a triangle, counter-clockwise
  double occluder_height = 0.3;
  double radiance = 1;

  /// Irradiance of the floor at a point.
  double irradiance(const glm::dvec2& at) const;
  /// The same without the occluder.
  double unoccluded(const glm::dvec2& at) const;
  /// Distance to the outline of the shadow that a point at the emitter's centre would cast on the floor.
  double distance_to_shadow_edge(const glm::dvec2& at) const;
};

/// A 0.1 x 0.1 emitter above the floor's centre; a triangle whose shadow lies inside the floor, along no axis of it.
Experiment experiment();

}  // namespace paper
