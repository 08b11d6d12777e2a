# cpack: packages of what `cmake --install` installs. Debian's are three: libplait0, what a program needs that links
# plait; libplait-dev, what it is built with; plait-tools, the programs. Elsewhere an archive of all.
set(CPACK_PACKAGE_NAME plait)
set(CPACK_PACKAGE_VENDOR plait)
set(CPACK_PACKAGE_CONTACT "The authors of plait <plait@localhost>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
if(PLAIT_TOOLS)
  list(APPEND CPACK_COMPONENTS_ALL tools)
endif()
if(WIN32)
  set(CPACK_GENERATOR ZIP)
  include(CPack)
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON) # so that packages of programs that link it find its name
get_target_property(plait_dir plait BINARY_DIR)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${plait_dir})

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libplait0)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Real-time hair simulation on any OpenCL device")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
# Any OpenCL driver will do; this one runs on every machine.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libplait-dev)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Real-time hair simulation: C and C++ headers, find_package, pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime)

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME plait-tools)
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "Real-time hair simulation: plait-simulate, which simulates and draws grooms, and plait-groom, which makes and converts them")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_TOOLS_DEPENDS runtime)
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "ffmpeg, fonts-dejavu-core")
include(CPack)
