// radvor_bake_options, checked, with every default resolved: the one place that knows them.
#pragma once

#include <radvor.h>

#include "radiosity/bake.h"

namespace radvor::api {

/// NULL: all defaults. Throws RADVOR_ERROR_INVALID_ARGUMENT naming the option. `as_given` gets the struct as this
/// library knows it, for its progress callback.
BakeOptions resolve_options(const radvor_bake_options* options, radvor_bake_options& as_given);

}  // namespace radvor::api
