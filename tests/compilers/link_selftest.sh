#!/usr/bin/env bash
# link_selftest.sh CLANG: link.sh accepts a kernel whose functions are all defined and names what is not.
set -euo pipefail
link=$(cd "$(dirname "$0")" && pwd)/link.sh
texts=$(mktemp -d)
trap 'rm -rf "$texts"' EXIT
{
    echo "k 1 16 k -cl-std=CL1.2"
    echo "k 16 16 k -cl-std=CL1.2"
} >"$texts/list.txt"

# plant QUALIFIERS BODY: a kernel that calls a built-in function and `double_of`, declared so.
plant() { echo "$1 float double_of(float x)$2 __kernel void k(__global float* x) { x[get_global_id(0)] = double_of(sqrt(x[0])); }" >"$texts/k.cl"; }
must_pass() { "$link" "$1" "$texts" "$2" "$3" >/dev/null || { echo "refused for $2 at -O$3"; exit 1; }; }
must_name() {
    if "$link" "$1" "$texts" "$2" "$3" >"$texts/output"; then echo "let through for $2 at -O$3: $4"; exit 1; fi
    [ "$(grep -c "lanes, 16 vertices): .*$4" "$texts/output")" -eq 2 ] || { echo "did not name $4"; cat "$texts/output"; exit 1; }
}

body=' { return 2.0f * x; }'
for target in spir64 amdgcn; do
    for level in 0 3; do
        plant 'static inline' "$body"
        must_pass "$1" $target $level
        # Nothing is inlined at -O0, nor here: C99 leaves a plain inline function to another file.
        plant '__attribute__((noinline)) inline' "$body"
        must_name "$1" $target $level double_of
        plant '__attribute__((overloadable))' ';'
        must_name "$1" $target $level _Z9double_off
        plant 'static inline' ' { return 2.0f * y; }'
        must_name "$1" $target $level 'does not build' 2>/dev/null
    done
    plant inline "$body"
    must_name "$1" $target 0 double_of
done
echo ok
