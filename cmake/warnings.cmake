# The warnings that every target of ours is clean of, and the floating-point contract: expressions are rounded as
# written (contraction to fused multiply-add breaks the expansions of the exact predicates).
function(radvor_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow -ffp-contract=off)
  if(RADVOR_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
