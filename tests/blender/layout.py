"""layout.py CC INCLUDE: each struct of capi.py has the fields, offsets and sizes that a C compiler gives its namesake."""
import ctypes
import subprocess
import sys

from plait_hair import capi

compiler, include = sys.argv[1:]
structs = [*capi.PLAIN, *capi.Versioned.__subclasses__()]
lines = ["#include <plait/plait.h>", "#include <plait/plait_offline.h>", "#include <plait/plait_recorder.h>",
         "#include <stdio.h>", "int main(void) {"]
expected = []
for struct in structs:
    lines.append(f'printf("{struct.NAME} %zu\\n", sizeof({struct.NAME}));')
    expected.append(f"{struct.NAME} {ctypes.sizeof(struct)}")
    for name, kind in struct._fields_:
        lines.append(f'printf("{struct.NAME}.{name} %zu %zu\\n", offsetof({struct.NAME}, {name}), '
                     f"sizeof((({struct.NAME}*)0)->{name}));")
        expected.append(f"{struct.NAME}.{name} {getattr(struct, name).offset} {ctypes.sizeof(kind)}")
for name, value in (("MESH_FIELD_SOURCES", capi.SOURCES), ("FIELD_POSITION", capi.POSITION),
                    ("MESH_FORM_FIELD", capi.FIELD), ("MESH_FORM_NEAREST", capi.NEAREST)):
    lines.append(f'printf("{name} %d\\n", PLAIT_{name});')
    expected.append(f"{name} {value}")
with open("layout.c", "w") as file:
    file.write("\n".join([*lines, "return 0;", "}"]))
subprocess.run([compiler, "-std=c99", f"-I{include}", "-DPLAIT_STATIC", "-c", "layout.c", "-o", "layout.o"], check=True)
# plait.h's inline functions name the _init of every struct, which nothing here calls.
subprocess.run([compiler, "-Wl,--unresolved-symbols=ignore-all", "layout.o", "-o", "layout"], check=True)
found = subprocess.run(["./layout"], check=True, capture_output=True, text=True).stdout.splitlines()
wrong = [f"{a}, in C {b}" for a, b in zip(expected, found, strict=True) if a != b]
print(f"{len(structs)} structs, {len(found)} lines, {len(wrong)} differ")
assert not wrong, "\n".join(wrong)
