# The drivers of the slow tests, which any CPU can have:
#   rusticl    Mesa's OpenCL on its software renderer: another compiler, another memory layout
#   intel      Intel's OpenCL for CPUs, of any vendor, from PyPI (./dev test --long fetches it)
#   oclgrind   an interpreter that watches every access: bounds, races, uninitialised reads
# Sets PLAIT_RUSTICL and PLAIT_INTEL (.icd files) and PLAIT_OCLGRIND (the program), false where there is none. What is
# absent is left out of the tests, unless PLAIT_NEED_DRIVERS names it: then configuring fails.
set(PLAIT_NEED_DRIVERS "" CACHE STRING "Drivers that must be here to be tested on: some of rusticl, intel, oclgrind")
set(PLAIT_RUSTICL_ICD /etc/OpenCL/vendors/rusticl.icd CACHE FILEPATH "How the OpenCL loader finds rusticl")
set(PLAIT_INTEL_ICD ${CMAKE_SOURCE_DIR}/build/intel/intel.icd CACHE FILEPATH
    "How the OpenCL loader finds Intel's driver; its libraries lie in lib/ beside this file")

foreach(driver RUSTICL INTEL)
  set(PLAIT_${driver} FALSE)
  if(EXISTS ${PLAIT_${driver}_ICD})
    set(PLAIT_${driver} ${PLAIT_${driver}_ICD})
  endif()
endforeach()
if(PLAIT_INTEL)
  cmake_path(GET PLAIT_INTEL PARENT_PATH directory)
  set(PLAIT_INTEL_ENVIRONMENT "OCL_ICD_VENDORS=${PLAIT_INTEL};LD_LIBRARY_PATH=${directory}/lib")
endif()

# Once found it is looked for no more, though its package may be gone.
if(PLAIT_OCLGRIND AND NOT EXISTS ${PLAIT_OCLGRIND})
  unset(PLAIT_OCLGRIND CACHE)
endif()
find_program(PLAIT_OCLGRIND oclgrind)

foreach(driver ${PLAIT_NEED_DRIVERS})
  string(TOUPPER PLAIT_${driver} found)
  if(NOT driver MATCHES "^(rusticl|intel|oclgrind)$")
    message(FATAL_ERROR "PLAIT_NEED_DRIVERS names '${driver}'; there are rusticl, intel and oclgrind")
  elseif(NOT ${found})
    message(FATAL_ERROR "${driver} is not here, and PLAIT_NEED_DRIVERS says that it is tested on: install it "
                        "(Debian: mesa-opencl-icd has rusticl, oclgrind itself; PyPI: intel-opencl-rt) or take it off that list")
  endif()
endforeach()
message(STATUS "Slow drivers to test on: rusticl ${PLAIT_RUSTICL}, Intel ${PLAIT_INTEL}, Oclgrind ${PLAIT_OCLGRIND}")
