# The drivers of the slow tests, which any CPU can have:
#   rusticl    Mesa's OpenCL on its software renderer: another compiler, another memory layout
#   oclgrind   an interpreter that watches every access: bounds, races, uninitialised reads
# Sets PLAIT_RUSTICL (its .icd file) and PLAIT_OCLGRIND (the program), false where there is none. What is
# absent is left out of the tests, unless PLAIT_NEED_DRIVERS names it: then configuring fails.
set(PLAIT_NEED_DRIVERS "" CACHE STRING "Drivers that must be here to be tested on: rusticl, oclgrind, both or none")
set(PLAIT_RUSTICL_ICD /etc/OpenCL/vendors/rusticl.icd CACHE FILEPATH "How the OpenCL loader finds rusticl")

set(PLAIT_RUSTICL FALSE)
if(EXISTS ${PLAIT_RUSTICL_ICD})
  set(PLAIT_RUSTICL ${PLAIT_RUSTICL_ICD})
endif()

# Once found it is looked for no more, though its package may be gone.
if(PLAIT_OCLGRIND AND NOT EXISTS ${PLAIT_OCLGRIND})
  unset(PLAIT_OCLGRIND CACHE)
endif()
find_program(PLAIT_OCLGRIND oclgrind)

foreach(driver ${PLAIT_NEED_DRIVERS})
  string(TOUPPER PLAIT_${driver} found)
  if(NOT driver MATCHES "^(rusticl|oclgrind)$")
    message(FATAL_ERROR "PLAIT_NEED_DRIVERS names '${driver}'; there are rusticl and oclgrind")
  elseif(NOT ${found})
    message(FATAL_ERROR "${driver} is not here, and PLAIT_NEED_DRIVERS says that it is tested on: install it "
                        "(Debian: mesa-opencl-icd has rusticl, oclgrind itself) or take it off that list")
  endif()
endforeach()
message(STATUS "Slow drivers to test on: rusticl ${PLAIT_RUSTICL}, Oclgrind ${PLAIT_OCLGRIND}")
