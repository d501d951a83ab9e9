// What an edge means for the light: nothing, a change of texture map, a smooth or a sharp bend.
#pragma once

#include "scene/corner_normals.h"
#include "scene/facets.h"
#include "scene/scene.h"
#include "scene/welded.h"

namespace radvor {

/// Whether exactly two triangles run the edge, in opposite directions.
bool is_manifold(const WeldedScene& welded, std::uint32_t edge);

/// Whether the vertex colours of the two uses of a manifold edge are the same along it.
bool same_colors_along(const Scene& scene, const WeldedScene& welded, std::uint32_t edge);

/// The kinds of all edges, from facets and their frames and the given normals. joins: edges that facets grew over.
void classify_edges(const Scene& scene, const WeldedScene& welded, const std::pmr::vector<bool>& joins,
                    double crease_angle, Facets& facets);

}  // namespace radvor
