# plait_warnings(target): the warnings every target of plait is built with, by the compiler's own names.
function(plait_warnings target)
  if(MSVC)
    target_compile_options(${target} PRIVATE /W4 $<$<BOOL:${PLAIT_WERROR}>:/WX>)
  else()
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                             $<$<BOOL:${PLAIT_WERROR}>:-Werror>)
  endif()
endfunction()
