#!/usr/bin/env bash
# arrows.sh ROOT: every #include below ROOT follows an arrow of the architecture (CONTRIBUTING.md).
# Prints each one that does not, as file:line: message, and fails.
set -euo pipefail
cd "$1"

# layer: the layers and third-party headers it may include. Its own files are always allowed.
# `face` is include/plait, `shared` is cl/shared; what is in neither column is the language's own.
arrows='
base               face shared
backend            face shared base
backend/reference  face shared base backend Eigen
backend/opencl     face shared base backend CL
core               face shared base backend Eigen
io                 face shared base core assimp
api                face shared base backend core io
face               face shared CL
examples           face CL
tools              face assets CL CLI Eigen nlohmann embree cairo assimp
assets             face CLI
cases              face shared
bench              face shared assets benchmark nlohmann
'

sources() { # the files that belong to a layer
    { find lib include examples tools assets tests/cases tests/bench -type f \
        \( -name '*.c' -o -name '*.h' -o -name '*.cpp' -o -name '*.hpp' \) 2>/dev/null || true; } | sort
}

sources | xargs --no-run-if-empty grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]' /dev/null |
    awk -v arrows="$arrows" '
    function layer_of_file(path) {
        if (match(path, /^lib\/backend\/(reference|opencl)\//)) return substr(path, 5, RLENGTH - 5)
        if (path ~ /^lib\//) { split(path, part, "/"); return part[2] }
        if (path ~ /^include\//) return "face"
        if (path ~ /^tests\//) { split(path, part, "/"); return part[2] }
        split(path, part, "/"); return part[1]
    }
    # "" for the language'\''s own headers and for files beside the includer
    function layer_of_include(name, quoted) {
        if (name ~ /^plait\/(params\.h|constants\.h|(stages|buffers)\.def)$/) return "shared"
        if (name ~ /^plait\//) return "face"
        if (match(name, /^backend\/(reference|opencl)\//)) return substr(name, 1, RLENGTH - 1)
        if (name ~ /^(base|backend|core|io|api|assets)\//) { split(name, part, "/"); return part[1] }
        if (name ~ /^generator\//) return "assets"
        if (name ~ /^(Eigen|CL|CLI|assimp|nlohmann|benchmark)\//) { split(name, part, "/"); return part[1] }
        if (name ~ /^OpenCL\//) return "CL"
        if (name ~ /^embree[34]\//) return "embree"
        if (name ~ /^cairo\.h$/) return "cairo"
        return ""
    }
    BEGIN {
        lines = split(arrows, line, "\n")
        for (i = 1; i <= lines; i++) {
            words = split(line[i], word, " ")
            if (words) known[word[1]] = 1
            for (j = 1; j <= words; j++) allowed[word[1], word[j]] = 1
        }
    }
    {
        split($0, at, ":")
        match($0, /[<"][^>"]*/)
        name = substr($0, RSTART + 1, RLENGTH - 1)
        from = layer_of_file(at[1]); to = layer_of_include(name)
        seen++
        if (!(from in known)) { print at[1] ":" at[2] ": no layer is called " from; bad++ }
        else if (to != "" && !((from, to) in allowed)) {
            print at[1] ":" at[2] ": " from " must not include " name " (" to ")"; bad++
        }
    }
    END {
        if (!seen) { print "no #include found: wrong root?"; exit 1 }
        print seen " includes, " bad + 0 " against the arrows"
        exit bad > 0
    }'
