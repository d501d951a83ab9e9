// Sites that the host gives: points on meshes, found on the facets that they lie on.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

struct GivenSite {
  std::uint32_t facet;
  Vec2 position;  ///< in the facet's plane, snapped as all coordinates there
};

/// By facet, and in each in the order given. Those in the mesh's triangles that welding dropped are missing.
std::pmr::vector<GivenSite> find_given_sites(const Scene& scene, const WeldedScene& welded, const Facets& facets,
                                             std::pmr::memory_resource* memory);

}  // namespace radvor
