#!/bin/sh
# Every stage's case under oclgrind's data-race and bounds checks. One race is allowed, by name: in
# plait_grid_slots vertices race for slots by plain stores and any of them may win.
# Usage: oclgrind.sh <plait-conformance>
log=$(mktemp) || exit 1
trap 'rm -f "$log"' EXIT

# Perturbed runs take the same paths through the kernels, so those are left to the real devices; so are
# the rods, which are long for an interpreter.
echo "left out here, as long for an interpreter: the stages rod and cosserat"
PLAIT_TEST_DEVICE=oclgrind oclgrind --data-races --max-errors 1000000 --log "$log" \
    "$1" --gtest_filter='-*_notices:*.rod:*.cosserat' || exit 1

# A complaint is a line of its own followed by the kernel's name.
awk '
/^[^ \t]/ { what = $0 }
/^[ \t]*Kernel:/ {
    if ($2 == "plait_grid_slots" && what ~ /^Write-write data race at global memory/) { ++allowed; next }
    if (++others <= 20) print $2 ": " what
}
END {
    printf "%d write-write races for slots in plait_grid_slots, %d other complaints\n", allowed, others
    if (!allowed) print "no race for slots was seen: oclgrind is not looking"
    exit others > 0 || !allowed
}' "$log"
