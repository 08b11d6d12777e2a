#!/usr/bin/env bash
# on_driver.sh DEVICE COMMAND...: COMMAND succeeds, its tests ran on the OpenCL device DEVICE, and Oclgrind,
# if it is what ran them, found no fault in a kernel.
set -euo pipefail
device=$1
shift
log=$(mktemp)
trap 'rm -f "$log"' EXIT
"$@" 2>&1 | tee "$log"
if grep -q "Running 0 tests" "$log"; then exit 77; fi # all are left out on this driver, says CMakeLists.txt
grep -qE "\[ +OK \].*$device" "$log" || { echo "no test ran on $device"; exit 1; }
faults='Invalid (read|write)|data race|[Uu]ninitialized (value|address)|Work-group divergence'
if grep -qE "$faults" "$log"; then
    echo "Oclgrind found a fault"
    exit 1
fi
