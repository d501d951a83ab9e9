# Scenes are read, and bakes are run, by the parts of radvor-bake; the path tracer beside them uses Embree 3 as Debian has
# it. The recorder stands between the library and Embree, loaded as one.
find_package(embree 3.13 REQUIRED)
find_package(glm REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)

file(GLOB bake_bench_parts CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/bake/*.cpp)
list(FILTER bake_bench_parts EXCLUDE REGEX "ray_recorder\\.cpp$")
target_sources(bake_bench PRIVATE ${bake_bench_parts})
target_link_libraries(bake_bench PRIVATE radvor_bake_parts embree CLI11::CLI11 nlohmann_json::nlohmann_json ${CMAKE_DL_LIBS})

add_library(bake_bench_ray_recorder MODULE ${CMAKE_CURRENT_SOURCE_DIR}/bake/ray_recorder.cpp)
set_target_properties(bake_bench_ray_recorder PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET default)
target_link_libraries(bake_bench_ray_recorder PRIVATE embree ${CMAKE_DL_LIBS})
# Whoever looks in it for what it does not wrap finds Embree's, though the recorder itself names none of that.
target_link_options(bake_bench_ray_recorder PRIVATE "LINKER:--no-as-needed")
radvor_compile_options(bake_bench_ray_recorder)
add_dependencies(bake_bench bake_bench_ray_recorder)
target_compile_definitions(bake_bench PRIVATE RADVOR_RAY_RECORDER="$<TARGET_FILE:bake_bench_ray_recorder>")
