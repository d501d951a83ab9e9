// Makes all parts of a surface from a scene's facets.
#pragma once

#include "surface/surface_parts.h"

namespace radvor {

void make_surface(SurfaceParts& parts);

}  // namespace radvor
