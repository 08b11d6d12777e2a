# cmake -DCASE=equal|dies -DMPIRUN=... -DPROGRAM=09_cluster -P ranks.cmake: the program of 1, 2 and 4 ranks prints the
# same sum of all strands after 100 steps; of one that loses a rank all ranks end, with a sentence, within 10 s.
if(NOT EXISTS "${MPIRUN}" OR NOT EXISTS "${PROGRAM}")
  message("skipped: no mpirun, or built without MPI; Debian's packages are openmpi-bin and libopenmpi-dev")
  return()
endif()

function(run ranks)
  execute_process(COMMAND ${MPIRUN} --oversubscribe --allow-run-as-root -n ${ranks} ${PROGRAM} ${ARGN}
                  RESULT_VARIABLE result OUTPUT_VARIABLE printed ERROR_VARIABLE errors TIMEOUT ${seconds})
  message("${printed}${errors}")
  set(result "${result}" PARENT_SCOPE)
  set(printed "${printed}" PARENT_SCOPE)
  set(errors "${errors}" PARENT_SCOPE)
endfunction()

if(CASE STREQUAL "dies")
  set(seconds 10)
  run(2 301 400 1) # the other rank would wait in the 201st step for ever
  if(result STREQUAL "0" OR result MATCHES "timeout")
    message(FATAL_ERROR "it ends with ${result}")
  elseif(NOT errors MATCHES "process rank 1 .* exited")
    message(FATAL_ERROR "no sentence names the rank")
  endif()
  return()
endif()

set(seconds 300)
foreach(ranks 1 2 4)
  run(${ranks} 301 100) # not a multiple of the ranks
  if(NOT result STREQUAL "0" OR NOT printed MATCHES "${ranks} ranks, .* sum ([0-9a-f]+)")
    message(FATAL_ERROR "it ends with ${result}")
  endif()
  list(APPEND sums ${CMAKE_MATCH_1})
endforeach()
list(REMOVE_DUPLICATES sums)
list(LENGTH sums different)
if(NOT different EQUAL 1)
  message(FATAL_ERROR "the sums differ: ${sums}")
endif()
