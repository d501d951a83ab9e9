#include "surface/locate_together.h"

#include <algorithm>
#include <array>

#include "base/prefetch.h"

namespace radvor {

namespace {

constexpr std::size_t k_at_once = 16;

// Every step of all points before the next of any: what it reads was asked ahead in the step before.
class Chain {
 public:
  Chain(const SurfaceParts& parts, std::span<const PlanePoint> points) : parts_(parts), points_(points) {}

  void locate(FacetPoint* found) {
    for (const PlanePoint& point : points_) {
      __builtin_prefetch(&parts_.records[point.facet]);
      __builtin_prefetch(&parts_.small_triangles[point.facet]);
    }
    tell_apart();
    for (std::size_t k = 0; k < meshed_; ++k) {
      meshes_[k]->fetch();
    }
    for (std::size_t k = 0; k < corners_; ++k) {
      __builtin_prefetch(&parts_.shares[chain_[k]].sample);
    }
    for (std::size_t k = 0; k < meshed_; ++k) {
      meshes_[k]->quick().fetch_start(at_[k]);
    }
    for (std::size_t k = 0; k < corners_; ++k) {
      chain_[k] = parts_.shares[chain_[k]].sample;
      __builtin_prefetch(&parts_.samples[chain_[k]].site);
    }
    for (std::size_t k = 0; k < meshed_; ++k) {
      from_[k] = meshes_[k]->quick().start(at_[k]);
      meshes_[k]->quick().fetch(from_[k]);
    }
    for (std::size_t k = 0; k < corners_; ++k) {
      __builtin_prefetch(&parts_.sites[parts_.samples[chain_[k]].site].position);
    }
    for (std::size_t k = 0; k < meshed_; ++k) {
      triangle_[k] = meshes_[k]->quick().find(at_[k], from_[k], found[point_[k]].weights);
      if (triangle_[k] != k_none) {
        __builtin_prefetch(&meshes_[k]->triangles()[triangle_[k]]);
      }
    }
    std::size_t next = 0;  // that is meshed
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const bool meshed = next < meshed_ && point_[next] == p;
      const std::size_t k = meshed ? next++ : 0;
      if (meshed && triangle_[k] != k_none) {
        found[p].shares = meshes_[k]->triangles()[triangle_[k]];
      } else {
        found[p] = parts_.located(points_[p].facet).locate(points_[p].at);
      }
    }
  }

 private:
  // Those on facets that are meshed, and the corners of those that are single triangles.
  void tell_apart() {
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const PlanePoint& point = points_[p];
      const std::uint32_t mesh = parts_.records[point.facet].mesh;
      if (mesh != k_none) {
        at_[meshed_] = point.at;
        point_[meshed_] = p;
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
  std::array<std::size_t, k_at_once> point_;  // of the meshed: which it is
  std::array<const FacetMesh*, k_at_once> meshes_;
  std::array<Vec2, k_at_once> at_;
  std::array<delaunay::TriangleId, k_at_once> from_;
  std::array<std::uint32_t, k_at_once> triangle_;   // found, of its mesh
  std::array<std::uint32_t, 3 * k_at_once> chain_;  // of each corner: its share, then its sample
};

}  // namespace

void locate_together(const SurfaceParts& parts, std::span<const PlanePoint> points, FacetPoint* found) {
  while (!points.empty()) {
    const auto some = points.first(std::min(points.size(), k_at_once));
    Chain(parts, some).locate(found);
    found += some.size();
    points = points.subspan(some.size());
  }
}

}  // namespace radvor
