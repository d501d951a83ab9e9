# Headers that nearly every source of a target includes, parsed once instead of once a source. Sources still say what
# they need: the library is built without in what ships.
function(radvor_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <limits> <map> <memory_resource> <optional> <random> <span> <string> <vector>
    ${PROJECT_SOURCE_DIR}/src/base/vector.h ${ARGN})
endfunction()
