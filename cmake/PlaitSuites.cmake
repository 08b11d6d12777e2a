# plait_discover_suites(PROGRAM PREFIX P [APART REGEX] [FILTER F]): a test of ctest for each suite of a GoogleTest program,
# named P and the suite, where gtest_discover_tests makes one of each test. Contexts of a process share the kernels
# that they built, and to get them anew takes longer than most tests. Suites whose names match REGEX, those that run
# for long, are tests one by one. F: as of --gtest_filter, what is left out ("-A*:B*"), or "".
function(plait_discover_suites program)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "PREFIX;APART;FILTER" "")
  set(list "${CMAKE_CURRENT_BINARY_DIR}/${program}_suites.cmake")
  file(GENERATE OUTPUT "${list}" CONTENT "\
set(program [==[$<TARGET_FILE:${program}>]==])
set(command [==[${CMAKE_CROSSCOMPILING_EMULATOR}]==] \${program})
list(REMOVE_ITEM command \"\")
set(prefix [==[${ARG_PREFIX}]==])
set(apart [==[${ARG_APART}]==])
set(filter [==[${ARG_FILTER}]==])
include([==[${PROJECT_SOURCE_DIR}/cmake/PlaitListSuites.cmake]==])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${list}")
endfunction()
