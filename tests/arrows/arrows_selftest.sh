#!/usr/bin/env bash
# arrows.sh must accept an allowed include and name a forbidden one.
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/arrows.sh
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT

# plant FILE INCLUDE: a tree with nothing but this line.
plant() {
    rm -rf "${root:?}"/*
    mkdir -p "$root/$(dirname "$1")"
    echo "#include $2" >"$root/$1"
}
must_pass() {
    plant "$1" "$2"
    "$check" "$root" >/dev/null || { echo "refused: $1 -> $2"; exit 1; }
}
must_fail() {
    plant "$1" "$2"
    if "$check" "$root" >"$root/output"; then echo "let through: $1 -> $2"; exit 1; fi
    grep -q "^$1:1: " "$root/output" || { echo "did not name $1:1"; cat "$root/output"; exit 1; }
}

must_pass lib/core/sim/sim.cpp '"base/result.hpp"'
must_pass lib/core/sim/sim.cpp '<vector>'
must_pass lib/backend/opencl/device.cpp '<CL/cl.h>'
must_pass tests/cases/tressfx/tressfx_wind.cpp '<plait/plait_backend.h>'
must_pass examples/interop.c '<plait/plait_opencl.h>'
must_pass tools/lab/scene/scene.hpp '<Eigen/Dense>'
must_fail lib/core/sim/sim.cpp '<CL/cl.h>'
must_fail lib/core/sim/sim.cpp '<OpenCL/cl.h>'
must_fail lib/core/sim/sim.cpp '"api/wall.hpp"'
must_fail lib/core/sim/sim.cpp '"backend/opencl/device.hpp"'
must_fail lib/base/result.hpp '"core/sim/sim.hpp"'
must_fail lib/backend/reference/tressfx/tressfx_wind.cpp '"core/sim/sim.hpp"'
must_fail lib/backend/opencl/device.cpp '"backend/reference/wind.hpp"'
must_fail lib/io/tfx.cpp '"api/wall.hpp"'
must_fail examples/hello.c '"core/sim/sim.hpp"'
must_fail examples/hello.c '<Eigen/Dense>'
must_fail tools/lab/main.cpp '"core/sim/sim.hpp"'
must_fail tests/cases/tressfx/tressfx_wind.cpp '"backend/opencl/device.hpp"'
must_fail tests/bench/main.cpp '"core/sim/sim.hpp"'
must_fail lib/misc/x.cpp '"base/result.hpp"'

# Rooms, on each floor that has them.
must_pass cl/wind/lane_wind.clh '"grid/grid.clh"'
must_pass cl/wind/lane_wind.cl '"wind/lane_wind.clh"'
must_pass cl/wind/lane_wind.cl '"plait/params.h"'
must_pass lib/backend/reference/wind/lane_wind.cpp '"backend/reference/base/lanes.hpp"'
must_pass tests/cases/volume/volume_splat.cpp '"grid/grid_inputs.hpp"'
must_pass tests/cases/pins/pins.cpp '"inputs.hpp"'
must_pass tests/cases/table.cpp '"case.hpp"'
must_fail cl/grid/grid.clh '"wind/lane_wind.clh"'
must_fail cl/wind/wind_field.cl '"volume/volume.clh"'
must_fail cl/base/vec3.clh '"grid/grid.clh"'
must_fail cl/weather/rain.cl '"base/vec3.clh"'
must_fail cl/wind/wind_field.cl '"common/vec3.clh"'
must_fail lib/backend/reference/grid/grid.cpp '"backend/reference/volume/volume.hpp"'
must_fail tests/cases/grid/grid_inputs.cpp '"volume/volume_inputs.hpp"'
must_fail tests/cases/inputs.hpp '"grid/grid_inputs.hpp"'
must_fail lib/core/sim/sim.cpp '"base/vec3.clh"'
must_pass lib/core/wind/wind.cpp '"core/grid/strand_grid.hpp"'
must_pass lib/core/sim/sim.cpp '"core/wind/wind.hpp"'
must_fail lib/core/strands/model.hpp '"core/wind/wind.hpp"'
must_fail lib/core/strands/state.cpp '"core/wind/wind_grid.hpp"'
must_fail lib/core/volume/volume.cpp '"core/wind/wind.hpp"'
must_fail lib/core/wind/wind.cpp '"core/sim/sim.hpp"'
echo ok
