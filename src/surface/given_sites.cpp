#include "surface/given_sites.h"

#include <algorithm>
#include <cmath>

#include "scene/box_tree.h"
#include "scene/closest_weights.h"
#include "scene/shape.h"

namespace radvor {

std::pmr::vector<GivenSite> find_given_sites(const Scene& scene, const WeldedScene& welded, const Facets& facets,
                                             std::pmr::memory_resource* memory) {
  std::pmr::vector<GivenSite> found(memory);
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    if (scene.meshes[mesh].sites.empty() || !scene.meshes[mesh].receives) {
      continue;
    }
    std::pmr::vector<std::uint32_t> triangles(memory);
    std::pmr::vector<Box> boxes(memory);
    for (std::uint32_t triangle = 0; triangle < welded.triangles.size(); ++triangle) {
      if (welded.triangles[triangle].mesh == mesh) {
        triangles.push_back(triangle);
        for (const Vec3& corner : positions_of(welded, welded.triangles[triangle])) {
          boxes.resize(triangles.size());
          boxes.back().add(corner);
        }
      }
    }
    const BoxTree tree(boxes, memory);
    for (const Vec3& point : scene.meshes[mesh].sites) {
      double nearest = HUGE_VAL;
      std::uint32_t facet = k_none;
      tree.walk_nearest(
          point, [&] { return nearest; },
          [&](std::uint32_t k) {
            const auto [a, b, c] = positions_of(welded, welded.triangles[triangles[k]]);
            const Vec3 weights = closest_weights(point, a, b, c);
            const Vec3 apart = point - (weights.x * a + weights.y * b + weights.z * c);
            const double distance = dot(apart, apart);
            const std::uint32_t of = facets.facet_of_triangle[triangles[k]];
            if (distance < nearest || (distance == nearest && of < facet)) {
              nearest = distance;
              facet = of;
            }
          });
      if (facet != k_none) {
        found.push_back({facet, facets.facets[facet].frame.to_plane(point)});
      }
    }
  }
  std::pmr::vector<std::uint32_t> order(memory);
  for (std::uint32_t k = 0; k < found.size(); ++k) {
    order.push_back(k);
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return found[a].facet != found[b].facet ? found[a].facet < found[b].facet : a < b;
  });
  std::pmr::vector<GivenSite> sorted(memory);
  for (const std::uint32_t k : order) {
    sorted.push_back(found[k]);
  }
  return sorted;
}

}  // namespace radvor
