#include "camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "failure.h"
#include "rasteriser.h"
#include "text_lines.h"

namespace bake {
namespace {

constexpr double k_degree = std::numbers::pi / 180;
constexpr double k_field_of_view = 36 * k_degree;
constexpr double k_margin = 1.03;  // so that nothing touches the picture's border
constexpr double k_nowhere = -std::numeric_limits<double>::infinity();
constexpr std::size_t k_most_triangles = 40000;  // that the choice looks at: the largest
constexpr std::size_t k_rows = 96;

/// The largest triangles, as one mesh of their own.
struct Sketch {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;

  explicit Sketch(const SceneData& scene) {
    std::vector<std::pair<double, std::array<glm::vec3, 3>>> triangles;
    for (const MeshData& mesh : scene.meshes) {
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::array<glm::vec3, 3> p{mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                                         mesh.positions[mesh.indices[i + 2]]};
        triangles.emplace_back(glm::length(glm::cross(p[1] - p[0], p[2] - p[0])), p);
      }
    }
    const std::size_t kept = std::min(triangles.size(), k_most_triangles);
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(kept), triangles.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t t = 0; t < kept; ++t) {
      for (const glm::vec3& p : triangles[t].second) {
        positions.insert(positions.end(), {p.x, p.y, p.z});
        indices.push_back(static_cast<std::uint32_t>(indices.size()));
      }
    }
  }

  glm::dvec3 position(std::uint32_t vertex) const {
    return {positions[3 * std::size_t{vertex}], positions[3 * std::size_t{vertex} + 1],
            positions[3 * std::size_t{vertex} + 2]};
  }
};

/// The nearest eye from which, looking along a direction, all of the scene is in the picture: each side of the
/// pyramid of sight touches it, or only two opposite sides do and the scene is in the middle between the others.
Camera camera_from(const SceneData& scene, const glm::dvec3& back, double aspect) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
  const glm::dvec3 up = glm::cross(back, right);
  const double vertical = std::tan(k_field_of_view / 2) / k_margin;
  const double horizontal = vertical * aspect;
  // For each side: how far back the eye must stay if it stood on the axis through the origin; and of all points the
  // nearest and farthest, to have something to look at.
  double left = k_nowhere, rightmost = k_nowhere, bottom = k_nowhere, top = k_nowhere, near = k_nowhere,
         far = k_nowhere;
  for (const MeshData& mesh : scene.meshes) {
    for (const std::uint32_t index : mesh.indices) {
      const glm::dvec3 p(mesh.positions[index]);
      const double x = glm::dot(p, right) / horizontal;
      const double y = glm::dot(p, up) / vertical;
      const double z = glm::dot(p, back);
      rightmost = std::max(rightmost, z + x);
      left = std::max(left, z - x);
      top = std::max(top, z + y);
      bottom = std::max(bottom, z - y);
      near = std::max(near, z);
      far = std::max(far, -z);
    }
  }
  if (near == k_nowhere) {
    return {};
  }
  double distance = std::max(rightmost + left, top + bottom) / 2;
  if (!(distance > near)) {  // a single point
    distance = near + 1;
  }
  const glm::dvec3 eye =
      right * ((rightmost - left) / 2 * horizontal) + up * ((top - bottom) / 2 * vertical) + back * distance;
  return {eye, eye - back * (distance - (near - far) / 2), k_field_of_view};
}

/// Area of the surfaces that the camera sees.
double visible_area(const Sketch& sketch, const Camera& camera, double aspect) {
  const auto columns = static_cast<std::size_t>(std::lround(aspect * static_cast<double>(k_rows)));
  Rasteriser rasteriser(camera, columns, k_rows);
  const double size = rasteriser.sample_size();
  std::vector<double> areas(columns * k_rows, 0.0);
  rasteriser.draw({sketch.positions.data(), nullptr, sketch.indices.data(), sketch.indices.size() / 3},
                  [&](const Fragment& fragment) {
                    const glm::dvec3 a = sketch.position(fragment.vertices[0]);
                    const glm::dvec3 b = sketch.position(fragment.vertices[1]);
                    const glm::dvec3 c = sketch.position(fragment.vertices[2]);
                    const glm::dvec3 at = fragment.weights.x * a + fragment.weights.y * b + fragment.weights.z * c;
                    const glm::dvec3 back = camera.eye - at;
                    const double cosine = glm::dot(glm::normalize(glm::cross(b - a, c - a)), glm::normalize(back));
                    // A sample covers size^2 distance^2 of a plane across the view axis, and what that hides of this
                    // surface; grazing views show little of what they cover.
                    const double across = size * size * fragment.distance * fragment.distance;
                    const double along_ray = across * fragment.distance / glm::length(back);
                    areas[fragment.sample] = along_ray / std::max(cosine, 0.1);
                  });
  double sum = 0;
  for (const double area : areas) {
    sum += area;
  }
  return sum;
}

}  // namespace

Camera parse_camera(std::string_view words) {
  const auto numbers = parse_numbers(split_fields(words));
  const auto refuse = [&](const std::string& why) {
    throw Failure(ExitCode::usage, "--camera \"" + std::string(words) + "\": " + why);
  };
  if (!numbers || numbers->size() != 7) {
    refuse("it reads EX EY EZ TX TY TZ FOV");
  }
  const std::vector<double>& n = *numbers;
  const Camera camera{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6] * k_degree};
  if (camera.eye == camera.target) {
    refuse("eye and target are the same place");
  }
  if (!(n[6] > 0 && n[6] < 180)) {
    refuse("the field of view is between 0 and 180 degrees");
  }
  return camera;
}

Camera find_camera(const SceneData& scene, double aspect) {
  const Sketch sketch(scene);
  Camera best;
  double most = -1;
  for (const double elevation : {0.0, 12.0, 25.0, 40.0, 60.0}) {
    for (int turn = 0; turn < 24; ++turn) {
      const double azimuth = 15.0 * turn;
      const double level = std::cos(elevation * k_degree);
      const glm::dvec3 direction(level * std::sin(azimuth * k_degree), std::sin(elevation * k_degree),
                                 level * std::cos(azimuth * k_degree));
      const Camera camera = camera_from(scene, direction, aspect);
      const double area = visible_area(sketch, camera, aspect);
      if (area > most * 1.001) {  // a tie goes to the view that is more level
        most = area;
        best = camera;
      }
    }
  }
  return best;
}

}  // namespace bake
