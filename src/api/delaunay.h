// What radvor_delaunay points to.
#pragma once

#include <radvor.h>

#include "api/entry.h"
#include "delaunay/triangulation.h"

struct radvor_delaunay {
  explicit radvor_delaunay(radvor_context* from);

  radvor_context* context;
  radvor::delaunay::Triangulation triangulation;
};
