target_sources(delaunay_bench PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/delaunay/measure.cpp ${CMAKE_CURRENT_SOURCE_DIR}/delaunay/points.cpp)
target_include_directories(delaunay_bench PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
find_package(CGAL REQUIRED)
target_link_libraries(delaunay_bench PRIVATE CGAL::CGAL)
target_compile_options(delaunay_bench PRIVATE -Wno-conversion -Wno-shadow) # CGAL's headers, instantiated here
