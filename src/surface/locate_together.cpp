#include "surface/locate_together.h"

#include <algorithm>
#include <array>

#include "base/prefetch.h"

namespace radvor {

namespace {

constexpr std::size_t k_at_once = 16;

class Chain {
 public:
  Chain(const SurfaceParts& parts, std::span<const PlanePoint> points) : parts_(parts), points_(points) {}

  void fetch() {
    for (const PlanePoint& point : points_) {
      __builtin_prefetch(&parts_.records[point.facet]);
      __builtin_prefetch(&parts_.small_triangles[point.facet]);
    }
    tell_apart();
    for (std::size_t k = 0; k < meshed_; ++k) {
      prefetch(*meshes_[k]);
    }
    for (std::size_t k = 0; k < corners_; ++k) {
      __builtin_prefetch(&parts_.shares[chain_[k]].sample);
    }
    for (std::size_t k = 0; k < meshed_; ++k) {
      if (meshes_[k]->degenerate() || meshes_[k]->ties_are_aligned()) {
        meshes_[k] = nullptr;
      } else {
        meshes_[k]->fetch_start(at_[k]);
      }
    }
    for (std::size_t k = 0; k < corners_; ++k) {
      chain_[k] = parts_.shares[chain_[k]].sample;
      __builtin_prefetch(&parts_.samples[chain_[k]].site);
    }
    for (std::size_t k = 0; k < meshed_; ++k) {
      starts_[k] = meshes_[k] ? meshes_[k]->fetch_triangle(at_[k]) : delaunay::k_none;
    }
    for (std::size_t k = 0; k < corners_; ++k) {
      __builtin_prefetch(&parts_.sites[parts_.samples[chain_[k]].site].position);
    }
    for (std::size_t k = 0; k < meshed_; ++k) {
      if (starts_[k] != delaunay::k_none) {
        meshes_[k]->fetch_corners(starts_[k]);
      }
    }
  }

 private:
  // Those on facets that are meshed, and the corners of those that are single triangles.
  void tell_apart() {
    for (const PlanePoint& point : points_) {
      const std::uint32_t mesh = parts_.records[point.facet].mesh;
      if (mesh != k_none) {
        at_[meshed_] = point.at;
        meshes_[meshed_++] = &*parts_.meshes[mesh];
        continue;
      }
      for (const std::uint32_t share : parts_.small_triangles[point.facet]) {
        chain_[corners_++] = share;
      }
    }
  }

  const SurfaceParts& parts_;
  std::span<const PlanePoint> points_;
  std::size_t meshed_ = 0, corners_ = 0;
  std::array<const FacetMesh*, k_at_once> meshes_;
  std::array<Vec2, k_at_once> at_;
  std::array<delaunay::TriangleId, k_at_once> starts_;
  std::array<std::uint32_t, 3 * k_at_once> chain_;  // of each corner: its share, then its sample
};

}  // namespace

void locate_together(const SurfaceParts& parts, std::span<const PlanePoint> points, FacetPoint* found) {
  while (!points.empty()) {
    const auto some = points.first(std::min(points.size(), k_at_once));
    Chain(parts, some).fetch();
    for (const PlanePoint& point : some) {
      *found++ = parts.located(point.facet).locate(point.at);
    }
    points = points.subspan(some.size());
  }
}

}  // namespace radvor
