#include "surface/shading.h"

#include <algorithm>
#include <cmath>

#include "scene/position_welding.h"
#include "surface/triangle_cells.h"

namespace radvor {

namespace {

// Weights of the corners, in proportion to opposite areas; the smallest tells how far inside the point is.
Vec3 barycentric(const std::array<Vec2, 3>& corners, const Vec2& point) {
  const double area = doubled_area(corners[0], corners[1], corners[2]);
  if (!(area > 0)) {
    return Vec3(-HUGE_VAL);
  }
  return Vec3(doubled_area(point, corners[1], corners[2]), doubled_area(corners[0], point, corners[2]),
              doubled_area(corners[0], corners[1], point)) /
         area;
}

double least(const Vec3& weights) {
  return std::min({weights.x, weights.y, weights.z});
}

}  // namespace

FacetShading::FacetShading(const FacetInput& input)
    : in_(input),
      varies_(!input.facet().flat || !input.scene.meshes[input.facet().mesh].colors.empty()),
      corners_(input.memory),
      first_(input.memory),
      members_(input.memory) {}

Shading FacetShading::on_side(const SourceSide& source, const Vec3& position) const {
  const Triangle& triangle = in_.welded.triangles[source.triangle];
  glm::length_t from = source.side;
  glm::length_t to = (source.side + 1) % 3;
  const auto end = [&](glm::length_t corner) -> const Vec3& {
    return in_.welded.positions[triangle.vertices[static_cast<std::size_t>(corner)]];
  };
  if (lies_before(end(to), end(from))) {
    std::swap(from, to);
  }
  const Vec3 along = end(to) - end(from);
  const double part = std::clamp(glm::dot(position - end(from), along) / glm::dot(along, along), 0.0, 1.0);
  Vec3 weights(0.0);
  weights[from] = 1 - part;
  weights[to] = part;
  return blend(source.triangle, weights);
}

Shading FacetShading::at_corner(std::uint32_t triangle, std::uint32_t corner) const {
  Vec3 weights(0.0);
  weights[static_cast<glm::length_t>(corner)] = 1;
  return blend(triangle, weights);
}

Shading FacetShading::inside(const Vec2& point) {
  const auto triangles = in_.facets.triangles_of(in_.index);
  if (!varies_) {
    return blend(triangles.front(), Vec3(1, 0, 0));
  }
  if (corners_.empty()) {
    build_grid();
  }
  const auto cell_of = [&](double offset, double width, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(offset / width), 0.0, static_cast<double>(count - 1)));
  };
  const std::uint32_t cell =
      cell_of(point.y - low_.y, cell_.y, rows_) * columns_ + cell_of(point.x - low_.x, cell_.x, columns_);
  std::uint32_t best = 0;
  Vec3 weights(-HUGE_VAL);
  const auto consider = [&](std::uint32_t k) {
    const Vec3 here = barycentric(corners_[k], point);
    if (least(here) > least(weights)) {
      best = k;
      weights = here;
    }
  };
  for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k) {
    consider(members_[k]);
  }
  for (std::uint32_t k = 0; least(weights) < -1e-6 && k < corners_.size(); ++k) {
    consider(k);  // beside all of the cell's triangles: rounding at the facet's border
  }
  weights = glm::clamp(weights, 0.0, 1.0);
  const double sum = weights.x + weights.y + weights.z;
  return blend(triangles[best], sum > 0 ? weights / sum : Vec3(1, 0, 0));
}

Shading FacetShading::blend(std::uint32_t index, const Vec3& weights) const {
  const Facet& facet = in_.facet();
  const Triangle& triangle = in_.welded.triangles[index];
  Shading shading{facet.frame.normal, in_.scene.materials[facet.material].albedo, false};
  if (!facet.flat) {
    const auto& normals = in_.facets.corner_normals[index];
    const Vec3 normal = weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2];
    const double length = glm::length(normal);
    shading.normal = length > 0 ? normal / length : facet.frame.normal;
  }
  const auto& colors = in_.scene.meshes[facet.mesh].colors;
  if (!colors.empty()) {
    shading.albedo *= weights.x * Color(colors[triangle.corners[0]]) + weights.y * Color(colors[triangle.corners[1]]) +
                      weights.z * Color(colors[triangle.corners[2]]);
  }
  const Color most(k_most_albedo);
  shading.clamped = glm::min(shading.albedo, most) != shading.albedo;
  shading.albedo = glm::min(shading.albedo, most);
  return shading;
}

void FacetShading::build_grid() {
  const auto triangles = in_.facets.triangles_of(in_.index);
  Vec2 high(0.0);
  for (const std::uint32_t index : triangles) {
    std::array<Vec2, 3>& corners = corners_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = in_.facet().frame.to_plane(in_.welded.positions[in_.welded.triangles[index].vertices[k]]);
      const bool first = corners_.size() == 1 && k == 0;
      low_ = first ? corners[k] : glm::min(low_, corners[k]);
      high = first ? corners[k] : glm::max(high, corners[k]);
    }
  }
  columns_ = rows_ = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles.size()))) + 1;
  const Vec2 size = high - low_;
  cell_ = {size.x > 0 ? size.x / columns_ : 1.0, size.y > 0 ? size.y / rows_ : 1.0};

  const auto for_cells = [&](const std::array<Vec2, 3>& corners, auto&& function) {
    const Vec2 least_corner = (glm::min(corners[0], glm::min(corners[1], corners[2])) - low_) / cell_;
    const Vec2 most_corner = (glm::max(corners[0], glm::max(corners[1], corners[2])) - low_) / cell_;
    const auto end_x = std::min(static_cast<std::uint32_t>(most_corner.x), columns_ - 1);
    const auto end_y = std::min(static_cast<std::uint32_t>(most_corner.y), rows_ - 1);
    for (auto y = static_cast<std::uint32_t>(least_corner.y); y <= end_y; ++y) {
      for (auto x = static_cast<std::uint32_t>(least_corner.x); x <= end_x; ++x) {
        function(y * columns_ + x);
      }
    }
  };
  first_.assign(std::size_t{columns_} * rows_ + 1, 0);
  for (const auto& corners : corners_) {
    for_cells(corners, [&](std::uint32_t cell) { ++first_[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) {
    first_[cell] += first_[cell - 1];
  }
  members_.resize(first_.back());
  std::pmr::vector<std::uint32_t> end(first_, in_.memory);
  for (std::uint32_t k = 0; k < corners_.size(); ++k) {
    for_cells(corners_[k], [&](std::uint32_t cell) { members_[end[cell]++] = k; });
  }
}

}  // namespace radvor
