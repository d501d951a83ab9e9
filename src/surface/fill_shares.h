// What shares are, once their facets have triangles: cells, albedo, normals and receivers of both sides.
#pragma once

#include <cstdint>
#include <span>

#include "base/steps.h"
#include "surface/surface_parts.h"

namespace radvor {

/// Of facets whose drafts are still there; lets go what is not needed of them any more.
Steps fill_shares(SurfaceParts& parts, std::span<const std::uint32_t> facets, Pace& pace);

}  // namespace radvor
