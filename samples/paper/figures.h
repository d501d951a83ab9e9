// Pictures of our own after the paper's Figures 1.1 to 1.6.
#pragma once

#include <string>

#include "floor_bake.h"

namespace paper {

void draw_voronoi_and_delaunay(const std::string& file);                                  ///< Figure 1.1
void draw_patches_and_elements(const std::string& file);                                  ///< Figure 1.2
void draw_adaptive_cells(const std::string& file, const Floor& floor);                    ///< Figure 1.3
void draw_wireframes(const std::string& file, const Floor& plain, const Floor& aligned);  ///< Figures 1.4 and 1.6
void draw_shaded(const std::string& file, const Floor& plain, const Floor& aligned,
                 const Experiment& experiment);  ///< 1.5, exact beside

}  // namespace paper
