# Headers that nearly every source of a target includes, parsed once instead of once a source. The library in what ships
# is built without: there each source must say what it needs. ccache wants CCACHE_SLOPPINESS=pch_defines,time_macros.
function(radvor_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <limits> <map> <memory_resource> <optional> <random> <span> <string> <vector>
    ${PROJECT_SOURCE_DIR}/src/base/vector.h ${ARGN})
endfunction()
