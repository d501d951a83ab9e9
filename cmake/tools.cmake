# What makes builds faster where it is installed, and the sanitizers a preset asks for.
if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(RADVOR_CCACHE ccache)
  if(RADVOR_CCACHE)
    set(CMAKE_C_COMPILER_LAUNCHER ${RADVOR_CCACHE})
    set(CMAKE_CXX_COMPILER_LAUNCHER ${RADVOR_CCACHE})
  endif()
endif()

find_program(RADVOR_MOLD mold)
if(RADVOR_MOLD AND NOT APPLE AND NOT WIN32)
  add_link_options(-fuse-ld=mold)
endif()

set(RADVOR_SANITIZERS "" CACHE STRING "Sanitizers for all that is built: address,undefined or thread")
if(RADVOR_SANITIZERS)
  add_compile_options(-fsanitize=${RADVOR_SANITIZERS} -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${RADVOR_SANITIZERS})
endif()
if(RADVOR_BUILD_FUZZERS)
  add_compile_options(-fsanitize=fuzzer-no-link) # coverage for all code; the targets bring libFuzzer's main
endif()
