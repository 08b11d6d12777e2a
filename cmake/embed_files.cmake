# cmake -DROOT= -DHEADER= -DOUTPUT= -DFILES=a|b|c -P embed_files.cmake
# Writes the files as byte arrays: string literals have a length limit in the C++ standard, arrays
# have none. Each ends with a 0 that is not part of it, so that an empty file is an array too.
string(REPLACE "|" ";" files "${FILES}")
set(arrays "")
set(rows "")
set(index 0)
foreach(file IN LISTS files)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  file(RELATIVE_PATH name ${ROOT} ${file})
  string(APPEND arrays "constexpr unsigned char file_${index}[] = {${bytes}0};\n")
  string(APPEND rows "    {\"${name}\", file_${index}, sizeof file_${index} - 1},\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE ${OUTPUT} "// Written by cmake/embed_files.cmake.
#include \"${HEADER}\"

namespace plait::opencl {
namespace {

${arrays}
constexpr EmbeddedFile files[] = {
${rows}};

} // namespace

std::span<const EmbeddedFile> embedded_files() { return files; }

} // namespace plait::opencl
")
