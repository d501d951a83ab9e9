target_link_libraries(predicates_fuzz PRIVATE gmpxx gmp)
