# plait_embed(target ROOT dir HEADER "declares EmbeddedFile" FILES files...): compiles the files'
# bytes into `target`, named by their path from ROOT. A changed file is embedded again by the build.
function(plait_embed target)
  cmake_parse_arguments(ARG "" "ROOT;HEADER" "FILES" ${ARGN})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake)
  list(JOIN ARG_FILES "|" joined)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DROOT=${ARG_ROOT} -DHEADER=${ARG_HEADER} -DOUTPUT=${output}
            -DFILES=${joined} -P ${script}
    DEPENDS ${ARG_FILES} ${script}
    COMMENT "Embedding kernels"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
