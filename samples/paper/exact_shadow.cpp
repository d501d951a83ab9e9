#include "exact_shadow.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace paper {
namespace {

/// Twice the signed area of a, b, c.
double orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::vector<glm::dvec3> lifted(const std::vector<glm::dvec2>& polygon, double height) {
  std::vector<glm::dvec3> corners;
  corners.reserve(polygon.size());
  for (const glm::dvec2& corner : polygon) {
    corners.emplace_back(corner, height);
  }
  return corners;
}

double distance_to_segment(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
  const double along = glm::dot(point - a, b - a) / glm::dot(b - a, b - a);
  return glm::distance(point, a + std::clamp(along, 0.0, 1.0) * (b - a));
}

}  // namespace

double form_factor(const glm::dvec3& point, const glm::dvec3& normal, const std::vector<glm::dvec3>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i] - point;
    const glm::dvec3 b = polygon[(i + 1) % polygon.size()] - point;
    const glm::dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 0) {
      sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(across, normal) / sine;
    }
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

std::vector<glm::dvec2> intersection(std::vector<glm::dvec2> polygon, const std::vector<glm::dvec2>& window) {
  for (std::size_t side = 0; side < window.size() && !polygon.empty(); ++side) {
    const glm::dvec2& a = window[side];
    const glm::dvec2& b = window[(side + 1) % window.size()];
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec2& from = polygon[i];
      const glm::dvec2& to = polygon[(i + 1) % polygon.size()];
      const double before = orientation(a, b, from);
      const double after = orientation(a, b, to);
      if (before >= 0) {
        kept.push_back(from);
      }
      if ((before > 0 && after < 0) || (before < 0 && after > 0)) {
        kept.push_back(glm::mix(from, to, before / (before - after)));
      }
    }
    polygon = std::move(kept);
  }
  return polygon;
}

double Experiment::unoccluded(const glm::dvec2& at) const {
  return std::numbers::pi * radiance * form_factor({at, 0}, {0, 0, 1}, lifted(emitter, emitter_height));
}

double Experiment::irradiance(const glm::dvec2& at) const {
  std::vector<glm::dvec2> shadow;  // the occluder as the point sees it, in the emitter's plane
  for (const glm::dvec2& corner : occluder) {
    shadow.push_back(at + (corner - at) * (emitter_height / occluder_height));
  }
  const std::vector<glm::dvec2> hidden = intersection(emitter, shadow);
  const double light = unoccluded(at);
  if (hidden.size() < 3) {
    return light;
  }
  const double taken = std::numbers::pi * radiance * form_factor({at, 0}, {0, 0, 1}, lifted(hidden, emitter_height));
  return std::max(0.0, light - taken);
}

double Experiment::distance_to_shadow_edge(const glm::dvec2& at) const {
  glm::dvec2 centre(0);
  for (const glm::dvec2& corner : emitter) {
    centre += corner / static_cast<double>(emitter.size());
  }
  std::vector<glm::dvec2> outline;
  for (const glm::dvec2& corner : occluder) {
    outline.push_back(centre + (corner - centre) * (emitter_height / (emitter_height - occluder_height)));
  }
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    distance = std::min(distance, distance_to_segment(at, outline[i], outline[(i + 1) % outline.size()]));
  }
  return distance;
}

Experiment experiment() {
  Experiment experiment;
  experiment.emitter = {{0.45, 0.45}, {0.55, 0.45}, {0.55, 0.55}, {0.45, 0.55}};
  experiment.occluder = {{0.32, 0.36}, {0.68, 0.43}, {0.45, 0.69}};
  return experiment;
}

}  // namespace paper
