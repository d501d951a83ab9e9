#include "rasteriser.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace bake {
namespace {

/// Nearer by less than this share is as near: rounding must not stipple surfaces that coincide.
constexpr double k_same_depth = 1e-6;

double edge_function(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

}  // namespace

Rasteriser::Rasteriser(const Camera& camera, std::size_t width, std::size_t height)
    : eye_(camera.eye),
      forward_(glm::normalize(camera.target - camera.eye)),
      tangent_(std::tan(camera.field_of_view / 2)),
      near_(1e-4 * glm::length(camera.target - camera.eye)),
      width_(width),
      height_(height),
      nearness_(width * height, 0.0) {
  const glm::dvec3 upward = std::abs(forward_.y) > 0.999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  right_ = glm::normalize(glm::cross(forward_, upward));
  up_ = glm::cross(right_, forward_);
}

glm::dvec3 Rasteriser::to_view(const float* position) const {
  const glm::dvec3 offset = glm::dvec3(position[0], position[1], position[2]) - eye_;
  return {glm::dot(offset, right_), glm::dot(offset, up_), glm::dot(offset, forward_)};
}

void Rasteriser::draw(const DrawnMesh& mesh, const std::function<void(const Fragment&)>& shade) {
  for (std::size_t t = 0; t < mesh.triangle_count; ++t) {
    std::array<std::uint32_t, 3> vertices{};
    std::array<Corner, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      vertices[i] = mesh.indices[3 * t + i];
      corners[i].view = to_view(mesh.positions + 3 * std::size_t{vertices[i]});
      corners[i].weights[static_cast<int>(i)] = 1;
    }
    const auto behind =
        std::count_if(corners.begin(), corners.end(), [&](const Corner& c) { return c.view.z < near_; });
    if (behind == 0) {
      draw_triangle(vertices, corners, true, shade);
    } else if (behind < 3) {  // cut off what is behind the near plane (Sutherland and Hodgman 1974)
      std::array<Corner, 4> kept{};
      std::size_t count = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Corner& a = corners[i];
        const Corner& b = corners[(i + 1) % 3];
        if (a.view.z >= near_) {
          kept[count++] = a;
        }
        if ((a.view.z < near_) != (b.view.z < near_)) {
          const double share = (near_ - a.view.z) / (b.view.z - a.view.z);
          kept[count++] = {a.view + share * (b.view - a.view), a.weights + share * (b.weights - a.weights)};
        }
      }
      for (std::size_t i = 2; i < count; ++i) {
        draw_triangle(vertices, {kept[0], kept[i - 1], kept[i]}, false, shade);
      }
    }
  }
}

void Rasteriser::draw_triangle(const std::array<std::uint32_t, 3>& vertices, const std::array<Corner, 3>& corners,
                               bool whole, const std::function<void(const Fragment&)>& shade) {
  const double scale = static_cast<double>(height_) / (2 * tangent_);
  const glm::dvec2 center(static_cast<double>(width_) / 2, static_cast<double>(height_) / 2);
  std::array<glm::dvec2, 3> p;
  glm::dvec3 near;
  for (std::size_t i = 0; i < 3; ++i) {
    near[static_cast<int>(i)] = 1 / corners[i].view.z;
    p[i] = center + glm::dvec2(corners[i].view.x, -corners[i].view.y) * (scale / corners[i].view.z);
  }
  const double area = -edge_function(p[0], p[1], p[2]);  // rows count downwards, so fronts are clockwise here
  if (!(area > 0)) {
    return;
  }
  const glm::dvec3 lengths(glm::length(p[2] - p[1]), glm::length(p[0] - p[2]), glm::length(p[1] - p[0]));
  const double thickness = area / std::max({lengths.x, lengths.y, lengths.z});
  const auto first = [](double low, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(size)));
  };
  const std::size_t x0 = first(std::min({p[0].x, p[1].x, p[2].x}), width_);
  const std::size_t x1 = first(std::max({p[0].x, p[1].x, p[2].x}) + 1, width_);
  const std::size_t y0 = first(std::min({p[0].y, p[1].y, p[2].y}), height_);
  const std::size_t y1 = first(std::max({p[0].y, p[1].y, p[2].y}) + 1, height_);
  for (std::size_t y = y0; y < y1; ++y) {
    for (std::size_t x = x0; x < x1; ++x) {
      const glm::dvec2 at(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      const glm::dvec3 edges(-edge_function(p[1], p[2], at), -edge_function(p[2], p[0], at),
                             -edge_function(p[0], p[1], at));
      if (edges.x < 0 || edges.y < 0 || edges.z < 0) {
        continue;
      }
      const glm::dvec3 by_nearness = edges / area * near;
      const double nearness = by_nearness.x + by_nearness.y + by_nearness.z;
      const std::size_t sample = y * width_ + x;
      if (nearness <= nearness_[sample] * (1 + k_same_depth)) {
        continue;
      }
      nearness_[sample] = nearness;
      const glm::dvec3 weights = by_nearness.x / nearness * corners[0].weights +
                                 by_nearness.y / nearness * corners[1].weights +
                                 by_nearness.z / nearness * corners[2].weights;
      const glm::dvec3 to_edges = edges / lengths;
      const double edge_distance = whole ? std::min({to_edges.x, to_edges.y, to_edges.z})  // cuts are no edges
                                         : std::numeric_limits<double>::infinity();
      shade({sample, vertices, weights, 1 / nearness, edge_distance, thickness});
    }
  }
}

}  // namespace bake
