#!/usr/bin/env bash
# places.sh must accept a stage in all its places and name the place that is missing.
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/places.sh
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
cd "$root"

plant() {
    rm -rf "${root:?}"/*
    mkdir -p cl/shared/plait cl/air lib/backend/reference/air tests/cases/air docs/stages
    printf '%s\n' 'PLAIT_ROOM(air)' 'PLAIT_STAGE(drag, VERTEX, plait_drag_params, "air")' >cl/shared/plait/stages.def
    echo '__kernel void plait_drag(' >cl/air/drag.cl
    echo x | tee lib/backend/reference/air/drag.cpp tests/cases/air/drag.cpp >/dev/null
    echo '## drag' >docs/stages/air.md
    echo '| [air](air.md) | how air moves hair |' >docs/stages/README.md
}
must_name() {
    if "$check" "$root" >output; then echo "let through: $1"; exit 1; fi
    grep -q "^$1: " output || { echo "did not name $1"; cat output; exit 1; }
}

plant
"$check" "$root" >/dev/null || { echo "refused a whole stage"; exit 1; }
for place in cl/air/drag.cl lib/backend/reference/air/drag.cpp tests/cases/air/drag.cpp docs/stages/air.md; do
    plant
    rm "$place"
    must_name "$place"
done
for floor in cl lib/backend/reference tests/cases; do # all there, but in the room of another feature
    plant
    mv "$floor/air" "$floor/water"
    must_name "$(cd "$floor" && find water -type f | sed "s,^water/,$floor/air/,")"
done
plant
echo 'void other(' >cl/air/drag.cl
must_name cl/air/drag.cl
plant
echo '# drag' >docs/stages/air.md
must_name docs/stages/air.md
plant
echo '| [water](water.md) | how water does |' >docs/stages/README.md
must_name docs/stages/README.md
for kernel in cl/left_over.cl cl/air/left_over.cl cl/water/drag.cl; do
    plant
    mkdir -p "$(dirname "$kernel")"
    echo x >"$kernel"
    must_name "$kernel"
done
plant
echo '## drag' >docs/stages/drag.md
must_name docs/stages/drag.md
echo ok
