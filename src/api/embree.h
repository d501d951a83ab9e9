// The context's Embree: loaded for its first bake, so that who only triangulates needs none.
#pragma once

#include "api/entry.h"
#include "visibility/embree_library.h"

namespace radvor::api {

/// Throws RADVOR_ERROR_UNSUPPORTED where there is none that will do; the next bake tries again.
const EmbreeLibrary& embree_of(const radvor_context& context);

}  // namespace radvor::api
