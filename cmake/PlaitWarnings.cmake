# plait_warnings(target): the warnings every target of plait is built with.
function(plait_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                           $<$<BOOL:${PLAIT_WERROR}>:-Werror>)
endfunction()
