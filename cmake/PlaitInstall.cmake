# cmake --install: the library, its headers, find_package(plait) and plait.pc; and the programs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(face ${PROJECT_SOURCE_DIR}/include/plait)
file(GLOB headers CONFIGURE_DEPENDS ${face}/*.h ${face}/*.hpp)
if(NOT PLAIT_OPENCL)
  list(REMOVE_ITEM headers ${face}/plait_opencl.h)
endif()
install(FILES ${headers} ${PROJECT_SOURCE_DIR}/cl/shared/plait/params.h
              ${PROJECT_SOURCE_DIR}/cl/shared/plait/constants.h
              ${PROJECT_SOURCE_DIR}/cl/shared/plait/stages.def ${PROJECT_SOURCE_DIR}/cl/shared/plait/buffers.def
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plait COMPONENT development)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/plait)
install(TARGETS plait EXPORT plait
        LIBRARY COMPONENT runtime NAMELINK_COMPONENT development
        RUNTIME COMPONENT runtime ARCHIVE COMPONENT development)
install(EXPORT plait NAMESPACE plait:: FILE plaitTargets.cmake DESTINATION ${package_dir} COMPONENT development)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/plaitConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/plaitConfig.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the API.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/plaitConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plaitConfig.cmake ${PROJECT_BINARY_DIR}/plaitConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT development)

# The compiler's C++ library, of which a linker of C knows nothing.
set(runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER runtime INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|m)$")
list(REMOVE_DUPLICATES runtime)
list(TRANSFORM runtime PREPEND -l)
list(JOIN runtime " " pc_private)
if(PLAIT_OPENCL)
  string(PREPEND pc_private "-lOpenCL ")
endif()
if(PLAIT_ASSIMP)
  string(PREPEND pc_private "-lassimp ")
endif()
set(pc_cflags "")
if(NOT BUILD_SHARED_LIBS)
  set(pc_cflags " -DPLAIT_STATIC")
endif()
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_prefix ${pc_prefix})
configure_file(${CMAKE_CURRENT_LIST_DIR}/plait.pc.in ${PROJECT_BINARY_DIR}/plait.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/plait.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

# Debian wants the licence under each package's own name.
foreach(part runtime:libplait0 development:libplait-dev tools:plait-tools)
  string(REPLACE ":" ";" part ${part})
  list(GET part 0 component)
  list(GET part 1 package)
  if(NOT component STREQUAL tools OR PLAIT_TOOLS)
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright
            COMPONENT ${component})
  endif()
endforeach()
