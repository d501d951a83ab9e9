target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
set(RADVOR_SHARED_DIR "${PROJECT_SOURCE_DIR}/../shared" CACHE PATH "Real scenes; without them a room stands in")
target_compile_definitions(${target} PRIVATE RADVOR_SHARED_DIR="${RADVOR_SHARED_DIR}")
