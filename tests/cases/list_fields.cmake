# cmake -DHEADER=params.h -DOUTPUT=fields.inc -P list_fields.cmake
# One PLAIT_FIELD(struct, field) for each field of each parameter struct, and PLAIT_FIELDS_OF(struct)
# after each struct's fields, so that the layout test cannot forget one.
file(READ ${HEADER} text)
string(REGEX REPLACE "/\\*[^*]*\\*+([^/*][^*]*\\*+)*/" "" text "${text}")
string(REPLACE ";" "@" text "${text}") # CMake's own separator
string(REGEX MATCHALL "typedef struct [a-z_]+ {[^}]*}" structs "${text}")
set(list "")
foreach(struct IN LISTS structs)
  string(REGEX REPLACE "typedef struct ([a-z_]+) .*" "\\1" name "${struct}")
  string(REGEX MATCHALL "[a-z_0-9]+(\\[[0-9]+\\])*@" fields "${struct}")
  foreach(field IN LISTS fields)
    string(REGEX REPLACE "[\\[@].*" "" field "${field}")
    string(APPEND list "PLAIT_FIELD(${name}, ${field})\n")
  endforeach()
  string(APPEND list "PLAIT_FIELDS_OF(${name})\n")
endforeach()
file(WRITE ${OUTPUT} "${list}")
