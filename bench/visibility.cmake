target_link_libraries(visibility_bench PRIVATE radvor_core) # rays alone are no business of the C ABI
