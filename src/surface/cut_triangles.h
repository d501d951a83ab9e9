// What a facet is made of where its plane fails it: its own triangles, each cut along its sides by the border's sites.
// Decided by topology and distances in space alone, so it works for triangles of no area too, and neighbours fit.
#pragma once

#include <memory_resource>
#include <vector>

#include "surface/facet_draft.h"
#include "surface/surface.h"

namespace radvor {

/// Each corner of each triangle made is a share of its own (3 a triangle, in order), with its cell in that triangle;
/// those at one site are joined to one sample. triangles: gets the shares' numbers.
void cut_triangles(const FacetInput& input, std::pmr::vector<ShareTriangle>& triangles, FacetDraft& draft);

}  // namespace radvor
