#!/usr/bin/env bash
# arrows.sh ROOT: every #include below ROOT follows an arrow of the architecture (CONTRIBUTING.md),
# from layer to layer and, within the layers that are divided into rooms, from room to room.
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
cl                 shared
cases              face shared
bench              face shared assets benchmark nlohmann
'

# room: the rooms that it may include, on each floor that is divided into rooms. Rooms of one level know
# nothing of each other: what two of them need lies in base, or in a room below both.
rooms='
base
groom              base
push               base
mesh               base groom
contact            base mesh
strands            base groom contact
pins               base strands
wetness            base strands
strand_contact     base strands
grid               base groom contact mesh strands
roots              base groom mesh strands
follows            base groom contact mesh strands
levels             base groom follows strands
tressfx            base contact push strands
params             base groom strands
wind               base contact grid push
volume             base contact grid strands
output             base follows groom levels roots strands
sim                base groom push mesh contact strands pins wetness strand_contact grid roots follows levels tressfx params wind volume output
snapshot           base strands params sim
'

sources() { # the files that belong to a layer
    { find lib include examples tools assets tests/cases tests/bench -type f \
        \( -name '*.c' -o -name '*.h' -o -name '*.cpp' -o -name '*.hpp' \) 2>/dev/null || true
      find cl -type f \( -name '*.cl' -o -name '*.clh' \) 2>/dev/null || true; } | sort
}

sources | xargs --no-run-if-empty grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]' /dev/null |
    awk -v arrows="$arrows" -v rooms="$rooms" '
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
        if (name ~ /\.clh$/) return "cl"
        if (match(name, /^backend\/(reference|opencl)\//)) return substr(name, 1, RLENGTH - 1)
        if (name ~ /^(base|backend|core|io|api|assets)\//) { split(name, part, "/"); return part[1] }
        if (name ~ /^generator\//) return "assets"
        if (name ~ /^(Eigen|CL|CLI|assimp|nlohmann|benchmark)\//) { split(name, part, "/"); return part[1] }
        if (name ~ /^OpenCL\//) return "CL"
        if (name ~ /^embree[34]\//) return "embree"
        if (name ~ /^cairo\.h$/) return "cairo"
        return ""
    }
    # The floor of a path or of a quoted name, as the path of its folder. Names of kernels and of cases
    # begin with the room.
    function floor_of_file(path) {
        return match(path, /^(cl|lib\/backend\/reference|lib\/core|tests\/cases)\//) ? substr(path, 1, RLENGTH) : ""
    }
    function floor_of_include(floor, name) {
        if (floor ~ /^lib\//) return index(name, substr(floor, 5)) == 1 ? substr(floor, 5) : "elsewhere"
        return name ~ /^plait\// ? "elsewhere" : ""
    }
    function room_of(name) { return name ~ /\// ? substr(name, 1, index(name, "/") - 1) : "base" }
    function complain(about) { print at[1] ":" at[2] ": " about; bad++ }
    function read_table(table, known, allowed,    i, j, lines, line, words, word) {
        lines = split(table, line, "\n")
        for (i = 1; i <= lines; i++) {
            words = split(line[i], word, " ")
            if (words) known[word[1]] = 1
            for (j = 1; j <= words; j++) allowed[word[1], word[j]] = 1
        }
    }
    function check_rooms(path, name,    floor, inner, from, to) {
        floor = floor_of_file(path)
        if (floor == "") return
        inner = floor_of_include(floor, name)
        from = room_of(substr(path, length(floor) + 1))
        if (!(from in room)) { complain("no room is called " from); return }
        if (inner == "elsewhere") return
        to = room_of(substr(name, length(inner) + 1))
        if (!(to in room)) complain("no room is called " to)
        else if (!((from, to) in may)) complain("room " from " must not include " name " (" to ")")
    }
    BEGIN {
        read_table(arrows, known, allowed)
        read_table(rooms, room, may)
    }
    {
        split($0, at, ":")
        match($0, /[<"][^>"]*/)
        quoted = substr($0, RSTART, 1) == "\""
        name = substr($0, RSTART + 1, RLENGTH - 1)
        from = layer_of_file(at[1]); to = layer_of_include(name)
        seen++
        if (!(from in known)) complain("no layer is called " from)
        else if (to != "" && !((from, to) in allowed)) complain(from " must not include " name " (" to ")")
        else if (quoted) check_rooms(at[1], name)
    }
    END {
        if (!seen) { print "no #include found: wrong root?"; exit 1 }
        print seen " includes, " bad + 0 " against the arrows"
        exit bad > 0
    }'
