# Windows programs by Debian's g++-mingw-w64-x86-64-posix. MinGW has no OpenCL: the headers are the host's,
# and an import library of what the host's loader exports will do, since Wine's OpenCL.dll hands the same
# functions on to that loader:
#   mkdir -p win/include && ln -s /usr/include/CL win/include
#   { echo LIBRARY OpenCL.dll; echo EXPORTS; nm -D --defined-only /usr/lib/x86_64-linux-gnu/libOpenCL.so.1 |
#     grep -oE ' cl[A-Z][A-Za-z0-9]+'; } >win/OpenCL.def
#   x86_64-w64-mingw32-dlltool -d win/OpenCL.def -l win/libOpenCL.a
#   cmake -S . -B build/windows -G Ninja --toolchain cmake/toolchains/mingw-w64.cmake -DCMAKE_BUILD_TYPE=Release \
#     -DPLAIT_ASSIMP=OFF -DPLAIT_TESTS=OFF -DPLAIT_BENCH=OFF -DPLAIT_EXAMPLES=OFF \
#     -DEigen3_DIR=/usr/share/eigen3/cmake -DOpenCL_INCLUDE_DIR=$PWD/win/include -DOpenCL_LIBRARY=$PWD/win/libOpenCL.a
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -static)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
