#!/usr/bin/env bash
# places.sh ROOT: one name everywhere. Each stage of stages.def has its kernel, reference and test under
# its own name in the folder of its room, and its section on the room's page; no such file is left over for
# a stage that is gone. docs/stages/README.md lists each page.
set -euo pipefail
cd "$1"
bad=0
complain() {
    echo "$1"
    bad=1
}

# "room stage" of each stage.
table=$(sed -nE 's/^PLAIT_ROOM\(([a-z_]+)\)$/room \1/p
                 s/^PLAIT_STAGE\(([a-z_]+), [A-Z_]+, [a-z_]+, ".*"\)$/stage \1/p' cl/shared/plait/stages.def |
    awk '$1 == "room" { room = $2; next } { sub(/^stage/, room == "" ? "none" : room); print }')
[ -n "$table" ] || complain "cl/shared/plait/stages.def: no stage found"

# Each as room/stage.
places=$(awk '{ print $1 "/" $2 }' <<<"$table")

while read -r room stage; do
    for place in "cl/$room/$stage.cl" "lib/backend/reference/$room/$stage.cpp"; do
        [ -s "$place" ] || complain "$place: missing, though $stage is in stages.def"
    done
    if [ -d tests/cases ] && [ ! -s "tests/cases/$room/$stage.cpp" ]; then
        complain "tests/cases/$room/$stage.cpp: missing, though $stage is in stages.def"
    fi
    grep -qsxF "## $stage" "docs/stages/$room.md" || complain "docs/stages/$room.md: no section ## $stage"
    grep -qsE "__kernel .*\bplait_$stage\b|\bplait_$stage\(" "cl/$room/$stage.cl" ||
        complain "cl/$room/$stage.cl: does not define the kernel plait_$stage"
done <<<"$table"

while read -r kernel; do
    place=${kernel#cl/}
    grep -qxF "${place%.cl}" <<<"$places" || complain "$kernel: not in stages.def, or in another's room"
done < <(find cl -name '*.cl')
for page in docs/stages/*.md; do
    name=$(basename "$page" .md)
    [ "$name" = README ] && continue
    grep -q "^$name/" <<<"$places" || complain "$page: no room of stages.def"
    grep -q "^| \[$name\]($name.md) |" docs/stages/README.md || complain "docs/stages/README.md: does not list $page"
done

echo "$(wc -l <<<"$table") stages"
exit $bad
