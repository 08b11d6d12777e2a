#!/usr/bin/env bash
# bare.sh SOURCE BUILD GENERATOR CMAKE-OPTIONS...: plait static and with every option off builds, simulates on
# the reference, and says of what it lacks that it lacks it.
set -euo pipefail
source=$1 build=$2 generator=$3
shift 3
cmake -S "$source" -B "$build" -G "$generator" -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=OFF \
    -DPLAIT_OPENCL=OFF -DPLAIT_ASSIMP=OFF -DPLAIT_PICTURES=OFF -DPLAIT_TESTS=OFF -DPLAIT_BENCH=OFF "$@"
cmake --build "$build" --target plait-simulate
simulate=$build/bin/plait-simulate
out=$build/out
rm -rf "$out"

# says TEXT COMMAND...: COMMAND fails for the user to mend, and its message has TEXT.
says() {
    local text=$1 code=0 said
    shift
    said=$("$@" 2>&1) || code=$?
    [ "$code" -eq 1 ] && [[ $said == *"$text"* ]] || {
        echo "exit $code, without \"$text\": $said"
        exit 1
    }
}

touch "$build/hair.obj"
says "hair.obj: polylines need assimp" "$simulate" --out "$out" --groom "$build/hair.obj"
says "opencl" "$simulate" --out "$out" --strands 8 --backend opencl
"$simulate" --out "$out" --strands 8 --seconds 0.05 2>&1 | tee "$build/log"
grep -q "built without pictures" "$build/log"
grep -q reference "$build/log"
[ -s "$out/stats.json" ] && [ ! -e "$out/sheet.png" ]
