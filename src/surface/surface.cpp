#include "surface/surface.h"

#include <algorithm>

#include "base/floating_point.h"
#include "surface/make_surface.h"
#include "surface/surface_parts.h"
#include "surface/triangle_cells.h"

namespace radvor {

struct Surface::State : SurfaceParts {
  using SurfaceParts::SurfaceParts;

  std::span<const ShareTriangle> triangles_of(std::uint32_t facet) const {
    const FacetRecord& record = records[facet];
    if (record.first_share == k_none) {
      return {};
    }
    return record.mesh == k_none ? std::span<const ShareTriangle>(small_triangles).subspan(facet, 1)
                                 : meshes[record.mesh]->triangles();
  }

  // Whether each triangle's corners are shares of their own, with cells in closed form.
  bool has_plain_triangles(const FacetRecord& record) const {
    return record.mesh == k_none || meshes[record.mesh]->degenerate();
  }

  std::array<Vec2, 3> corners(const ShareTriangle& triangle) const {
    return {position_in_facet(triangle[0]), position_in_facet(triangle[1]), position_in_facet(triangle[2])};
  }

  // Where a facet has no triangulation to ask: the triangle that the point is farthest inside of, or least outside.
  std::uint32_t best_triangle(std::span<const ShareTriangle> triangles, const Vec2& point) const;
};

namespace {

// Corner weights of the nearest sensible point in the triangle: negative ones are cut off.
std::array<double, 3> clamped_weights(const std::array<Vec2, 3>& corners, const Vec2& point) {
  std::array<double, 3> weights;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[k] = std::max(doubled_area(point, corners[(k + 1) % 3], corners[(k + 2) % 3]), 0.0);
    sum += weights[k];
  }
  for (double& weight : weights) {
    weight = sum > 0 ? weight / sum : 1.0 / 3;
  }
  return weights;
}

// Relative to the triangle's size: negative outside.
double depth_inside(const std::array<Vec2, 3>& corners, const Vec2& point) {
  const double area = doubled_area(corners[0], corners[1], corners[2]);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    least = std::min(least, doubled_area(point, corners[(k + 1) % 3], corners[(k + 2) % 3]));
  }
  return area > 0 ? least / area : -std::numeric_limits<double>::infinity();
}

}  // namespace

std::uint32_t Surface::State::best_triangle(std::span<const ShareTriangle> triangles, const Vec2& point) const {
  std::uint32_t best = 0;
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; triangles.size() > 1 && k < triangles.size(); ++k) {
    const double depth = depth_inside(corners(triangles[k]), point);
    if (depth > deepest) {
      deepest = depth;
      best = k;
    }
  }
  return best;
}

Surface::Surface(const Scene& scene, const WeldedScene& welded, const Facets& facets, const SurfaceOptions& options,
                 Host& host)
    : memory_(&host.memory) {
  const FloatingPointGuard guard(Denormals::keep);
  std::pmr::polymorphic_allocator<> allocator(memory_);
  state_ = allocator.new_object<State>(scene, welded, facets, options, host);
  try {
    make_surface(*state_);
  } catch (...) {
    allocator.delete_object(state_);
    throw;
  }
}

Surface::~Surface() {
  std::pmr::polymorphic_allocator<>(memory_).delete_object(state_);
}

std::span<const Site> Surface::sites() const {
  return state_->sites;
}

std::span<const Sample> Surface::samples() const {
  return state_->samples;
}

std::span<const Share> Surface::shares() const {
  return state_->shares;
}

std::uint32_t Surface::patch_count() const {
  return static_cast<std::uint32_t>(state_->first_of_patch.size() - 1);
}

std::span<const std::uint32_t> Surface::patch(std::uint32_t patch) const {
  const std::uint32_t first = state_->first_of_patch[patch];
  return std::span(state_->patch_members).subspan(first, state_->first_of_patch[patch + 1] - first);
}

std::span<const ShareTriangle> Surface::triangles(std::uint32_t facet) const {
  return state_->triangles_of(facet);
}

std::uint32_t Surface::triangle_count() const {
  std::size_t count = 0;
  for (std::uint32_t facet = 0; facet < state_->records.size(); ++facet) {
    count += state_->triangles_of(facet).size();
  }
  return static_cast<std::uint32_t>(count);
}

std::uint32_t Surface::constraint_count() const {
  std::uint32_t count = 0;
  for (const auto& mesh : state_->meshes) {
    count += mesh->degenerate() ? 0 : mesh->triangulation().constraint_count();
  }
  return count;
}

void Surface::cell(std::uint32_t index, std::pmr::vector<Vec3>& polygon) const {
  const Share& share = state_->shares[index];
  const Frame& frame = state_->facets.facets[share.facet].frame;
  const FacetRecord& record = state_->records[share.facet];
  const std::uint32_t front = share.back ? share.other_side : index;
  polygon.clear();
  const auto append = [&](const Vec2& point) { polygon.push_back(frame.to_world(point)); };
  if (state_->has_plain_triangles(record)) {
    const std::uint32_t number = front - record.first_share;
    const auto cells = triangle_cells(state_->corners(state_->triangles_of(share.facet)[number / 3]));
    const CornerCell& cell = cells[number % 3];
    std::for_each(cell.points.begin(), cell.points.begin() + cell.count, append);
  } else {
    alignas(std::max_align_t) std::byte room[4096];
    std::pmr::monotonic_buffer_resource scratch(room, sizeof room, memory_);
    delaunay::CellBuffer buffer(&scratch);
    const auto points = state_->meshes[record.mesh]->cell(share.vertex, front, buffer);
    std::for_each(points.begin(), points.end(), append);
  }
  if (share.back) {
    std::reverse(polygon.begin(), polygon.end());
  }
}

FacetPoint Surface::locate(std::uint32_t facet, const Vec2& point) const {
  const auto triangles = state_->triangles_of(facet);
  const FacetRecord& record = state_->records[facet];
  const std::uint32_t found = state_->has_plain_triangles(record) ? state_->best_triangle(triangles, point)
                                                                  : state_->meshes[record.mesh]->locate(point);
  return {triangles[found], clamped_weights(state_->corners(triangles[found]), point)};
}

const Scene& Surface::scene() const {
  return state_->scene;
}

const WeldedScene& Surface::welded() const {
  return state_->welded;
}

const Facets& Surface::facets() const {
  return state_->facets;
}

}  // namespace radvor
