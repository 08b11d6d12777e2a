#!/usr/bin/env bash
# sizes.sh must accept what is small or excepted and name what is too large, and what is excepted in vain.
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/sizes.sh
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
cd "$root"

plant() { # FILE LINES
    rm -rf "${root:?}"/*
    mkdir -p cl lib tests/cases "$(dirname "$1")"
    seq "$2" >"$1"
}
must_pass() { "$check" "$root" >output || { echo "refused: $1"; cat output; exit 1; }; }
must_name() {
    if "$check" "$root" >output; then echo "let through: $1"; exit 1; fi
    grep -qF "$1: " output || { echo "did not name $1"; cat output; exit 1; }
}

plant cl/wind/wind_field.cl 350
must_pass "a file of 350 lines"
plant cl/wind/wind_field.cl 351
must_name cl/wind/wind_field.cl
plant lib/core/contact/colliders.cpp 351
must_name lib/core/contact/colliders.cpp
plant cl/mesh/mesh_nearest.cl 351
must_pass "an exception"
plant cl/mesh/mesh_nearest.cl 350
must_name cl/mesh/mesh_nearest.cl
for folder in cl/wind lib/backend/reference/wind tests/cases/wind; do
    plant $folder/0.cpp 1
    for i in $(seq 19); do echo >"$folder/$i.cpp"; done
    echo >$folder/a.hpp
    must_pass "a folder of 20 files and one"
    echo >$folder/20.cpp
    must_name "$folder/*.cpp"
done
echo ok
