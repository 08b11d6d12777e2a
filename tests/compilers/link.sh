#!/usr/bin/env bash
# link.sh CLANG TEXTS TARGET LEVEL: every program that kernel_texts wrote into the folder TEXTS compiles for
# TARGET (spir64 or amdgcn) with -OLEVEL, and leaves no symbol undefined but OpenCL's built-in functions, which
# a driver links in. What a driver's own linker says is asked of lld for amdgcn at one lane, the width of a
# GPU; of the others the undefined symbols are read in the compiler's intermediate code: SPIR has no linker,
# and GPUs' registers hold no 16 lanes.
set -euo pipefail
clang=$1 texts=$2 target=$3 level=$4
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT

# Names of built-in functions, from the header that clang brings along.
grep -oE '\b[a-z][a-z0-9_]*\(' "$("$clang" -print-resource-dir)/include/opencl-c.h" | tr -d '(' | sort -u >"$here/builtins"

# Mangled symbols of standard input that are not a built-in's: _Z3sqrtf is sqrt's.
foreign() {
    while read -r symbol; do
        if [[ $symbol =~ ^_Z([0-9]+)(.*)$ ]] &&
            grep -qxF "${BASH_REMATCH[2]:0:BASH_REMATCH[1]}" "$here/builtins"; then
            continue
        fi
        echo "$symbol"
    done
}

undefined_in_code() { sed -nE 's/^declare .*@([A-Za-z0-9_.$]+)\(.*/\1/p' "$1" | { grep -v '^llvm\.' || true; }; }

# What lld misses, one symbol a line; whatever else it says is an error.
undefined_in_link() {
    local linker
    linker=$("$clang" -print-prog-name=ld.lld)
    if "$linker" -shared --no-undefined --error-limit=0 --no-demangle "$1" -o "$1.so" 2>"$here/lld"; then return; fi
    grep 'error:' "$here/lld" | grep -v 'error: undefined' >&2 && return 1
    sed -nE 's/.*error: undefined[a-z ]* symbol: (.*)/\1/p' "$here/lld"
}

compile() {
    local stage=$1 output=$2
    shift 2
    local arguments=(-x cl -target spir64)
    if [ "$target" = amdgcn ]; then arguments=(-x cl -target amdgcn-amd-amdhsa -mcpu=gfx906 -nogpulib); fi
    "$clang" "${arguments[@]}" -Wno-unused-command-line-argument "-O$level" "$@" "$texts/$stage.cl" -o "$output"
}

bad=0 seen=0
while read -r stage lanes vertices _ options; do
    seen=$((seen + 1))
    # shellcheck disable=SC2086  # several options
    if [ "$target" = amdgcn ] && [ "$lanes" -eq 1 ]; then
        compile "$stage" "$here/object" -c $options && undefined_in_link "$here/object" >"$here/undefined"
    else
        compile "$stage" "$here/code" -S -emit-llvm $options && undefined_in_code "$here/code" >"$here/undefined"
    fi || { echo "$stage ($lanes lanes, $vertices vertices): does not build for $target at -O$level" && bad=1 && continue; }
    missing=$(foreign <"$here/undefined" | sort -u | tr '\n' ' ')
    if [ -n "$missing" ]; then
        echo "$stage ($lanes lanes, $vertices vertices): undefined for $target at -O$level: $missing"
        bad=1
    fi
done <"$texts/list.txt"
echo "$seen programs for $target at -O$level, by $("$clang" --version | head -1)"
[ $bad -eq 0 ] && [ $seen -gt 0 ]
