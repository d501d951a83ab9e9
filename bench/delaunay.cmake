find_package(CGAL REQUIRED)
target_link_libraries(delaunay_bench PRIVATE CGAL::CGAL)
target_compile_options(delaunay_bench PRIVATE -Wno-conversion -Wno-shadow) # CGAL's headers, instantiated here
