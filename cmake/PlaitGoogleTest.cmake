# Builds GoogleTest from PLAIT_GOOGLETEST with the compiler of the tests, and has find_package(GTest) give it.
include(FetchContent)
FetchContent_Declare(GTest SOURCE_DIR ${PLAIT_GOOGLETEST} OVERRIDE_FIND_PACKAGE)

function(plait_googletest)
  # Its options heed these only from a newer policy than it asks for.
  set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)
  set(BUILD_SHARED_LIBS OFF)
  set(INSTALL_GTEST OFF)
  FetchContent_MakeAvailable(GTest)
endfunction()
plait_googletest()
