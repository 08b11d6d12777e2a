#!/usr/bin/env bash
# places.sh must accept a stage in all its places and name the place that is missing.
set -euo pipefail
check=$(cd "$(dirname "$0")" && pwd)/places.sh
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
cd "$root"

plant() {
    mkdir -p cl/shared/plait lib/backend/reference tests/cases docs/stages
    echo 'PLAIT_STAGE(drag, VERTEX, plait_drag_params, "air")' >cl/shared/plait/stages.def
    echo '__kernel void plait_drag(' >cl/drag.cl
    echo x | tee lib/backend/reference/drag.cpp tests/cases/drag.cpp docs/stages/drag.md >/dev/null
    echo '| [drag](drag.md) | vertex | air |' >docs/stages/README.md
}
must_name() {
    if "$check" "$root" >output; then echo "let through: $1"; exit 1; fi
    grep -q "^$1: " output || { echo "did not name $1"; cat output; exit 1; }
}

plant
"$check" "$root" >/dev/null || { echo "refused a whole stage"; exit 1; }
for place in cl/drag.cl lib/backend/reference/drag.cpp tests/cases/drag.cpp docs/stages/drag.md; do
    plant
    rm "$place"
    must_name "$place"
done
plant
echo 'void other(' >cl/drag.cl
must_name cl/drag.cl
for row in '| [drag](drag.md) | vertex | water |' '| [drag](drag.md) | strand | air |'; do
    plant
    echo "$row" >docs/stages/README.md
    must_name docs/stages/README.md
done
plant
echo x >cl/left_over.cl
must_name cl/left_over.cl
echo ok
